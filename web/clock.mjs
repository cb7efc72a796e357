// Schedules the frames of a laboratory.
import { Graphics } from "./graphics.mjs";

const cursors = ["default", "grab", "text"];

/** Draws during activity and for a moment after every event, while the canvas is visible. */
export class Clock {
  /** @param afterDraw called after each drawn frame, while its pixels are available */
  constructor(wasm, frame, afterDraw) {
    Object.assign(this, { wasm, frame, afterDraw });
    this.before = performance.now();
    this.awakeUntil = 0;
    this.timer = 0; // for a frame that was begun and not shown
    this.pictures = frame.canvas.pictures = { begun: 0, shown: 0 }; // for tests that read pixels
    this.graphics = new Graphics(wasm, frame, () => this.wake());
    this.seen = false; // until the observer reports it
    this.watcher = new IntersectionObserver((entries) => {
      this.seen = entries.at(-1).isIntersecting; // several if the page was busy
      this.graphics.see(this.seen);
      this.wake();
    });
    this.watcher.observe(frame.canvas);
    this.tick = (now) => {
      this.request = requestAnimationFrame(this.tick);
      if (this.canDraw() && this.seen) this.next(now);
      else this.before = now;
    };
    this.wake();
    this.request = requestAnimationFrame(this.tick);
  }

  canDraw() { return !this.wasm.stopped && this.graphics.canDraw(); }

  /** Keeps drawing until animations have ended. */
  wake() { this.awakeUntil = performance.now() + 1500; }

  /** Draws the next frame, if there is a change. */
  next(now) {
    const emptied = this.frame.fit(this.wasm); // the canvas has another size
    if (emptied) this.wake();
    else if (this.timer) return;
    const dt = Math.max(0, (now - this.before) / 1000);
    this.before = now;
    if (this.wasm.busy()) this.wake(); // what it ends with is drawn too: a failure and its card
    if (now >= this.awakeUntil) return;
    if (emptied || !this.wasm.deferred()) this.draw(dt);
    else this.begin(dt);
  }

  /** Draws a frame and shows it synchronously. */
  draw(dt) {
    this.pictures.begun += 1;
    this.wasm.frame(dt);
    this.wasm.present(1);
    this.shown();
  }

  /**
   * Begins a software-rendered frame and shows it when it is finished. A browser reads the pixels
   * of a changed canvas, and blocks until they are drawn.
   */
  begin(dt) {
    this.pictures.begun += 1;
    const showWhenFinished = () => {
      if (!this.canDraw() || this.wasm.present(0)) this.shown();
      else this.timer = setTimeout(showWhenFinished);
    };
    this.timer = setTimeout(() => { // after the browser's own frame
      try {
        if (this.canDraw()) this.wasm.frame(dt);
      } finally {
        showWhenFinished(); // or no frame would follow
      }
    });
  }

  shown() {
    clearTimeout(this.timer);
    this.timer = 0;
    this.pictures.shown = this.pictures.begun;
    if (!this.canDraw()) return;
    this.frame.canvas.style.cursor = cursors[this.wasm.cursor()];
    this.afterDraw();
  }

  stop() {
    cancelAnimationFrame(this.request);
    clearTimeout(this.timer);
    this.watcher.disconnect();
    this.graphics.close();
  }
}
