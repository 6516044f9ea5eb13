// The page: its parts made, and joined to one another.
import { make } from "./base/dom";
import { isBoolean, isText, remembered } from "./base/settings";
import { DialPanel, type DialHost } from "./dials/panel";
import { basesOf, fileMeant } from "./dials/bases";
import { completer } from "./editor/completion";
import { Editor } from "./editor/editor";
import { keyHover } from "./editor/hover";
import { Workspace } from "./editor/workspace";
import { Live } from "./live";
import { Overlays } from "./overlays";
import { askLibrary, askProject, askSchema, askWhy, isOvertaken } from "./protocol/api";
import { Stream } from "./protocol/stream";
import type { LibraryRules, Project } from "./protocol/types";
import { SchemaBook } from "./schema/schema";
import { Placing } from "./seeds";
import { conflictBar } from "./ui/conflict";
import { askName, showKeys } from "./ui/dialogs";
import { exportMenu } from "./ui/export_menu";
import { menuButton } from "./ui/menu";
import { Notices } from "./ui/notices";
import { Numbers } from "./ui/numbers";
import { paneKeys } from "./ui/panes";
import { presetMenu } from "./ui/presets";
import { Scrubber } from "./ui/scrubber";
import { splitter } from "./ui/splitters";
import { Status } from "./ui/status";
import { Tabs } from "./ui/tabs";
import { dark, themeWish } from "./ui/theme";
import { plantColours, plantsShown, seedsShown, viewBar } from "./ui/view_bar";
import { showWhy } from "./ui/why_card";
import { Hands } from "./view/hands";
import { World, type DrawnCounts } from "./view/world";
import { letTestsIn } from "./handle";

const byId = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const words = (error: unknown): string => (error instanceof Error ? error.message : String(error));

const books: { rules: SchemaBook | null; scene: SchemaBook | null } = { rules: null, scene: null };
let library: LibraryRules[] = [];
let project: Project | null = null;
let counts: DrawnCounts = { triangles: 0, calls: 0, frame_ms: 0, geometries: 0, textures: 0 };
let until = Infinity;

const notices = new Notices(byId("notices"));
const status = new Status(byId("status"));
const numbers = new Numbers(byId("numbers"));
const workspace = new Workspace();
const bookOf = (file: string) => books[workspace.file(file)?.kind ?? "rules"];

const dialHost: DialHost = {
  textOf: (file) => editor.textOf(file),
  drag: (file, change) => editor.drag(file, change),
  dropped: () => editor.dropped(),
  change: (file, change) => editor.change(file, change),
  bases: (root) => basesOf(root, textNamed, library),
  show: (file, offset) => editor.goTo(file, offset),
};

function textNamed(name: string): string | null {
  const file = fileMeant(name, workspace.files.value);
  return file === null ? null : editor.textOf(file);
}

const editor = new Editor(byId("editor"), workspace, {
  completion: (file) => completer(() => bookOf(file), () => library),
  hover: (file) => keyHover(file, () => bookOf(file), dialHost),
  save: () => void save(),
});
const dials = new DialPanel(byId("dials-body"), dialHost);
const tabs = new Tabs(byId("tabs"), workspace, (name) => editor.show(name));
const lastTab = remembered("tab", "", isText);

const world = new World(byId<HTMLCanvasElement>("canvas"), byId("stage"), drawn, (why) => notices.fault(`The scene's meshes: ${why}`));
const live = new Live(workspace, {
  scene: (scene) => {
    world.describe(scene, !hands.holdsSeed);
    hands.voxel = scene.voxel_m;
  },
  grown: (changed) => {
    world.grow(live.growth.shown, live.looks, changed);
    if (workspace.editedAt_ms) {
      numbers.answered((performance.now() - workspace.editedAt_ms) / 1000);
      workspace.editedAt_ms = 0;
    }
    scrubber.grown(live.growth.shown.iteration, live.scene.value?.iterations ?? 1);
    leave();
  },
  growth: (event) => {
    numbers.growth(event);
    overlays.grown(event.iteration);
    if (event.done) void overlays.refresh(overlays.channels.length === 0);
  },
  stages: (event) => numbers.times(event),
  busy: (stage, share) => status.doing(stage, share),
  project: () => void openProject(),
  hello: () => void openProject(),
});
const scrubber = new Scrubber(byId("scrubber"), (iteration) => {
  until = iteration;
  world.until(iteration);
});
const overlays = new Overlays(world, byId("legend"), {
  version: () => live.done.value?.version ?? workspace.version.value, scene: () => live.scene.value, failed: (why) => notices.fault(why),
});
const placing = new Placing(workspace, editor, (why) => notices.fault(why));
const hands = new Hands(world, {
  shown: () => live.growth.shown,
  until: () => until,
  why: (picked) => void why(picked.plant, picked.node),
  seedAt: (seed, at_m) => placing.move(seed, at_m),
  seedDropped: () => placing.drop(),
  addSeed: (at_m) => {
    const seeds = live.scene.value?.seeds ?? [];
    const planting = (world.seeds.seeds[world.seeds.selection] ?? seeds[0])?.planting;
    if (planting === undefined) notices.fault("The scene has no planting yet to which a seed could be added.");
    else void placing.put({ planting, at_m });
  },
  leave,
});

function drawn(now: DrawnCounts): void {
  counts = now;
  byId("drawn").textContent = `${(now.triangles / 1000).toFixed(0)}k triangles · ${now.calls} calls`;
}

