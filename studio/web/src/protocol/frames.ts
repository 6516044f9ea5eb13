// The binary frames of the stream: cut out of whatever pieces the network brings, and read.
// Each is copied out of the stream's buffer, so that its arrays lie aligned and outlive it.
import type { ServerEvent } from "./types";

export interface NodesFrame {
  kind: "nodes";
  version: number;
  plant: number;
  first: number;
  count: number;
  total: number;
  iteration: number;
  parent: Int32Array;
  position: Float32Array;
  /** Of all nodes so far, not of the new ones alone. */
  radius: Float32Array;
  born: Uint16Array;
  order: Uint16Array;
  exposure: Uint8Array;
}

export interface ElementsFrame {
  kind: "elements";
  version: number;
  plant: number;
  shape: number;
  first: number;
  count: number;
  iteration: number;
  position: Float32Array;
  scale: Float32Array;
  /** Quaternions x, y, z, w in 1/32767. */
  rotation: Int16Array;
  born: Uint16Array;
  exposure: Uint8Array;
}

export type Frame = { kind: "nothing" } | { kind: "event"; event: ServerEvent } | NodesFrame | ElementsFrame;

const headBytes = 8;

/** Gathers pieces and gives whole frames. A frame of a kind that is not known is passed over. */
export class FrameReader {
  private pending = new Uint8Array(0);
  private used = 0;

  push(piece: Uint8Array): Frame[] {
    this.append(piece);
    const frames: Frame[] = [];
    let at = 0;
    const view = new DataView(this.pending.buffer, this.pending.byteOffset, this.used);
    while (this.used - at >= headBytes) {
      const bytes = view.getUint32(at, true);
      if (this.used - at < headBytes + bytes) break;
      const body = this.pending.slice(at + headBytes, at + headBytes + bytes);
      const frame = readFrame(view.getUint8(at + 4), body);
      if (frame) frames.push(frame);
      at += headBytes + bytes;
    }
    this.pending.copyWithin(0, at, this.used);
    this.used -= at;
    return frames;
  }

  private append(piece: Uint8Array): void {
    const need = this.used + piece.length;
    if (need > this.pending.length) {
      const larger = new Uint8Array(Math.max(need, 2 * this.pending.length, 1 << 16));
      larger.set(this.pending.subarray(0, this.used));
      this.pending = larger;
    }
    this.pending.set(piece, this.used);
    this.used = need;
  }
}

/** body begins at its own buffer's first byte. */
function readFrame(kind: number, body: Uint8Array<ArrayBuffer>): Frame | null {
  switch (kind) {
    case 0:
      return { kind: "nothing" };
    case 1:
      return { kind: "event", event: JSON.parse(new TextDecoder().decode(body)) as ServerEvent };
    case 2:
      return readNodes(body);
    case 3:
      return readElements(body);
    default:
      return null;
  }
}

function readNodes(body: Uint8Array<ArrayBuffer>): NodesFrame {
  const [version, plant, first, count, total, iteration] = words(body, 6);
  const take = new Taker(body, 24);
  return {
    kind: "nodes",
    version, plant, first, count, total, iteration,
    parent: take.next(Int32Array, count),
    position: take.next(Float32Array, 3 * count),
    radius: take.next(Float32Array, total),
    born: take.next(Uint16Array, count),
    order: take.next(Uint16Array, count),
    exposure: take.next(Uint8Array, count),
  };
}

function readElements(body: Uint8Array<ArrayBuffer>): ElementsFrame {
  const [version, plant, shape, first, count, iteration] = words(body, 6);
  const take = new Taker(body, 24);
  return {
    kind: "elements",
    version, plant, shape, first, count, iteration,
    position: take.next(Float32Array, 3 * count),
    scale: take.next(Float32Array, count),
    rotation: take.next(Int16Array, 4 * count),
    born: take.next(Uint16Array, count),
    exposure: take.next(Uint8Array, count),
  };
}

type Six = [number, number, number, number, number, number];

function words(body: Uint8Array<ArrayBuffer>, count: number): Six {
  return Array.from(new Uint32Array(body.buffer, 0, count)) as Six;
}

interface ArrayKind<T> {
  new (buffer: ArrayBuffer, offset: number, length: number): T;
  readonly BYTES_PER_ELEMENT: number;
}

/** Arrays one behind the other, widest first, so that each begins where its kind may. */
class Taker {
  constructor(private readonly body: Uint8Array<ArrayBuffer>, private at: number) {}

  next<T>(kind: ArrayKind<T>, length: number): T {
    const from = this.at;
    this.at += length * kind.BYTES_PER_ELEMENT;
    if (this.at > this.body.length) throw new RangeError("a frame is shorter than it says");
    return new kind(this.body.buffer, from, length);
  }
}
