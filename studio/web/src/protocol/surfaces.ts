// What falls on the site's surfaces, voxel by voxel, as GET /api/surfaces sends it.
import type { Vec3 } from "./types";

export interface SurfaceChannel {
  name: string;
  unit: string;
  low: number;
  high: number;
  /** From which a plant grows. */
  least?: number;
  /** 0: low, 254: high, 255: none. */
  values: Uint8Array;
}

export interface Surfaces {
  version: number;
  count: number;
  low_m: Vec3;
  voxel_m: number;
  channels: SurfaceChannel[];
  /** Three for each voxel; 0 is the one whose middle is low_m. */
  voxels: Uint16Array;
  /** Bits from the lowest: -x, +x, -y, +y, -z, +z: which faces are open. */
  faces: Uint8Array;
}

interface Head {
  version: number;
  count: number;
  low_m: Vec3;
  voxel_m: number;
  channels: { name: string; unit: string; low: number; high: number; least?: number }[];
}

export function readSurfaces(data: ArrayBuffer): Surfaces {
  const bytes = new DataView(data).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, bytes))) as Head;
  let at = 4 + bytes;
  const voxels = new Uint16Array(data, at, 3 * head.count);
  at += 6 * head.count;
  const faces = new Uint8Array(data, at, head.count);
  at += head.count;
  const channels = head.channels.map((channel) => {
    const values = new Uint8Array(data, at, head.count);
    at += head.count;
    return { ...channel, values };
  });
  return { version: head.version, count: head.count, low_m: head.low_m, voxel_m: head.voxel_m, channels, voxels, faces };
}
