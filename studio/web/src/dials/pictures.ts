// Small pictures of what a number does, drawn with its value: 40 wide, 32 high. A limb is drawn in ink, what the number
// moves in the accent's colour.
import type { Dial } from "./dial";
import { planKey } from "./plan";

const ink = 'stroke="var(--ink-soft)" stroke-width="1.6" fill="none" stroke-linecap="round"';
const mark = 'stroke="var(--accent-strong)" stroke-width="2" fill="none" stroke-linecap="round"';
const faint = 'stroke="var(--ink-faint)" stroke-width="1.2" fill="none" stroke-dasharray="2 2.4"';
const ground = '<path d="M4 29.5H36" stroke="var(--edge-strong)" stroke-width="1.4"/>';
const leafPath = (x: number, y: number, turn: number, size: number): string =>
  `<path transform="translate(${x} ${y}) rotate(${turn}) scale(${size})" d="M0 0C-3-3-3-7 0-10 3-7 3-3 0 0Z" fill="var(--accent)"/>`;

const n = (value: number): string => value.toFixed(1);

function polar(x: number, y: number, degrees: number, length: number): [number, number] {
  const radians = ((degrees - 90) * Math.PI) / 180;
  return [x + length * Math.cos(radians), y + length * Math.sin(radians)];
}

function ray(x: number, y: number, degrees: number, length: number, style: string): string {
  const [tx, ty] = polar(x, y, degrees, length);
  return `<path d="M${n(x)} ${n(y)}L${n(tx)} ${n(ty)}" ${style}/>`;
}

type Draw = (share: number, value: number, values: number[]) => string;

const wall = '<path d="M33 3V29" stroke="var(--edge-strong)" stroke-width="5"/>';

const sunAt = (x: number, y: number, light: number): string =>
  `<circle cx="${x}" cy="${y}" r="4" fill="var(--sun)" opacity="${n(0.25 + 0.75 * light)}"/>`;

