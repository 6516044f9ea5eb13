// Arrays that grow as frames come: room doubles, so that many small appends cost no more than one large.

type Numbers = Float32Array<ArrayBuffer> | Int32Array<ArrayBuffer> | Uint16Array<ArrayBuffer> | Int16Array<ArrayBuffer> | Uint8Array<ArrayBuffer>;

export function withRoom<T extends Numbers>(array: T, used: number, need: number): T {
  if (need <= array.length) return array;
  const Kind = array.constructor as new (length: number) => T;
  const larger = new Kind(Math.max(need, 2 * array.length, 64));
  larger.set(array.subarray(0, used));
  return larger;
}
