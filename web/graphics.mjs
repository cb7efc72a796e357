// Shares WebGL contexts between the laboratories of a page. Browsers allow some 16 contexts and
// drop the oldest when there are more, so laboratories out of sight release theirs.

const most = 6; // laboratories with contexts

const all = new Set(); // by the time they came into sight, the oldest first

/** Releases contexts of laboratories out of sight, until `room` more fit. */
function makeRoom(room) {
  let held = [...all].filter((one) => one.holds()).length;
  for (const one of all) {
    if (held + room <= most) return;
    if (one.release()) --held;
  }
}

/** The WebGL context of one laboratory. */
export class Graphics {
  /** @param wake requests a redraw */
  constructor(wasm, frame, wake) {
    Object.assign(this, { wasm, frame, wake });
    this.state = "held"; // then "leaving", "away", "coming"; "taken" by the system
    this.seen = false;
    this.patience = 2000; // delay before the next request for a context [ms]
    frame.canvas.addEventListener("webglcontextlost", (event) => this.lost(event));
    frame.canvas.addEventListener("webglcontextrestored", () => this.restored());
    makeRoom(1);
    all.add(this);
  }

  holds() { return this.state === "held" || this.state === "coming"; }
  canDraw() { return this.state === "held"; }
  wasTaken() { return this.state === "taken"; } // shown by a card

  /** Call when its visibility changes. */
  see(seen) {
    this.seen = seen;
    if (!seen) return;
    all.delete(this);
    all.add(this);
    this.fetch();
  }

  /** Requests the context again, if it is lost. */
  fetch() {
    if (this.state !== "away" && this.state !== "taken") return;
    makeRoom(1);
    if (this.state === "away") this.state = "coming";
    this.wasm.takeGraphics(); // a lost context may come later, or not be granted yet
  }

  /** Repeats the request with increasing delay: two in sight may take each other's context. */
  retry() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (this.state !== "taken") return;
      if (this.seen) this.fetch();
      this.retry();
    }, this.patience);
    this.patience = Math.min(2 * this.patience, 60000);
  }

  /** Releases the context if it is out of sight. @returns whether it did */
  release() {
    if (this.seen || !this.canDraw() || !this.wasm.canReleaseGraphics()) return false;
    this.state = "leaving"; // a new context can only be requested after the browser confirms the loss
    this.wasm.releaseGraphics();
    return true;
  }

  lost(event) {
    if (!this.frame.canvas.isConnected) return;
    event.preventDefault(); // otherwise it is never restored
    if (this.state === "leaving") {
      this.state = "away";
      // The browser refuses to restore a context until this handler has returned.
      this.timer = setTimeout(() => { if (this.seen) this.fetch(); });
    } else {
      this.state = "taken";
      this.wasm.contextLost();
      this.frame.say("The graphics context was lost", "The system revoked the graphics context, " +
        "perhaps to save memory or for other parts of the page. The picture returns automatically " +
        "when it is restored; the run is paused.");
      this.retry();
    }
  }

  restored() {
    const error = this.wasm.contextRestored();
    if (error) {
      this.frame.say("The graphics context was not restored", `${error} Reload the page.`);
      return;
    }
    this.state = "held";
    this.frame.clear();
    this.wake();
    makeRoom(0);
  }

  close() {
    clearTimeout(this.timer);
    all.delete(this);
  }
}
