// The scene turning once around, or going along the isovalue of what is selected, as an animated PNG.
import { animatedPng } from "./apng";
import type { Desk } from "../desk/desk";
import { drawPicture, pngOf, type PictureWishes } from "./picture";
import { change, type State } from "../state/state";

export interface AnimationWishes {
  picture: PictureWishes;
  frames: number;
  framesPerSecond: number;
  /** isovalues, first and last; null: a turntable */
  along: [number, number] | null;
}

/** tell: how many frames are made; isOver: the reader wants no more. Null where it was ended. The scene is left as it was. */
export async function animate(
  desk: Desk,
  wishes: AnimationWishes,
  tell: (made: number) => void,
  isOver: () => boolean,
): Promise<Blob | null> {
  const pictures: Uint8Array[] = [];
  const { stage, history, scene } = desk;
  const [state, view] = [history.now, stage.eye.view];
  try {
    for (let k = 0; k < wishes.frames && !isOver(); ++k) {
      const drawn = wishes.along
        ? await evolved(desk, state, wishes.along, k / Math.max(1, wishes.frames - 1))
        : turned(desk, state, view, k / wishes.frames);
      pictures.push(new Uint8Array(await (await pngOf(drawPicture(desk, wishes.picture, drawn))).arrayBuffer()));
      tell(k + 1);
      await new Promise((resolve) => setTimeout(resolve));
    }
  } finally {
    stage.eye.view = view;
    scene.show(history.now, state, false);
  }
  return isOver() ? null : new Blob([animatedPng(pictures, wishes.framesPerSecond) as Uint8Array<ArrayBuffer>], { type: "image/png" });
}

function turned({ stage }: Desk, state: State, view: number[], share: number): State {
  stage.eye.view = view;
  stage.eye.turn(2 * Math.PI * share, 0);
  return state;
}

async function evolved({ scene }: Desk, state: State, [from, to]: [number, number], share: number): Promise<State> {
  const now = change(state, state.selected, { tau: from + (to - from) * share });
  scene.show(now, state, false);
  await scene.settled();
  return now;
}
