/**
 * Arrays as the page holds them, {type, data}: little-endian numbers in base64. Matrices lie row by row.
 */
const ARRAYS = { float64: Float64Array, float32: Float32Array, int16: Int16Array };

/** The typed array of a packed one. */
function unpack(packed) {
  const text = atob(packed.data);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) {
    bytes[i] = text.charCodeAt(i);
  }
  return new ARRAYS[packed.type](bytes.buffer);
}

/** Everything that was put into the page: {model, curve, method, settling, sets, falls, quantum}. */
function embedded() {
  return JSON.parse(byId("data").textContent);
}

/** The element of the page with that id. */
function byId(id) {
  return document.getElementById(id);
}
