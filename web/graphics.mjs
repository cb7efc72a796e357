// Who of a page's laboratories holds the graphics. Browsers give a page some 16 contexts and take
// the oldest away when there are more, so those out of sight hand theirs on to those in sight.

const most = 6; // laboratories that hold contexts

const all = new Set(); // in the order in which they came into sight, longest ago first

/** Hands on what those out of sight hold, until `room` more fit. */
function makeRoom(room) {
  let held = [...all].filter((one) => one.holds()).length;
  for (const one of all) {
    if (held + room <= most) return;
    if (one.handOn()) --held;
  }
}

/** The graphics of one laboratory. */
export class Graphics {
  /** @param wake called when there is something to draw again */
  constructor(wasm, frame, wake) {
    Object.assign(this, { wasm, frame, wake });
    this.state = "held"; // then "leaving", "away", "coming"; "taken" by the system
    this.seen = false;
    this.patience = 2000; // before it requests a context again [ms]
    frame.canvas.addEventListener("webglcontextlost", (event) => this.lost(event));
    frame.canvas.addEventListener("webglcontextrestored", () => this.restored());
    makeRoom(1);
    all.add(this);
  }

  holds() { return this.state === "held" || this.state === "coming"; }
  canDraw() { return this.state === "held"; }
  wasTaken() { return this.state === "taken"; } // a card says so

  /** Whether it is in sight changed. */
  see(seen) {
    this.seen = seen;
    if (!seen) return;
    all.delete(this);
    all.add(this);
    this.fetch();
  }

  /** Asks for the graphics again, if they are not there. */
  fetch() {
    if (this.state !== "away" && this.state !== "taken") return;
    makeRoom(1);
    if (this.state === "away") this.state = "coming";
    this.wasm.takeGraphics(); // what the system took may come later, or not be given yet
  }

  /** Asks again and again, ever less often: two that are in sight may take each other's. */
  retry() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      if (this.state !== "taken") return;
      if (this.seen) this.fetch();
      this.retry();
    }, this.patience);
    this.patience = Math.min(2 * this.patience, 60000);
  }

  /** Gives the graphics up while it is out of sight. @returns whether it did */
  handOn() {
    if (this.seen || !this.canDraw() || !this.wasm.canHandOn()) return false;
    this.state = "leaving"; // no context can be requested before the browser confirms the loss
    this.wasm.handOnGraphics();
    return true;
  }

  lost(event) {
    if (!this.frame.canvas.isConnected) return;
    event.preventDefault(); // or it never comes back
    if (this.state === "leaving") {
      this.state = "away";
      if (this.seen) this.fetch();
    } else {
      this.state = "taken";
      this.wasm.contextLost();
      this.frame.say("The graphics context was lost", "The system took the graphics away, " +
        "perhaps to save memory or for other parts of the page. The picture comes back by itself " +
        "when it is given again; the run waits.");
      this.retry();
    }
  }

  restored() {
    const error = this.wasm.contextRestored();
    if (error) {
      this.frame.say("The graphics did not come back", `${error} Reloading the page helps.`);
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
