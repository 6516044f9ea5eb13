// What is measured on surfaces and how near things are, asked for when it is wanted and again when it may have changed,
// with its legend.
import { isNumber, oneOf, remembered } from "./base/settings";
import { askLayers, askSurfaces, isOvertaken } from "./protocol/api";
import { axes, type Axis } from "./protocol/layers";
import type { Surfaces, SurfaceChannel } from "./protocol/surfaces";
import type { SceneEvent } from "./protocol/types";
import { showCutLegend } from "./ui/cut_legend";
import { showLegend } from "./ui/legend";
import { layersChoice, plantColours, surfaceChannel } from "./ui/view_bar";
import type { World } from "./view/world";

export interface OverlayHost {
  version(): number;
  scene(): SceneEvent | null;
  failed(words: string): void;
}

const cutAxis = remembered<Axis>("cut_axis", "z", oneOf(...axes));
const cutShare = remembered("cut_share", 0.5, isNumber);

export class Overlays {
  channels: string[] = [];
  private surfaces: Surfaces | null = null;
  private abort: AbortController | null = null;
  private cut: number | null = null;
  private iterations = 1;

  constructor(private readonly world: World, private readonly legend: HTMLElement, private readonly host: OverlayHost) {
    surfaceChannel.onChange(() => void this.refresh());
    plantColours.onChange(() => this.draw());
  }

  /** A plant is done: what light is left for the surfaces may be another. */
  async refresh(always = false): Promise<void> {
    const name = surfaceChannel.value;
    if (name !== layersChoice) this.world.cut.clear();
    if (name === "" && !always) {
      this.draw();
      return;
    }
    this.abort?.abort();
    const { signal } = (this.abort = new AbortController());
    try {
      if (name === layersChoice) await this.layers(signal);
      if (name === layersChoice && !always) return;
      const surfaces = await askSurfaces(this.host.version(), signal);
      if (signal.aborted) return;
      this.surfaces = surfaces;
      this.channels = surfaces.channels.map((channel) => channel.name);
      if (name !== layersChoice) this.draw();
    } catch (error) {
      if (!signal.aborted && !isOvertaken(error)) this.host.failed(error instanceof Error ? error.message : String(error));
    }
  }

  grown(iterations: number): void {
    this.iterations = iterations;
  }

  private async layers(signal: AbortSignal): Promise<void> {
    const scene = this.host.scene();
    if (!scene) return;
    const k = axes.indexOf(cutAxis.value);
    const [low, voxels] = [scene.low_m[k] ?? 0, scene.size[k] ?? 1];
    const at_m = (share: number) => low + (Math.min(voxels - 1, Math.floor(share * voxels)) + 0.5) * scene.voxel_m;
    const cut = await askLayers(this.host.version(), cutAxis.value, at_m(cutShare.value), signal);
    if (signal.aborted) return;
    this.world.faces.clear();
    this.world.cut.show(cut);
    this.world.colours(plantColours.value);
    const moved = this.legend.contains(document.activeElement) && document.activeElement instanceof HTMLInputElement;
    if (moved) return; // the hand is on its slider, which says already where the cut is
    showCutLegend(this.legend, {
      axis: cutAxis.value, share: cutShare.value, at_m, layers: cut.layers,
      move: (axis, share) => {
        cutAxis.value = axis;
        cutShare.value = share;
        void this.refresh();
      },
    });
  }

  private draw(): void {
    this.world.colours(plantColours.value);
    if (surfaceChannel.value === layersChoice) return;
    const channel = this.surfaces?.channels.find((each) => each.name === surfaceChannel.value);
    if (this.surfaces && channel) this.world.faces.show(this.surfaces, channel.name, this.cut);
    else this.world.faces.clear();
    this.world.invalidate();
    if (channel) this.channelLegend(channel);
    else if (plantColours.value === "natural") showLegend(this.legend, null);
    else if (plantColours.value === "age") this.plantLegend("Age of the plant", "first iteration", `the ${this.iterations}th`);
    else this.plantLegend("Exposure where it grew", "0", "1");
  }

  private plantLegend(title: string, low: string, high: string): void {
    showLegend(this.legend, { title, low, high, cut: undefined, cutWords: () => "", setCut: () => undefined });
  }

  private channelLegend(channel: SurfaceChannel): void {
    const unit = channel.unit ? ` ${channel.unit}` : "";
    const value = (share: number) => channel.low + share * (channel.high - channel.low);
    const words = (share: number) => `${Number(value(share).toPrecision(2))}${unit}`;
    showLegend(this.legend, {
      title: channel.name, low: words(0), high: words(1), cut: this.cut, cutWords: words,
      first: channel.least === undefined ? 0.3 : (channel.least - channel.low) / (channel.high - channel.low || 1),
      setCut: (share) => {
        this.cut = share;
        this.world.faces.cut = share;
        this.world.invalidate();
      },
    });
  }
}
