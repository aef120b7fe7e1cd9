// Animated PNG of the scene: a turntable, or a sweep over the isovalue of the selected object.
import { animatedPng } from "./apng";
import type { ViewerContext } from "../context/viewer_context";
import { drawPicture, pngOf, type PictureOptions } from "./picture";
import { change, type State } from "../state/state";

export interface AnimationOptions {
  picture: PictureOptions;
  frames: number;
  framesPerSecond: number;
  /** first and last isovalue; null: a turntable */
  along: [number, number] | null;
}

/** onProgress: finished frames. Null if cancelled. The scene is restored. */
export async function animate(
  context: ViewerContext,
  options: AnimationOptions,
  onProgress: (made: number) => void,
  isCancelled: () => boolean,
): Promise<Blob | null> {
  const pictures: Uint8Array[] = [];
  const { viewport, history, scene } = context;
  const [state, view] = [history.now, viewport.rig.view];
  try {
    for (let k = 0; k < options.frames && !isCancelled(); ++k) {
      const drawn = options.along
        ? await evolved(context, state, options.along, k / Math.max(1, options.frames - 1))
        : turned(context, state, view, k / options.frames);
      pictures.push(new Uint8Array(await (await pngOf(drawPicture(context, options.picture, drawn))).arrayBuffer()));
      onProgress(k + 1);
      await new Promise((resolve) => setTimeout(resolve));
    }
  } finally {
    viewport.rig.view = view;
    scene.show(history.now, state, false);
  }
  if (isCancelled()) return null;
  return new Blob([animatedPng(pictures, options.framesPerSecond) as Uint8Array<ArrayBuffer>], { type: "image/png" });
}

function turned({ viewport }: ViewerContext, state: State, view: number[], share: number): State {
  viewport.rig.view = view;
  viewport.rig.turn(2 * Math.PI * share, 0);
  return state;
}

async function evolved({ scene }: ViewerContext, state: State, [from, to]: [number, number], share: number): Promise<State> {
  const now = change(state, state.selected, { tau: from + (to - from) * share });
  scene.show(now, state, false);
  await scene.settled();
  return now;
}
