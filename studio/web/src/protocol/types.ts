// What the program says and is told, as studio/README.md has it. Lengths in metres, colours linear RGB.

export type Vec3 = [number, number, number];
export type Severity = "error" | "warning";

export interface ProjectFile {
  name: string;
  kind: "scene" | "rules";
  text: string;
  saved: string;
  library: boolean;
  /** Whether `text` is another than what lies in the file. */
  unsaved?: boolean;
}

export interface Project {
  name: string;
  version: number;
  program: string;
  threads: number;
  files: ProjectFile[];
  images: { name: string; kind: string }[];
}

export interface LibraryRules {
  name: string;
  about: string;
  text: string;
}

/** Lines and columns begin at 1 and count characters; a problem of a whole file has none. */
export interface Problem {
  file: string;
  line?: number | null;
  column?: number | null;
  end_line?: number | null;
  end_column?: number | null;
  severity: Severity;
  message: string;
  key?: string | null;
  fix?: string | null;
}

export interface SceneCamera {
  name: string;
  eye_m: Vec3;
  target_m: Vec3;
  fov_deg: number;
}

export interface SceneSeed {
  /** The planting's name. */
  planting: string;
  /** Its number among those of the planting. */
  seed: number;
  key: string;
  at_m: Vec3;
  movable: boolean;
}

export interface SceneEvent {
  event: "scene";
  version: number;
  name: string;
  site: string;
  low_m: Vec3;
  high_m: Vec3;
  voxel_m: number;
  size: Vec3;
  iterations: number;
  cameras: SceneCamera[];
  seeds: SceneSeed[];
  sun: { direction: Vec3; strength: number; colour: Vec3 };
  sky: { colour: Vec3; strength: number };
  fields: string[];
}

export interface LeafShape {
  name: string;
  positions: number[];
  normals: number[];
  uvs: number[];
  indices: number[];
  colour: Vec3;
  texture: string | null;
  opacity: number;
  emits: Vec3 | null;
}

export interface PlantLooks {
  name: string;
  stem: { colour: Vec3; shoot_colour: Vec3; texture: string | null; opacity: number; emits: Vec3 | null };
  /** null: those of the plant before it. */
  shapes: LeafShape[] | null;
}

export interface LooksEvent {
  event: "looks";
  version: number;
  plants: PlantLooks[];
}

export interface GrowthEvent {
  event: "growth";
  version: number;
  iteration: number;
  iterations: number;
  segments: number;
  elements: number;
  sites: number;
  done: boolean;
  seconds: number;
  hash?: string;
  ending?: string;
  plants: { name?: string; segments: number; elements: number; failure?: string | null }[];
  /** With `done`: a few lines on plants that did not thrive. */
  poor?: string | string[];
  outcomes?: { buds?: Record<string, number>; trials?: Record<string, number> };
}

export interface StagesEvent {
  event: "stages";
  version: number;
  ran: Record<string, number>;
  all: Record<string, number>;
  seconds: Record<string, number>;
}

export interface DiskEvent {
  event: "disk";
  version: number;
  file: string;
  saved: string;
  text: string;
}

export type ServerEvent =
  | { event: "hello"; version: number }
  | { event: "problems"; version: number; depth: "text" | "site"; problems: Problem[] }
  | { event: "busy"; version: number; stage: string; share: number }
  | { event: "project"; version: number }
  | SceneEvent
  | LooksEvent
  | GrowthEvent
  | StagesEvent
  | DiskEvent
  | { event: "end"; version: number };

export interface Trial {
  from_m: Vec3;
  to_m: Vec3;
  outcome: string;
  taken: boolean;
  words: string;
}

/** A question that a site asked in one iteration, and what came of it. */
export interface Asked {
  iteration: number;
  outcome: string;
  words: string;
  trials: Trial[];
}

export interface WhyAnswer {
  version: number;
  plant: number;
  node: number;
  name: string;
  at_m: Vec3;
  born: number;
  sensed: { name: string; value: number }[];
  /** How the node came to be. */
  came: Asked | null;
  /** What the sites at it tried last. */
  last: Asked | null;
}

export interface PlaceAnswer {
  file: string;
  edits: { from: { line: number; column: number }; to: { line: number; column: number }; insert: string }[];
}

export interface ExportAnswer {
  files: { name: string; bytes: number; address: string }[];
}
