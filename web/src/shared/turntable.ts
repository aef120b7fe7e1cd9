// A turntable image: the pointer or the arrow keys choose the frame.
import { html } from "./dom";
import type { Picture } from "./page";

/** Its first frame, small; decorative, the text beside it describes it. */
export function thumbnail(picture: Picture): HTMLElement {
  const strip = html("img", { src: picture.image, alt: "" });
  strip.style.width = `${picture.frames * 100}%`;
  return html("span", { class: "thumbnail", "aria-hidden": "true" }, strip);
}

export function turntable(picture: Picture, label: string): HTMLElement {
  const view = html("div", {
    class: "turntable",
    role: "img",
    "aria-label": label,
    tabindex: picture.frames > 1 ? 0 : undefined,
  });
  const strip = html("img", { src: picture.image, alt: "", draggable: "false" });
  strip.style.width = `${picture.frames * 100}%`;
  view.append(strip);
  let frame = 0;
  const show = (next: number): void => {
    frame = ((next % picture.frames) + picture.frames) % picture.frames;
    strip.style.transform = `translateX(${(-100 * frame) / picture.frames}%)`;
    view.dataset.frame = String(frame);
  };
  show(0);
  if (picture.frames === 1) return view;
  view.addEventListener("pointermove", (event) => {
    const box = view.getBoundingClientRect();
    show(Math.floor(((event.clientX - box.left) / box.width) * picture.frames));
  });
  view.addEventListener("pointerleave", () => show(0));
  view.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.preventDefault();
    show(frame + (event.key === "ArrowRight" ? 1 : -1));
  });
  return view;
}
