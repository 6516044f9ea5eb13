// A handle for tests, and for the curious: what is drawn, what is written, and where things are on the screen.
import type { Editor } from "./editor/editor";
import type { Workspace } from "./editor/workspace";
import type { Live } from "./live";
import type { DrawnCounts, World } from "./view/world";

interface Parts {
  world: World;
  live: Live;
  editor: Editor;
  workspace: Workspace;
  counts: () => DrawnCounts;
  dragging: () => boolean;
}

export function letTestsIn({ world, live, editor, workspace, counts, dragging }: Parts): void {
  const selectText = (words: string): boolean => {
    const at = editor.view.state.doc.toString().indexOf(words);
    if (at < 0) return false;
    editor.view.focus();
    editor.view.dispatch({ selection: { anchor: at, head: at + words.length }, scrollIntoView: true });
    return true;
  };
  Object.assign(window, {
    studio: {
      counts: () => ({
        ...counts(), segments: live.growth.shown.segments, elements: live.growth.shown.elementCount,
        version: live.growth.shown.version, done: live.done.value?.version ?? 0, memory: { ...world.renderer.info.memory },
      }),
      text: () => editor.view.state.doc.toString(),
      unsaved: () => workspace.file(editor.active.value)?.unsaved ?? false,
      select: selectText,
      type: (words: string, insert: string) => selectText(words) && editor.view.dispatch(editor.view.state.replaceSelection(insert)),
      /** Nothing is on its way to the program or waits to be shown. */
      settled: () => !workspace.sending.value && live.growth.waits_ms === 0 && live.done.value?.version === workspace.version.value,
      timeOfPicture_ms: () => world.timeOfPicture_ms(),
      dragging,
      seedPoint: (index: number) => world.seedPoint(index),
      limbPoint: (plant: number, node: number) => world.pointOf(live.growth.shown, plant, node),
    },
  });
}
