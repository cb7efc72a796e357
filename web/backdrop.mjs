// Where a processor draws: the picture on a small canvas behind the laboratory's own, which the
// browser enlarges and puts together with the panels far quicker than WebGL would.

/** Whether a processor draws what WebGL is told to. Unknown: no. */
export function drawsInSoftware() {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2");
  if (!context) return false;
  let name = context.getParameter(context.RENDERER);
  if (/^webkit/i.test(name)) { // all that some browsers say without being asked twice
    const told = context.getExtension("WEBGL_debug_renderer_info");
    if (told) name = context.getParameter(told.UNMASKED_RENDERER_WEBGL);
  }
  loseContext(canvas); // browsers give only a few
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(name));
}

export function loseContext(canvas) {
  canvas.getContext("webgl2")?.getExtension("WEBGL_lose_context")?.loseContext();
}

/**
 * @param view the laboratory's canvas, which can be seen through
 * @param createContext of a canvas, for the WebAssembly: (canvas, options) => number
 * @param deleteContext forgets one of those: (number)
 */
export function makeBackdrop(view, createContext, deleteContext) {
  let canvas = null;
  let context = 0;
  let lost = false;

  function make() {
    const made = document.createElement("canvas");
    canvas = made;
    lost = false;
    canvas.className = "substep-backdrop";
    canvas.setAttribute("aria-hidden", "true");
    canvas.addEventListener("webglcontextlost", () => {
      if (canvas !== made) return; // it was closed
      lost = true; // for good: the laboratory draws on its own canvas from then on
      canvas.remove();
    });
    view.before(canvas);
    context = createContext(canvas,
      { alpha: false, depth: true, preserveDrawingBuffer: true });
  }

  return {
    /**
     * @param width, height in pixels
     * @returns its context; 0: there is none, negative: that was lost
     */
    fit(width, height) {
      if (!canvas) make();
      if (lost) return -context;
      if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
      return context;
    },
    /** Gives its context back; the next fit makes another. */
    close() {
      if (!canvas) return;
      loseContext(canvas);
      canvas.remove();
      deleteContext(context);
      canvas = null;
    },
  };
}
