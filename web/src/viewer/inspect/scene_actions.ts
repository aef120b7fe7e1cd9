// What can be done to the scene, by key and from its menu.
import type { Desk } from "../desk/desk";

export function sceneActions({ actions, editor, history }: Desk): void {
  const after = (word: string, what: string): string => (what ? `${word}: ${what}` : word);
  actions.add(
    {
      group: "Scene",
      keys: ["Ctrl+z"],
      run: () => history.undo(),
      get name() {
        return after("undo", history.undoes);
      },
    },
    {
      group: "Scene",
      keys: ["Ctrl+Shift+z", "Ctrl+y"],
      run: () => history.redo(),
      get name() {
        return after("redo", history.redoes);
      },
    },
    { group: "Scene", name: "select the next one shown", keys: ["."], run: () => editor.step(1) },
    { group: "Scene", name: "select the one shown before", keys: [","], run: () => editor.step(-1) },
    { group: "Scene", name: "show or hide what is selected", keys: ["h"], run: () => editor.show() },
    { group: "Scene", name: "isolate what is selected", keys: ["i"], run: () => editor.selected && editor.isolate(editor.selected.entry) },
    {
      group: "Scene",
      name: "ghost the others: pale, and a click goes through them",
      keys: ["g"],
      run: () => editor.ghost(),
      isOn: () => editor.ghosts,
    },
    {
      group: "Scene",
      name: "only the walls of its cavities",
      keys: ["w"],
      run: () => editor.wall(),
      isOn: () => editor.selected?.walls === "cavities",
    },
    { group: "Scene", name: "take what is selected out of the scene", keys: ["Delete"], run: () => editor.remove() },
  );
}