const draws: Record<string, Draw> = {
  length: (share) => ground + ray(20, 29, 0, 5 + 20 * share, mark) + `<circle cx="20" cy="${n(24 - 20 * share)}" r="2" fill="var(--accent-strong)"/>`,
  angle: (_, __, values) => ground + ray(18, 29, 0, 25, ink) + values.map((each) => ray(18, 18, each, 13, mark)).join(""),
  ages: (_, __, values) => `<path d="M5 22H35" ${ink}/>` + [1, 2, 3, 4, 5, 6].map((i) => `<circle cx="${n(5 + i * 4.6)}" cy="22" r="1.5" fill="${i >= (values[0] ?? 0) && i <= (values[1] ?? values[0] ?? 0) ? "var(--accent-strong)" : "var(--ink-faint)"}"/>`).join("") + ray(n6(values[0]), 22, 35, 13, mark),
  wander: (_, value) => ray(20, 29, 0, 11, ink) + [-1, -0.5, 0, 0.5, 1].map((k) => ray(20, 18, k * Math.min(170, value), 13, k === 0 ? mark : faint)).join(""),
  up: (share) => ground + `<path d="M10 29C${n(10 + 6 * (1 - share))} ${n(20 - 2 * share)} ${n(28 - 18 * share)} ${n(18 - 6 * share)} ${n(34 - 24 * share)} ${n(17 - 13 * share)}" ${mark}/>`,
  down: (share) => `<path d="M8 6C16 6 24 ${n(8 + 2 * share)} ${n(34 - 10 * share)} ${n(8 + 21 * share)}" ${mark}/>`,
  light: (share) => sunAt(31, 7, 1) + ground + `<path d="M10 29C10 20 ${n(10 + 6 * share)} ${n(14)} ${n(10 + 15 * share)} ${n(6 + 4 * share)}" ${mark}/>`,
  toward: (share) => wall + `<path d="M12 29C12 20 ${n(12 + 8 * share)} 14 ${n(12 + 16 * share)} 5" ${mark}/>`,
  away: (share) => wall + `<path d="M26 29C26 20 ${n(26 - 8 * share)} 14 ${n(26 - 18 * share)} 5" ${mark}/>`,
  twist: (share) => `<path d="M20 3V29" stroke="var(--edge-strong)" stroke-width="6"/>` + `<path d="M13 27C13 ${n(27 - 5 * share)} 27 ${n(26 - 3 * share)} 27 ${n(25 - 7 * share)}S13 ${n(20 - 8 * share)} 13 ${n(17 - 10 * share)}" ${mark}/>`,
  near: (share) => wall + `<path d="M${n(29 - 22 * share)} 3V29" ${faint}/>` + `<path d="M27 29C24 22 ${n(29 - 10 * share)} 16 ${n(28 - 9 * share)} 5" ${mark}/>`,
  at: (share) => wall + `<path d="M${n(29 - 20 * share)} 29V4" ${mark}/><path d="M${n(29 - 20 * share)} 16H30" ${faint}/>`,
  dark: (share) => `<path d="M4 4H36V28H4Z" fill="var(--ink)" opacity="${n(0.06 + 0.0 * share)}"/><path d="M4 ${n(28 - 24 * (1 - share))}H36V28H4Z" fill="var(--ink)" opacity=".22"/>` + sunAt(30, 8, 1) + `<path d="M12 27V${n(27 - 21 * share)}" ${mark}/>`,
  boost: (share) => ground + leafPath(11, 29, 0, 0.8) + leafPath(28, 29, 0, 0.8 + 1.5 * share) + sunAt(35, 5, 1),
  blend: (share) => `<circle cx="20" cy="16" r="11" fill="var(--sky)"/><path d="M20 16L20 5A11 11 0 ${share > 0.5 ? 1 : 0} 1 ${polar(20, 16, 359.9 * share, 11).map(n).join(" ")}Z" fill="var(--sun)"/>`,
  leaves: (share) => ray(20, 30, 0, 26, ink) + Array.from({ length: Math.max(1, Math.round(7 * share)) }, (_, i) => leafPath(20, 27 - i * 3.4, i % 2 ? 62 : -62, 0.72)).join(""),
  leaf: (share) => leafPath(20, 30, 0, 0.7 + 2 * share),
  face: (share) => sunAt(20, 5, 1) + `<path d="M8 29H32" ${faint}/>` + `<ellipse cx="20" cy="20" rx="10" ry="${n(1 + 6 * share)}" fill="var(--accent)" transform="rotate(${n(30 * (1 - share))} 20 20)"/>`,
  radius: (share) => `<path d="M20 30V3" stroke="var(--ink-soft)" stroke-width="${n(1.5 + 10 * share)}" stroke-linecap="round"/>`,
  exponent: (share) => `<path d="M20 30V17" stroke="var(--ink-soft)" stroke-width="${n(9 - 4.5 * share)}"/><path d="M20 18L11 4M20 18L29 4" stroke="var(--accent-strong)" stroke-width="4" stroke-linecap="round"/>`,
  trials: (share) => Array.from({ length: 3 + Math.round(8 * share) }, (_, i, ) => ray(20, 28, -65 + (130 * i) / (2 + Math.round(8 * share)), 20, i === 1 + Math.round(4 * share) ? mark : faint)).join(""),
  kill: (share) => `<circle cx="20" cy="16" r="${n(4 + 9 * share)}" ${faint}/><circle cx="20" cy="16" r="2.2" fill="var(--accent-strong)"/>` + [[8, 8], [31, 9], [29, 26], [9, 25]].map(([x, y]) => `<circle cx="${x}" cy="${y}" r="1.3" fill="var(--ink-faint)"/>`).join(""),
  gap: (share) => `<rect x="3" y="9" width="${n(15 - 5 * share)}" height="14" rx="2" fill="var(--accent)"/><rect x="${n(22 + 5 * share)}" y="9" width="${n(15 - 5 * share)}" height="14" rx="2" fill="var(--ink-faint)"/>`,
  fill: (share) => Array.from({ length: 12 }, (_, i) => `<rect x="${5 + (i % 4) * 8}" y="${4 + Math.floor(i / 4) * 9}" width="6" height="7" rx="1" fill="var(${(i * 5) % 12 < 12 * share ? "--accent" : "--edge"})"/>`).join(""),
  turn: (_, value) => `<rect x="13" y="9" width="14" height="14" rx="2" fill="none" stroke="var(--ink-faint)"/><rect x="13" y="9" width="14" height="14" rx="2" fill="var(--accent)" opacity=".85" transform="rotate(${n(Math.min(90, value))} 20 16)"/>`,
  voxel: (share) => { const size = 4 + 10 * share; let out = ""; for (let x = 4; x < 35; x += size) out += `<path d="M${n(x)} 3V29" stroke="var(--edge-strong)"/>`; for (let y = 3; y < 29; y += size) out += `<path d="M4 ${n(y)}H36" stroke="var(--edge-strong)"/>`; return out + `<rect x="4" y="3" width="${n(size)}" height="${n(size)}" fill="var(--accent)"/>`; },
  arc: (_, value) => ground + `<path d="M${n(6 + value / 9)} 29A14 ${n(24 * Math.cos((value * Math.PI) / 180))} 0 0 1 ${n(34 + value / 18)} 29" ${faint}/>` + sunAt(20 + value / 8, 29 - 23 * Math.cos((value * Math.PI) / 180), 1),
  compass: (_, value) => `<circle cx="20" cy="16" r="12" stroke="var(--edge-strong)" fill="none"/>` + ray(20, 16, value, 11, mark) + `<path d="M20 2V6" ${ink}/>`,
  hour: (_, value) => `<circle cx="20" cy="16" r="12" stroke="var(--edge-strong)" fill="none"/>` + ray(20, 16, (value % 12) * 30, 9, mark) + `<circle cx="20" cy="16" r="1.5" fill="var(--ink-soft)"/>`,
};

