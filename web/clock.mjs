// When a laboratory draws.
import { Graphics } from "./graphics.mjs";

const cursors = ["default", "grab", "text"];

/** Draws while something goes on and for a moment after every event, as long as it can be seen. */
export class Clock {
  /** @param afterDraw called when a frame is on the canvas, while its pixels are there */
  constructor(wasm, frame, afterDraw) {
    Object.assign(this, { wasm, frame, afterDraw });
    this.before = performance.now();
    this.awakeUntil = 0;
    this.timer = 0; // of a frame that was begun and not shown
    this.pictures = frame.canvas.pictures = { begun: 0, shown: 0 }; // for tests that look at pixels
    this.graphics = new Graphics(wasm, frame, () => this.wake());
    this.seen = false; // until the watcher reports it
    this.watcher = new IntersectionObserver((entries) => {
      this.seen = entries.at(-1).isIntersecting; // there are several where the page was busy
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

  /** Until what moves has come to rest. */
  wake() { this.awakeUntil = performance.now() + 1500; }

  /** Goes on to the next frame, if there is something to draw. */
  next(now) {
    const emptied = this.frame.fit(this.wasm); // a canvas of another size
    if (emptied) this.wake();
    else if (this.timer) return;
    const dt = Math.max(0, (now - this.before) / 1000);
    this.before = now;
    if (!this.wasm.busy() && now >= this.awakeUntil) return;
    if (emptied || !this.wasm.deferred()) this.draw(dt);
    else this.begin(dt);
  }

  /** Draws a frame and shows it, however long that takes. */
  draw(dt) {
    this.pictures.begun += 1;
    this.wasm.frame(dt);
    this.wasm.present(1);
    this.shown();
  }

  /**
   * Begins a frame that a processor draws, and shows it when it is finished. A browser reads the
   * pixels of a canvas that has changed, and does not answer until they are drawn.
   */
  begin(dt) {
    this.pictures.begun += 1;
    const showWhenFinished = () => {
      if (!this.canDraw() || this.wasm.present(0)) this.shown();
      else this.timer = setTimeout(showWhenFinished);
    };
    this.timer = setTimeout(() => { // after the browser's own frame
      if (this.canDraw()) this.wasm.frame(dt);
      showWhenFinished();
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