async function why(plant: number, node: number): Promise<void> {
  try {
    const answer = await askWhy(live.done.value?.version ?? workspace.version.value, plant, node);
    showWhy(byId("card"), answer, {
      draw: (asked) => {
        world.trials.show(answer.at_m, asked);
        world.invalidate();
      },
      close: leave,
    });
  } catch (error) {
    if (!isOvertaken(error)) notices.fault(words(error));
  }
}

function leave(): void {
  if (byId("card").hidden) return;
  byId("card").hidden = true;
  world.trials.clear();
  world.invalidate();
}

async function save(): Promise<void> {
  const name = editor.active.value;
  try {
    if (await workspace.save(name)) notices.say(`${name} is saved.`);
  } catch (error) {
    notices.fault(`${name} could not be saved: ${words(error)}`);
  }
}

function saveCamera(): void {
  askName("A name for this view", "view", (camera) => void placing.put({ camera, ...world.eye.here }));
}

async function openProject(): Promise<void> {
  try {
    project = await askProject();
  } catch (error) {
    notices.fault(words(error));
    return;
  }
  byId("project").textContent = project.name.replaceAll("_", " ");
  document.title = `${project.name} · Espalier studio`;
  const changed = workspace.take(project);
  editor.take(changed.map((file) => file.name));
  if (!workspace.file(editor.active.value)) {
    const names = Tabs.order(workspace.files.value);
    const first = names.find((file) => file.name === lastTab.value) ?? names[0];
    if (first) editor.show(first.name);
  }
}

function showDials(): void {
  const file = workspace.file(editor.active.value);
  if (file) dials.show(file.name, file.kind, books[file.kind], file.library);
}

function frame(): void {
  const panes = byId("panes");
  const rest = () => panes.clientWidth - 20;
  splitter(byId("split-write"), panes, "write", Math.round(Math.min(560, window.innerWidth * 0.35)), 240, () => rest() - 480);
  splitter(byId("split-dials"), panes, "dials", 244, 180, () => 420);
  const withDials = remembered("with_dials", true, isBoolean);
  const dialsButton = make("button", { class: "button", type: "button", onclick: () => (withDials.value = !withDials.value) }, "Dials");
  withDials.watch((on) => {
    panes.classList.toggle("without-dials", !on);
    dialsButton.setAttribute("aria-pressed", String(on));
  });
  byId("menus").append(
    presetMenu(() => library, workspace, editor, notices),
    exportMenu({ images: () => project?.images ?? [], picture: () => world.picture(), project: () => project?.name ?? "espalier" }, notices),
    dialsButton);
  const saveButton = make("button", { class: "button is-plain", type: "button", onclick: () => void save() }, "Save");
  const themes = (["system", "light", "dark"] as const).map((wish) => ({ wish, label: { system: "As the system", light: "Light", dark: "Dark" }[wish] }));
  byId("tools").append(
    saveButton,
    menuButton(make("span", {}, "◐"), "Light or dark", () => themes.map(({ wish, label }) => ({ kind: "item" as const, label, radio: true, ticked: themeWish.value === wish, act: () => (themeWish.value = wish) }))),
    make("button", { class: "button", type: "button", "aria-label": "Keys", title: "What the keys do", onclick: showKeys }, "?"));
  workspace.files.watch(() => (saveButton.disabled = !workspace.file(editor.active.value)?.unsaved));
  editor.active.onChange(() => workspace.files.tell());
  viewBar(byId("view-bar"), {
    cameras: () => live.scene.value?.cameras ?? [], jump: (camera) => world.eye.jump(camera), saveCamera, channels: () => overlays.channels,
  });
  conflictBar(byId("conflict"), workspace, editor);
  paneKeys([
    () => byId("editor").querySelector<HTMLElement>(".cm-content"),
    () => (withDials.value ? byId("dials").querySelector<HTMLElement>("[role=slider]") : null),
    () => byId("canvas"), () => byId("menus").querySelector("button"),
  ]);
}

function follow(): void {
  editor.active.onChange((name) => {
    tabs.current = name;
    lastTab.value = name;
    showDials();
  });
  let due = 0;
  editor.text.onChange(() => {
    // The text goes on its way first; sliders follow with the next picture.
    if (!due) due = requestAnimationFrame(() => ((due = 0), dials.refresh()));
  });
  workspace.problems.watch((problems) => status.wrong(problems.filter((each) => each.severity === "error").length));
  dark.watch((is) => world.theme(is));
  seedsShown.watch((shown) => (world.seedsShown = shown));
  plantsShown.watch((shown) => (world.plantsShown = shown));
  plantColours.watch((colours) => world.colours(colours));
  window.addEventListener("beforeunload", (event) => {
    if (workspace.files.value.some((file) => file.unsaved)) event.preventDefault();
  });
  window.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") {
      event.preventDefault();
      void save();
    }
  });
}

async function begin(): Promise<void> {
  frame();
  follow();
  const [rules, scene, sets] = await Promise.all([askSchema("rules"), askSchema("scene"), askLibrary()]);
  books.rules = new SchemaBook(rules);
  books.scene = new SchemaBook(scene);
  library = sets;
  showDials();
}

const stream = new Stream({
  frame: (each) => live.take(each),
  line: (line, retryIn_ms) => {
    status.connection(line, retryIn_ms);
    if (line === "open") workspace.send().catch((error) => notices.fault(words(error)));
  },
});
stream.open();
begin().catch((error) => notices.fault(words(error)));

letTestsIn({ world, live, editor, workspace, counts: () => counts, dragging: () => hands.holdsSeed || placing.busy });