function n6(value: number | undefined): number {
  return 5 + Math.min(6, value ?? 1) * 4.6;
}

const whose: Record<string, string> = {
  "random_tree.length": "length", "colonization.step": "length", "random_tree.branch_angle": "angle", "random_tree.fork_angle": "angle",
  "colonization.branching.angle.min": "angle", "colonization.branching.angle.max": "angle", "random_tree.branch_age_range": "ages",
  "random_tree.wander.angle": "wander", "random_tree.wander": "wander", "bias.up": "up", "bias.gravity": "down", "bias.light.amount": "light", "bias.light": "light",
  "bias.toward": "toward", "bias.away": "away", "bias.twist.amount": "twist", "bias.twist": "twist", "require.proximity.max": "near",
  "require.proximity.min": "at", "prefer.proximity": "at", "require.exposure.min": "dark", "require.exposure.max": "dark", "light.boost": "boost",
  "light.blend.sun": "blend", "light.blend.sky": "blend", "elements.#.per_segment": "leaves", "elements.#.size": "leaf", "elements.#.face": "face",
  "stem.radius": "radius", "stem.thickest": "radius", "stem.thickens": "radius", "stem.exponent": "exponent", "random_tree.trials.min": "trials", "random_tree.trials.max": "trials",
  "elements.#.trials": "trials", "colonization.kill": "kill", "colonization.influence": "kill", "diffusion.distance": "gap", "diffusion.gap.min": "gap",
  "diffusion.gap": "gap", "diffusion.turn": "turn", "diffusion.fill": "fill", "world.voxel": "voxel", "sun.tilt": "arc", "sun.toward": "compass", "sun.north": "compass", "sun.shadow_hour": "hour",
};

/** The inside of a drawing 40 by 32; empty where there is none for this key. */
export function pictureOf(dial: Dial): string {
  const draw = draws[whose[planKey(dial.path)] ?? ""];
  if (!draw) return "";
  const value = dial.values[dial.values.length - 1] ?? 0;
  const share = Math.min(1, Math.max(0, Math.abs(value - (dial.low < 0 ? 0 : dial.low)) / (dial.high - Math.max(0, dial.low) || 1)));
  return draw(share, value, dial.values);
}
