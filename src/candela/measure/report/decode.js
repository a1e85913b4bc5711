// The way back from report_pixels.cpp: base64, zlib, rows of differences, planes of bytes.

function bytesFromBase64(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function unpack(text, width) {
  const stream = new Blob([bytesFromBase64(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  for (let row = 0; row < bytes.length; row += width) {
    for (let i = row + 1; i < row + width; ++i) bytes[i] = bytes[i] + bytes[i - 1];
  }
  return bytes;
}

// Interleaved RGB half floats as their bits.
async function unpackHalves(text, width, height) {
  const bytes = await unpack(text, width);
  const count = width * height;
  const out = new Uint16Array(3 * count);
  for (let c = 0; c < 3; ++c) {
    const high = c * count, low = (c + 3) * count;
    for (let i = 0; i < count; ++i) out[3 * i + c] = (bytes[high + i] << 8) | bytes[low + i];
  }
  return out;
}

// Every half float as a number; 65536 entries are quicker than any arithmetic.
const numberOfHalf = (() => {
  const table = new Float32Array(65536);
  for (let bits = 0; bits < 65536; ++bits) {
    const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    if (exponent === 31) table[bits] = mantissa ? NaN : sign * Infinity;
    else if (exponent === 0) table[bits] = sign * mantissa * 2 ** -24;
    else table[bits] = sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
  }
  return table;
})();
