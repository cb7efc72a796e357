// Mouse, touch, wheel and key events of the canvas, forwarded to the application.

/**
 * @param wasm the result of start() in loader.mjs
 * @param {boolean} shares whether wheel and touch belong to the page until the canvas has the focus
 * @param {() => void} wake called on every event to request a redraw
 * @param {AbortSignal} signal removes listeners outside the canvas, which would keep objects alive
 */
export function listen(canvas, wasm, wake, shares, signal) {
  const fingers = new Map(); // pointer id -> position
  let pressed = false; // whether the application has a finger down

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const buttonOf = (event) => [0, 2, 1][event.button] ?? 0;
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, distance: Math.hypot(a.x - b.x, a.y - b.y) };
  };

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    const at = place(event);
    if (event.pointerType !== "touch") {
      wasm.pointer(at.x, at.y, 0);
      wasm.button(buttonOf(event), 1, 0);
    } else {
      fingers.set(event.pointerId, at);
      if (fingers.size === 1) {
        wasm.pinching(0);
        wasm.pointer(at.x, at.y, 1);
        wasm.button(0, 1, 1);
        pressed = true;
      } else if (pressed) {
        wasm.pinching(1); // the second finger makes it a pinch
        wasm.button(0, 0, 1);
        pressed = false;
      }
    }
  });

  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    if (event.pointerType !== "touch") {
      wasm.pointer(at.x, at.y, 0);
    } else if (fingers.has(event.pointerId)) {
      const before = fingers.size === 2 ? spread() : null;
      fingers.set(event.pointerId, at);
      if (fingers.size === 1) wasm.pointer(at.x, at.y, 1);
      if (before) {
        const now = spread();
        const factor = now.distance / Math.max(1, before.distance);
        wasm.pinch(factor, now.x - before.x, now.y - before.y);
      }
    }
  });

  const lift = (event) => {
    if (event.pointerType !== "touch") {
      wasm.button(buttonOf(event), 0, 0);
      return;
    }
    fingers.delete(event.pointerId);
    if (pressed && fingers.size === 0) {
      wasm.button(0, 0, 1);
      pressed = false;
    }
    if (fingers.size === 0) wasm.pointerGone();
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("pointerleave", (event) => {
    if (event.pointerType !== "touch" && event.buttons === 0) wasm.pointerGone();
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());

  canvas.addEventListener("wheel", (event) => {
    if (shares && document.activeElement !== canvas) return; // the page scrolls
    // Converts lines or pages to pixels; a notch is about 100 of them, and one of ours.
    const scale = [1, 33, 400][event.deltaMode] / 100;
    wasm.wheel(-event.deltaX * scale, -event.deltaY * scale * (event.ctrlKey ? 4 : 1));
    event.preventDefault();
  }, { passive: false });

  const key = (event, down) => {
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (name === "Tab") return; // leaves the canvas, as usual on a page
    if (name === "F6") { // next panel; browsers reserve Ctrl Tab
      if (down) for (const [tab, ctrl] of [[1, 1], [0, 1], [0, 0]]) wasm.key("Tab", tab, ctrl, 0, 0, 0);
      event.preventDefault();
      return;
    }
    const plain = !event.ctrlKey && !event.metaKey && !event.altKey;
    // The paste event has the clipboard and must not be prevented; it sends the key itself.
    if (!plain && name === "v") return;
    const taken = wasm.key(name, down, event.ctrlKey, event.shiftKey, event.altKey, event.metaKey);
    if (down && plain && event.key.length === 1) wasm.text(event.key);
    if (plain && (taken || event.key === "/" || event.key === "'")) event.preventDefault();
  };
  window.addEventListener("paste", (event) => {
    if (document.activeElement !== canvas) return;
    wasm.pasted(event.clipboardData?.getData("text/plain") ?? "");
    for (const down of [1, 0]) wasm.key("v", down, down, 0, 0, 0);
    wake();
  }, { signal });
  // A focus ring around the page.
  let tab = false;
  window.addEventListener("keydown", (event) => { tab = event.key === "Tab"; },
    { capture: true, signal });
  window.addEventListener("pointerdown", () => {
    tab = false;
    delete canvas.dataset.keyboard;
  }, { capture: true, signal });
  canvas.addEventListener("focus", () => { if (tab) canvas.dataset.keyboard = ""; });
  canvas.addEventListener("keydown", (event) => key(event, 1));
  canvas.addEventListener("keyup", (event) => key(event, 0));
  canvas.addEventListener("focus", () => wasm.focus(1));
  canvas.addEventListener("blur", () => wasm.focus(0));
  window.addEventListener("blur", () => wasm.focus(0), { signal });
  for (const type of ["pointerdown", "pointermove", "pointerup", "pointercancel", "pointerleave",
    "wheel", "keydown", "keyup", "focus", "blur"]) {
    canvas.addEventListener(type, wake, { passive: true });
  }
}
