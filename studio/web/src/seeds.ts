// Seeds and cameras written into the scene: the program says which change of the text does it, the page makes it.
// While a seed is dragged, one change is made at a time and the newest place wins.
import type { Editor } from "./editor/editor";
import type { Workspace } from "./editor/workspace";
import { askPlace, type Place } from "./protocol/api";
import type { PlaceAnswer, SceneSeed, Vec3 } from "./protocol/types";
import { offsetOf, type Change } from "./yaml/edit";

export class Placing {
  private wanted: Place | null = null;
  private running = false;
  private letGo = false;

  constructor(private readonly workspace: Workspace, private readonly editor: Editor, private readonly failed: (words: string) => void) {}

  /** One step of undo. */
  async put(place: Place): Promise<void> {
    try {
      await this.workspace.send();
      const answer = await askPlace(place);
      this.editor.change(answer.file, this.changes(answer));
    } catch (error) {
      this.failed(wordsOf(error));
    }
  }

  move(seed: SceneSeed, at_m: Vec3): void {
    this.wanted = { planting: seed.planting, seed: seed.seed, at_m };
    this.letGo = false;
    void this.run();
  }

  drop(): void {
    this.letGo = true;
    if (!this.running) this.finish();
  }

  get busy(): boolean {
    return this.running || this.wanted !== null;
  }

  private async run(): Promise<void> {
    if (this.running) return;
    this.running = true;
    try {
      while (this.wanted) {
        const place = this.wanted;
        this.wanted = null;
        await this.workspace.send();
        const answer = await askPlace(place);
        for (const change of this.changes(answer)) this.editor.drag(answer.file, change);
      }
    } catch (error) {
      this.wanted = null;
      this.failed(wordsOf(error));
    } finally {
      this.running = false;
    }
    if (this.letGo) this.finish();
  }

  private finish(): void {
    this.letGo = false;
    this.editor.dropped();
  }

  /** From behind, so that each leaves the places of those before it as they are. */
  private changes(answer: PlaceAnswer): Change[] {
    const text = this.editor.textOf(answer.file);
    return answer.edits
      .map((edit) => ({ from: offsetOf(text, edit.from.line, edit.from.column), to: offsetOf(text, edit.to.line, edit.to.column), insert: edit.insert }))
      .sort((a, b) => b.from - a.from);
  }
}

const wordsOf = (error: unknown): string => (error instanceof Error ? error.message : String(error));
