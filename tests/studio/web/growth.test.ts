import assert from "node:assert/strict";
import { test } from "node:test";
import { limbsOf } from "../../../studio/web/src/growth/limbs";
import { Growth, Skeleton } from "../../../studio/web/src/growth/plants";
import { buildTubes } from "../../../studio/web/src/growth/tubes";
import { FrameReader, type Frame, type NodesFrame } from "../../../studio/web/src/protocol/frames";

/** A stem of five nodes along x, each half as thick as the one before, with a twig at the third. */
const parent = [-1, 0, 1, 2, 3, 2];
const position = [0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 2, 1, 0];
const radius = [0.16, 0.16, 0.08, 0.04, 0.02, 0.01];

function frameOf(version: number, plant: number, first = 0, count = parent.length): Uint8Array {
  const words = [version, plant, first, count, parent.length, 7];
  const arrays = [
    new Uint32Array(words), new Int32Array(parent.slice(first, first + count)),
    new Float32Array(position.slice(3 * first, 3 * (first + count))), new Float32Array(radius),
    new Uint16Array(count).fill(2), new Uint16Array(count), new Uint8Array(count).fill(200),
  ];
  const bytes = arrays.reduce((sum, array) => sum + array.byteLength, 0);
  const frame = new Uint8Array(8 + bytes);
  new DataView(frame.buffer).setUint32(0, bytes, true);
  frame[4] = 2;
  let at = 8;
  for (const array of arrays) {
    frame.set(new Uint8Array(array.buffer), at);
    at += array.byteLength;
  }
  return frame;
}

const nodesOf = (frame: Uint8Array): NodesFrame => new FrameReader().push(frame)[0] as NodesFrame;

test("frames are whole again, in whatever pieces they come", () => {
  const odd = Uint8Array.from([3, 0, 0, 0, 99, 0, 0, 0, 1, 2, 3]); // of a kind that a later program may send
  const stream = Uint8Array.from([...frameOf(4, 0), ...odd, ...frameOf(4, 1)]);
  for (const size of [1, 7, 64, 1000]) {
    const reader = new FrameReader();
    const frames: Frame[] = [];
    for (let at = 0; at < stream.length; at += size) frames.push(...reader.push(stream.slice(at, at + size)));
    assert.deepEqual(frames.map((frame) => (frame as NodesFrame).plant), [0, 1], `pieces of ${size}`);
    assert.deepEqual([...(frames[1] as NodesFrame).parent], parent);
    assert.equal((frames[1] as NodesFrame).exposure[5], 200);
  }
});

test("a frame that is shorter than it says is refused", () => {
  const frame = frameOf(1, 0);
  new DataView(frame.buffer).setUint32(8 + 12, 1_000_000, true);
  assert.throws(() => new FrameReader().push(frame), RangeError);
});

test("the old plant stands until the new one has come", () => {
  let now = 0;
  const growth = new Growth(() => now);
  growth.take(nodesOf(frameOf(1, 0)));
  growth.settle(true);
  assert.equal(growth.shown.version, 1);
  growth.changes();
  growth.take(nodesOf(frameOf(2, 0, 0, 3)));
  assert.equal(growth.settle(false), false);
  assert.equal(growth.shown.segments, 5);
  growth.take(nodesOf(frameOf(1, 0, 0, 2))); // comes late, of a text that is gone
  now = 1000;
  assert.equal(growth.settle(false), true);
  assert.equal(growth.shown.version, 2);
  assert.equal(growth.shown.segments, 2);
  growth.changes();
  growth.take(nodesOf(frameOf(2, 0, 3, 3)));
  assert.deepEqual([...(growth.changes() as ReadonlySet<number>)], [0]);
  assert.equal(growth.shown.segments, 5);
  assert.equal(growth.waits_ms, 0);
});

function grown(): Skeleton {
  const skeleton = new Skeleton();
  skeleton.append(nodesOf(frameOf(1, 0)));
  return skeleton;
}

test("the thickest child goes on, the other begins a limb of its own", () => {
  assert.deepEqual(limbsOf(grown()).map((limb) => [...limb.nodes]), [[0, 1, 2, 3, 4], [2, 5]]);
});

test("tubes stand around their limbs", () => {
  const mesh = buildTubes([grown()], { middleRadius_m: 0.05, leastSides: 4, mostSides: 12, pieces: 2 });
  assert.equal(mesh.index.length, 3 * mesh.triangles);
  assert.ok(mesh.position.every(Number.isFinite) && mesh.data.every(Number.isFinite));
  const vertices = mesh.position.length / 3;
  assert.ok(mesh.index.every((index) => index < vertices));
  for (let v = 0; v < vertices; v++) {
    const [x = 0, y = 0, z = 0] = mesh.position.subarray(3 * v, 3 * v + 3);
    const radius_m = mesh.data[4 * v + 1] ?? 0;
    const fromStem = Math.hypot(y, z);
    const fromTwig = Math.hypot(x - 2, z);
    assert.ok(Math.min(Math.abs(fromStem - radius_m), Math.abs(fromTwig - radius_m), fromStem, fromTwig) < 1e-5, `vertex ${v}`);
    const normal = Math.hypot(...mesh.normal.subarray(3 * v, 3 * v + 3));
    assert.ok(Math.abs(normal - 1) < 1e-4, `normal ${v} is ${normal} long`);
  }
});
