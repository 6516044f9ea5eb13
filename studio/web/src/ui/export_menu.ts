// What goes out: the very files that `espalier grow` writes, and the view as a picture.
import { make } from "../base/dom";
import { askExport, type ExportWish } from "../protocol/api";
import { menuButton, type MenuPart } from "./menu";
import type { Notices } from "./notices";

export interface ExportHost {
  images(): { name: string; kind: string }[];
  picture(): Promise<Blob | null>;
  project(): string;
}

export function exportMenu(host: ExportHost, notices: Notices): HTMLButtonElement {
  const wish = (label: string, about: string, asked: ExportWish): MenuPart => ({ kind: "item", label, about, act: () => void fetchFiles(asked, label, notices) });
  return menuButton("Export", "Export", () => [
    wish("Model", "plant.glb: plants and scene, for Blender and others", { what: "glb" }),
    wish("Voxel world", "world.vdb: what is where, and its light", { what: "vdb" }),
    wish("Skeleton", "skeleton.json: what the model is made on", { what: "skeleton" }),
    { kind: "title", words: "finished pictures" },
    ...host.images().map((image) => wish(image.name, `drawn in full, ${image.kind.replaceAll("_", " ")}`, { what: "image", image: image.name })),
    { kind: "line" },
    { kind: "item", label: "This view", about: "as a PNG, as large as it is here", act: () => void savePicture(host, notices) },
  ]);
}

async function fetchFiles(wish: ExportWish, label: string, notices: Notices): Promise<void> {
  notices.say(`${label}: on its way; large worlds take a while.`);
  try {
    const { files } = await askExport(wish);
    for (const file of files) {
      download(file.address, file.name);
      notices.say(make("a", { href: file.address, download: file.name }, file.name), make("span", {}, size(file.bytes)));
    }
  } catch (error) {
    notices.fault(`${label}: ${error instanceof Error ? error.message : String(error)}`);
  }
}

async function savePicture(host: ExportHost, notices: Notices): Promise<void> {
  const blob = await host.picture();
  if (!blob) {
    notices.fault("The browser gave no picture of the view.");
    return;
  }
  const address = URL.createObjectURL(blob);
  download(address, `${host.project()}.png`);
  window.setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

function download(address: string, name: string): void {
  const link = make("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
}

const size = (bytes: number): string => (bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`);
