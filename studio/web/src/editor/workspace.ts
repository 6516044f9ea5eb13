// The texts that are being written. They are the truth: whatever the page shows follows from them. An edit goes to the
// program after a breath of quiet, the newest wins, and what could not be sent is sent again when the line is back.
import { ApiError, sendEdit, sendSave } from "../protocol/api";
import { Signal } from "../base/signal";
import type { Problem, Project } from "../protocol/types";

const quiet_ms = 25;

export interface OpenFile {
  name: string;
  kind: "scene" | "rules";
  library: boolean;
  /** The hash of what lies in the file. */
  saved: string;
  /** What lies in the file, where this page knows it. */
  savedText: string | null;
  text: string;
  unsaved: boolean;
  /** What another hand has written into the file meanwhile. */
  theirs: { text: string; saved: string } | null;
}

export class Workspace {
  readonly files = new Signal<OpenFile[]>([]);
  readonly problems = new Signal<Problem[]>([]);
  readonly version = new Signal(0);
  /** Set while an edit is on its way or waits for the line. */
  readonly sending = new Signal(false);
  /** When the last edit was made, to tell how long its plant took. */
  editedAt_ms = 0;
  private readonly waiting = new Map<string, string>();
  private timer = 0;
  private abort: AbortController | null = null;

  file(name: string): OpenFile | undefined {
    return this.files.value.find((each) => each.name === name);
  }

  /** Takes the program's list; texts that were written here and not yet there stay, and are sent. Returns files whose
   * text is another than it was here. */
  take(project: Project): OpenFile[] {
    const changed: OpenFile[] = [];
    this.files.value = project.files.map((theirs) => {
      const mine = this.file(theirs.name);
      if (mine && mine.unsaved && !mine.library && mine.text !== theirs.text) {
        this.write(mine.name, mine.text);
        return { ...mine, kind: theirs.kind };
      }
      const unsaved = theirs.unsaved ?? false;
      const file: OpenFile = {
        name: theirs.name, kind: theirs.kind, library: theirs.library, saved: theirs.saved,
        savedText: unsaved ? null : theirs.text, text: theirs.text, unsaved, theirs: mine?.theirs ?? null,
      };
      if (!mine || mine.text !== theirs.text) changed.push(file);
      return file;
    });
    this.version.value = Math.max(this.version.value, project.version);
    return changed;
  }

  /** The editor says what a file's text is now. */
  write(name: string, text: string): void {
    const file = this.file(name);
    if (!file || file.library) return;
    const unsaved = file.savedText === null || text !== file.savedText;
    file.text = text;
    if (unsaved !== file.unsaved) {
      file.unsaved = unsaved;
      this.files.tell();
    }
    this.waiting.set(name, text);
    this.editedAt_ms = performance.now();
    this.sending.value = true;
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.send(), quiet_ms);
  }

  /** Sends what waits, such as after the line was lost. */
  async send(): Promise<void> {
    window.clearTimeout(this.timer);
    if (this.waiting.size === 0) return;
    this.abort?.abort();
    const abort = (this.abort = new AbortController());
    const sent = new Map(this.waiting);
    try {
      const answer = await sendEdit(Object.fromEntries(sent), abort.signal);
      for (const [name, text] of sent) if (this.waiting.get(name) === text) this.waiting.delete(name);
      this.tell(answer.version, answer.problems);
      this.sending.value = this.waiting.size > 0;
    } catch (error) {
      if (abort.signal.aborted) return;
      // Without a line the texts wait; a program that answers with an error will not like them better a second time.
      if (error instanceof ApiError) {
        this.waiting.clear();
        this.sending.value = false;
        throw error;
      }
    }
  }

  /** What is wrong by an answer or by the stream, unless a newer one has been heard. */
  tell(version: number, problems: Problem[] | null): void {
    if (version < this.version.value) return;
    this.version.value = version;
    if (problems) this.problems.value = problems;
  }

  /** Returns false where another hand has changed the file: then `theirs` is set, and the page asks. */
  async save(name: string): Promise<boolean> {
    const file = this.file(name);
    if (!file || file.library) return true;
    const text = file.text;
    try {
      const { saved } = await sendSave(name, text, file.saved);
      file.saved = saved;
      file.savedText = text;
      file.unsaved = file.text !== text;
      file.theirs = null;
      this.files.tell();
      return true;
    } catch (error) {
      if (!(error instanceof ApiError) || error.status !== 409) throw error;
      this.disk(name, String(error.body["text"] ?? ""), String(error.body["saved"] ?? ""));
      return false;
    }
  }

  /** Another hand has changed a file. */
  disk(name: string, text: string, saved: string): void {
    const file = this.file(name);
    if (!file || saved === file.saved) return;
    if (text === file.text) {
      Object.assign(file, { saved, savedText: text, unsaved: false, theirs: null });
    } else file.theirs = { text, saved };
    this.files.tell();
  }

  /** Mine stays, and may now be saved over theirs. */
  keepMine(name: string): void {
    const file = this.file(name);
    if (!file?.theirs) return;
    Object.assign(file, { saved: file.theirs.saved, savedText: file.theirs.text, unsaved: true, theirs: null });
    this.files.tell();
  }

  /** Returns the text to be put into the editor. */
  takeTheirs(name: string): string | null {
    const file = this.file(name);
    if (!file?.theirs) return null;
    const { text, saved } = file.theirs;
    Object.assign(file, { saved, savedText: text, theirs: null });
    return text;
  }
}

