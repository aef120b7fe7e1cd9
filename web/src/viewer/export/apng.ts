// Assembles an animated PNG from PNG images, keeping their compressed data (PNG, 3rd edition, 11.3).

const SIGNATURE = [137, 80, 78, 71, 13, 10, 26, 10];
const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

interface Chunk {
  type: string;
  bytes: Uint8Array;
}

/** frames: PNG files of one size and type, at least one. Loops forever. Throws Error for other files or sizes. */
export function animatedPng(frames: readonly Uint8Array[], framesPerSecond: number): Uint8Array {
  const pictures = frames.map(chunksOf);
  const header = find(pictures[0] ?? [], "IHDR");
  const size = header.slice(0, 8);
  const chunks: Chunk[] = [
    { type: "IHDR", bytes: header },
    { type: "acTL", bytes: words(frames.length, 0) },
  ];
  let number = 0;
  pictures.forEach((picture, i) => {
    if (String(find(picture, "IHDR")) !== String(header)) throw new Error("a frame of the animation has a different size");
    const control = new Uint8Array([...words(number++), ...size, ...words(0, 0), ...delay(framesPerSecond), 0, 0]);
    chunks.push({ type: "fcTL", bytes: control });
    for (const { type, bytes } of picture) {
      if (type !== "IDAT") continue;
      chunks.push(i === 0 ? { type, bytes } : { type: "fdAT", bytes: joined([words(number++), bytes]) });
    }
  });
  return joined([new Uint8Array(SIGNATURE), ...[...chunks, { type: "IEND", bytes: new Uint8Array() }].map(packed)]);
}

/** Delay of a frame, in hundredths of a second: 1 / fps as a fraction of two 16-bit numbers. */
function delay(framesPerSecond: number): number[] {
  const hundredths = Math.max(1, Math.round(100 / framesPerSecond));
  return [hundredths >> 8, hundredths & 255, 0, 100];
}

export function chunksOf(file: Uint8Array): Chunk[] {
  if (SIGNATURE.some((byte, i) => file[i] !== byte)) throw new Error("a frame of the animation is not a PNG file");
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const chunks: Chunk[] = [];
  for (let at = 8; at + 12 <= file.length;) {
    const length = view.getUint32(at);
    chunks.push({ type: String.fromCharCode(...file.subarray(at + 4, at + 8)), bytes: file.subarray(at + 8, at + 8 + length) });
    at += length + 12;
  }
  return chunks;
}

function find(chunks: Chunk[], type: string): Uint8Array {
  const chunk = chunks.find((one) => one.type === type);
  if (!chunk) throw new Error(`a frame of the animation has no ${type} chunk`);
  return chunk.bytes;
}

function packed({ type, bytes }: Chunk): Uint8Array {
  const body = joined([Uint8Array.from(type, (letter) => letter.charCodeAt(0)), bytes]);
  return joined([words(bytes.length), body, words(checksum(body))]);
}

function checksum(bytes: Uint8Array): number {
  let c = 0xffffffff;
  for (const byte of bytes) c = (TABLE[(c ^ byte) & 255] ?? 0) ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

/** Big-endian, four bytes each. */
function words(...numbers: number[]): Uint8Array {
  const bytes = new DataView(new ArrayBuffer(4 * numbers.length));
  numbers.forEach((number, i) => bytes.setUint32(4 * i, number));
  return new Uint8Array(bytes.buffer);
}

function joined(parts: readonly Uint8Array[]): Uint8Array {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
