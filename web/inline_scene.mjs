// A scene embedded in an address: its text without display-only parts, deflated, in base64url.

/** Maximum unpacked size of a link's scene [bytes]: 1 kB of letters can expand to 1 MB. */
export const largestUnpacked = 4 << 20;

// A stream inflates its whole input before it returns output: 1 kB becomes 1 MB at most.
const sliceSize = 1024; // [bytes]

/** A stream of the bytes in slices, read on demand. */
function slices(bytes) {
  let at = 0;
  return new ReadableStream({
    pull(controller) {
      if (at >= bytes.length) return controller.close();
      controller.enqueue(bytes.subarray(at, at + sliceSize));
      at += sliceSize;
    },
  }, { highWaterMark: 0 });
}

/** The output of a transform stream; throws a RangeError past `most` bytes. */
async function through(bytes, stream, most = Infinity) {
  const reader = slices(bytes).pipeThrough(stream).getReader();
  const pieces = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(pieces).arrayBuffer());
    size += value.length;
    if (size > most) {
      await reader.cancel();
      throw new RangeError(`unpacks to more than ${most >> 20} MiB`);
    }
    pieces.push(value);
  }
}

/** @param text a scene file @returns URL-safe characters */
export const pack = (text) => packText(JSON.stringify(JSON.parse(text)));

/** @param text any @returns URL-safe characters */
export async function packText(text) {
  const plain = new TextEncoder().encode(text);
  const packed = await through(plain, new CompressionStream("deflate-raw"));
  let letters = "";
  for (const byte of packed) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** @returns the text; throws if the letters are invalid, a RangeError if the text is too long */
export async function unpack(letters) {
  const binary = atob(letters.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = new Uint8Array(binary.length); // in a loop: from() takes 100 ns per character
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  const plain = await through(bytes, new DecompressionStream("deflate-raw"), largestUnpacked);
  return new TextDecoder("utf-8", { fatal: true }).decode(plain);
}
