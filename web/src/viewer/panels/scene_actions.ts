// Actions of the Scene menu.
import type { ViewerContext } from "../context/viewer_context";

export function addSceneActions({ actions, editor, history }: ViewerContext): void {
  const after = (word: string, what: string): string => (what ? `${word}: ${what}` : word);
  actions.add(
    {
      group: "Scene",
      keys: ["Ctrl+z"],
      run: () => history.undo(),
      get name() {
        return after("Undo", history.undoes);
      },
    },
    {
      group: "Scene",
      keys: ["Ctrl+Shift+z", "Ctrl+y"],
      run: () => history.redo(),
      get name() {
        return after("Redo", history.redoes);
      },
    },
    { group: "Scene", name: "Select next object", keys: ["."], run: () => editor.step(1) },
    { group: "Scene", name: "Select previous object", keys: [","], run: () => editor.step(-1) },
    { group: "Scene", name: "Show or hide selected object", keys: ["h"], run: () => editor.toggleVisible() },
    { group: "Scene", name: "Isolate selected object", keys: ["i"], run: () => editor.selected && editor.isolate(editor.selected.entry) },
    {
      group: "Scene",
      name: "Ghost others: pale, and clicks pass through",
      keys: ["g"],
      run: () => editor.toggleGhosts(),
      isOn: () => editor.ghosts,
    },
    {
      group: "Scene",
      name: "Cavities only",
      keys: ["w"],
      run: () => editor.toggleCavitiesOnly(),
      isOn: () => editor.selected?.walls === "cavities",
    },
    {
      group: "Scene",
      name: "Surfaces as points (Dividing Cubes)",
      keys: ["D"],
      run: () => editor.togglePoints(),
      isOn: () => editor.points,
    },
    { group: "Scene", name: "Remove selected object", keys: ["Delete"], run: () => editor.remove() },
  );
}
