// Pictures and videos of the canvas.

// VP8 first: a CPU that draws and simulates has little time left for encoding.
const formats = ["video/webm;codecs=vp8", "video/webm;codecs=vp9", "video/webm", "video/mp4"];
const patience = 10000; // limit for encoding the first pictures of a video [ms]

/** A part of the canvas as a PNG. @param part {x, y, width, height} in CSS pixels */
function toPng(canvas, part) {
  const ratio = canvas.width / canvas.getBoundingClientRect().width;
  const [x, y, width, height] = [part.x, part.y, part.width, part.height]
    .map((length) => Math.round(length * ratio));
  const copy = Object.assign(document.createElement("canvas"), { width, height });
  copy.getContext("2d").drawImage(canvas, x, y, width, height, 0, 0, width, height);
  return new Promise((done) => copy.toBlob(done, "image/png"));
}

export function makeCapture(frame, wasm, host, save) {
  const { canvas } = frame;
  const name = () => JSON.parse(wasm.report()).scene;
  const wanted = []; // {take, fail}: callbacks for the pixels, or for a failure
  let recorder = null;
  let ending = false;
  let started = () => false;

  /** @param part as above, or undefined for all of it */
  function picture(part) {
    const box = canvas.getBoundingClientRect();
    const whole = { x: 0, y: 0, width: box.width, height: box.height };
    return new Promise((done, fail) => {
      wanted.push({ take: () => done(toPng(canvas, part ?? whole)), fail });
      host.changed?.();
    });
  }

  /** @returns a promise of the video, or null if the browser cannot record one */
  function begin() {
    const mimeType = globalThis.MediaRecorder && formats.find((f) => MediaRecorder.isTypeSupported(f));
    if (!mimeType || recorder) return null;
    recorder = new MediaRecorder(canvas.captureStream(60), { mimeType, videoBitsPerSecond: 8e6 });
    const parts = [];
    recorder.addEventListener("dataavailable", (event) => {
      if (event.data.size > 0) parts.push(event.data);
      if (ending && parts.length > 0) stop();
    });
    ending = false;
    started = () => parts.length > 0;
    const video = new Promise((done) => {
      recorder.addEventListener("stop", () => {
        recorder = null;
        wasm.recording(0);
        host.changed?.();
        done(new Blob(parts, { type: mimeType.split(";")[0] }));
      });
    });
    recorder.start(250);
    wasm.recording(1);
    host.changed?.(); // a paused run is redrawn
    return video;
  }

  function stop() {
    if (recorder?.state === "recording") recorder.stop();
    recorder?.stream.getTracks().forEach((track) => track.stop());
  }

  /** Ends the video once some of it has been encoded. */
  function end() {
    ending = true;
    if (started()) stop();
    else {
      const waitedFor = recorder;
      setTimeout(() => { if (recorder === waitedFor) stop(); }, patience);
    }
  }

  host.record = async (on) => {
    if (!on) {
      end();
      return;
    }
    const video = begin();
    if (!video) {
      wasm.tell("This browser cannot record a video");
      return;
    }
    const blob = await video;
    save(`${name()}.${blob.type.split("/")[1]}`, blob);
  };

  return {
    picture,
    begin,
    end,
    /** Call right after drawing, while the pixels are available. */
    afterDraw() {
      if (recorder) host.changed?.(); // a video of a paused run has pictures as well
      for (const { take } of wanted.splice(0)) take();
    },
    /** Ends a video with its frames so far; pending pictures fail. */
    close(reason) {
      stop();
      for (const { fail } of wanted.splice(0)) fail(new Error(reason));
    },
  };
}
