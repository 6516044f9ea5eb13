// What is measured on surfaces, asked for when it is wanted and again when it may have changed, with its legend.
import { askSurfaces } from "./protocol/api";
import type { Surfaces, SurfaceChannel } from "./protocol/surfaces";
import { showLegend } from "./ui/legend";
import { plantColours, surfaceChannel } from "./ui/view_bar";
import type { World } from "./view/world";

export class Overlays {
  channels: string[] = [];
  private surfaces: Surfaces | null = null;
  private abort: AbortController | null = null;
  private cut: number | null = null;
  private iterations = 1;

  constructor(private readonly world: World, private readonly legend: HTMLElement, private readonly version: () => number, private readonly failed: (words: string) => void) {
    surfaceChannel.onChange(() => void this.refresh());
    plantColours.onChange(() => this.draw());
  }

  /** A plant is done: what light is left for the surfaces may be another. */
  async refresh(always = false): Promise<void> {
    const name = surfaceChannel.value;
    if (name === "" && !always) {
      this.draw();
      return;
    }
    this.abort?.abort();
    const abort = (this.abort = new AbortController());
    try {
      const surfaces = await askSurfaces(this.version(), abort.signal);
      if (abort.signal.aborted) return;
      this.surfaces = surfaces;
      this.channels = surfaces.channels.map((channel) => channel.name);
      this.draw();
    } catch (error) {
      if (!abort.signal.aborted) this.failed(error instanceof Error ? error.message : String(error));
    }
  }

  grown(iterations: number): void {
    this.iterations = iterations;
  }

  private draw(): void {
    const channel = this.surfaces?.channels.find((each) => each.name === surfaceChannel.value);
    this.world.colours(plantColours.value);
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
