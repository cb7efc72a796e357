// Measurements on pictures.
import { PNG } from "pngjs";

/** A part of a picture. @param box {x, y, width, height} */
export function part(png, box) {
  const out = new PNG({ width: box.width, height: box.height });
  PNG.bitblt(png, out, box.x, box.y, box.width, box.height, 0, 0);
  return out;
}

/** Variance of the brightness: 0 for a blank picture. */
export function variance(png) {
  let sum = 0;
  let squares = 0;
  const count = png.width * png.height;
  for (let i = 0; i < 4 * count; i += 4) {
    const v = 0.2126 * png.data[i] + 0.7152 * png.data[i + 1] + 0.0722 * png.data[i + 2];
    sum += v;
    squares += v * v;
  }
  return squares / count - (sum / count) ** 2;
}

/** Share of the pixels in which two pictures differ visibly. */
export function difference(a, b) {
  let changed = 0;
  const count = a.width * a.height;
  for (let i = 0; i < 4 * count; i += 4) {
    const d = Math.max(Math.abs(a.data[i] - b.data[i]), Math.abs(a.data[i + 1] - b.data[i + 1]),
      Math.abs(a.data[i + 2] - b.data[i + 2]));
    if (d > 5) ++changed; // dark panels on a dark background differ only slightly
  }
  return changed / count;
}
