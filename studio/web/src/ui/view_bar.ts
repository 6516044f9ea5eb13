// What is on the glass of the view: cameras, what is drawn on surfaces and on the plant, and switches.
import { make, refill } from "../base/dom";
import { isBoolean, isText, oneOf, remembered } from "../base/settings";
import type { SceneCamera } from "../protocol/types";
import type { PlantColours } from "../view/plant_material";
import { menuButton, type MenuPart } from "./menu";

export const surfaceChannel = remembered("surfaces", "", isText);
/** A choice of surfaces that is none of the measured ones. */
export const layersChoice = "boundary layers";
export const plantColours = remembered<PlantColours>("colours", "natural", oneOf("natural", "age", "exposure"));
export const seedsShown = remembered("seeds", true, isBoolean);
export const plantsShown = remembered("plants", true, isBoolean);

export interface ViewBarHost {
  cameras(): SceneCamera[];
  jump(camera: SceneCamera): void;
  saveCamera(): void;
  /** Those that the program measures here, once it has been asked. */
  channels(): string[];
}

export function viewBar(place: HTMLElement, host: ViewBarHost): void {
  const radio = (label: string, ticked: boolean, act: () => void, about?: string): MenuPart => ({ kind: "item", label, ticked, radio: true, act, ...(about ? { about } : {}) });
  const cameras = menuButton("View", "Cameras of the scene", () => [
    ...host.cameras().map((camera): MenuPart => ({ kind: "item", label: camera.name, act: () => host.jump(camera) })),
    { kind: "line" },
    { kind: "item", label: "Save this view into the scene…", act: () => host.saveCamera() },
  ]);
  const surfaces = menuButton(make("span", {}, "Surfaces"), "What is drawn on surfaces", () => [
    radio("As they are", surfaceChannel.value === "", () => (surfaceChannel.value = "")),
    radio("Boundary layers", surfaceChannel.value === layersChoice, () => (surfaceChannel.value = layersChoice), "A cut through how near things are"),
    { kind: "title", words: "measured" },
    ...host.channels().map((name) => radio(name, surfaceChannel.value === name, () => (surfaceChannel.value = name))),
  ]);
  const plant = menuButton(make("span", {}, "Plant"), "What is drawn on the plant", () => [
    radio("As it looks", plantColours.value === "natural", () => (plantColours.value = "natural")),
    radio("Age", plantColours.value === "age", () => (plantColours.value = "age"), "When each part grew"),
    radio("Exposure", plantColours.value === "exposure", () => (plantColours.value = "exposure"), "How much light it felt there"),
    { kind: "line" },
    { kind: "item", label: "Plants", ticked: plantsShown.value, act: () => (plantsShown.value = !plantsShown.value) },
    { kind: "item", label: "Seeds", ticked: seedsShown.value, act: () => (seedsShown.value = !seedsShown.value) },
  ]);
  surfaceChannel.watch((name) => surfaces.setAttribute("aria-pressed", String(name !== "")));
  plantColours.watch((name) => plant.setAttribute("aria-pressed", String(name !== "natural")));
  refill(place, cameras, make("span", { class: "gap" }), surfaces, plant);
}
