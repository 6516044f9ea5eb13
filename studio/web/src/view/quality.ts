// How much may be drawn: all of it where there is a graphics processor, less where a program paints in its place. That
// is known from the renderer's name, and seen from how long pictures take.

export interface Quality {
  /** Triangles of all leaves together. */
  leaves_triangles: number;
  /** Of stems: 1 as fine as they come; less is coarser. */
  stems: number;
  shadow_px: number;
  /** A program paints: smooth edges, all pixels and shadows only where nothing moves. */
  painted: boolean;
}

const full: Quality = { leaves_triangles: 1_150_000, stems: 1, shadow_px: 2048, painted: false };
const painted: Quality = { leaves_triangles: 60_000, stems: 0.3, shadow_px: 1024, painted: true };

/** Asked of a canvas of its own, before the view's is made: whether that has smooth edges cannot be changed later. */
export function qualityHere(): Quality {
  const gl = document.createElement("canvas").getContext("webgl2");
  const about = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && about ? String(gl.getParameter(about.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(name) ? painted : full;
}
