// Schedules the frames of a laboratory.
import { Graphics } from "./graphics.mjs";

const cursors = ["default", "grab", "text"];
// A software renderer draws the panels in some frames only, while a run plays.
const wholeAfterEvent = 500; // for this long, every frame is drawn whole [ms]
const wholeEvery = 4; // afterwards, one of so many frames

/** Draws during activity and for a moment after every event, while the canvas is visible. */
export class Clock {
  /**
   * @param afterDraw called after each drawn frame, while its pixels are available, with whether
   *   the frame was drawn whole
   */
  constructor(wasm, frame, afterDraw) {
    Object.assign(this, { wasm, frame, afterDraw });
    this.before = performance.now();
    this.awakeUntil = 0;
    this.wholeUntil = 0;
    this.frames = 0; // of the browser
    this.shownIn = -1; // the last frame of the browser in which a picture was shown
    this.timer = 0; // for a frame that was begun and not shown
    this.ended = false; // a listener of a frame may end the clock
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
      this.frames += 1;
      if (this.canDraw() && this.seen) this.next(now);
      else this.before = now;
    };
    this.wake();
    this.request = requestAnimationFrame(this.tick);
  }

  canDraw() { return !this.ended && !this.wasm.stopped && this.graphics.canDraw(); }

  /** Keeps drawing until animations have ended. */
  wake() {
    const now = performance.now();
    this.awakeUntil = now + 1500;
    this.wholeUntil = now + wholeAfterEvent;
  }

  /** Draws the next frame, if there is a change. */
  next(now) {
    const emptied = this.frame.fit(this.wasm); // the canvas has another size
    if (emptied) this.wake();
    else if (this.timer) return;
    const dt = Math.max(0, (now - this.before) / 1000);
    this.before = now;
    // The end of a run is drawn too, for example a failure and its card.
    const running = this.wasm.busy();
    if (running) this.awakeUntil = Math.max(this.awakeUntil, now + 1500);
    if (now >= this.awakeUntil) return;
    const whole = !running || now < this.wholeUntil || this.pictures.begun % wholeEvery === 0;
    if (emptied || !this.wasm.deferred()) this.draw(dt);
    else this.begin(dt, whole);
  }

  /** Draws a frame and shows it synchronously. */
  draw(dt) {
    this.pictures.begun += 1;
    this.whole = true;
    this.wasm.frame(dt, 1);
    this.wasm.present(1);
    this.shown();
  }

  /**
   * Begins a software-rendered frame and shows it when it is finished. A browser reads the pixels
   * of a changed canvas, and blocks until they are drawn; the next frame is begun before it does,
   * so that the renderer does not wait for it.
   */
  begin(dt, whole) {
    this.pictures.begun += 1;
    this.whole = whole;
    const showWhenFinished = () => {
      const due = this.frames > this.shownIn; // not two pictures in one frame of the browser
      if (!this.canDraw() || (due && this.wasm.present(0))) {
        this.shownIn = this.frames;
        this.shown();
        if (this.canDraw() && this.seen) this.next(performance.now());
      } else {
        this.timer = setTimeout(showWhenFinished);
      }
    };
    this.timer = setTimeout(() => { // after the browser's own frame
      try {
        if (this.canDraw()) this.wasm.frame(dt, whole ? 1 : 0);
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
    this.afterDraw(this.whole);
  }

  stop() {
    this.ended = true;
    cancelAnimationFrame(this.request);
    clearTimeout(this.timer);
    this.watcher.disconnect();
    this.graphics.close();
  }
}
