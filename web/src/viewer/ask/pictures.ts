// Pictures of objects, for cards that are in sight: asked for one at a time and only while no surface is on its way. A still one comes
// first; all around is asked for when somebody turns it.
import { html } from "../../dom";
import { describe } from "../../names";
import type { Page, Picture } from "../../page";
import { turntable } from "../../turntable";
import { isOvertaken, type Api } from "./api";
import { EVERYTHING } from "./shown";

const FRAMES = 12;

interface Place {
  number: number;
  element: HTMLElement;
  frames: number;
}

export class Pictures {
  private waiting: Place[] = [];
  private asking = false;
  private readonly places = new Map<Element, Place>();
  private readonly sight = new IntersectionObserver((all) => all.forEach((one) => this.see(one)), { rootMargin: "120px" });

  constructor(
    private readonly api: Api,
    private readonly page: Page,
  ) {}

  /** Where the picture of an object will be. */
  placeOf(number: number): HTMLElement {
    const element = html("div", { class: "picture" });
    if (number === EVERYTHING) return element;
    const place: Place = { number, element, frames: 0 };
    this.places.set(element, place);
    this.sight.observe(element);
    for (const event of ["pointermove", "focusin"]) element.addEventListener(event, () => place.frames === 1 && this.want(place, true));
    return element;
  }

  private see({ isIntersecting, target }: IntersectionObserverEntry): void {
    const place = this.places.get(target);
    if (!place || place.frames > 0) return;
    if (isIntersecting) this.want(place, false);
    else this.waiting = this.waiting.filter((other) => other !== place);
  }

  private want(place: Place, first: boolean): void {
    if (this.waiting.includes(place)) return;
    if (first) this.waiting.unshift(place);
    else this.waiting.push(place);
    void this.draw();
  }

  private async draw(): Promise<void> {
    if (this.asking) return;
    this.asking = true;
    while (this.waiting.length > 0) {
      await this.api.quiet();
      const place = this.waiting.shift();
      if (place) await this.fill(place);
    }
    this.asking = false;
  }

  private async fill(place: Place): Promise<void> {
    const { number } = place;
    const { entries } = this.page;
    const frames = place.frames === 0 ? 1 : FRAMES;
    place.frames = frames;
    try {
      const picture = await this.api.card(number < entries.length ? { entry: number } : { branch: number - entries.length }, frames);
      this.put(place, picture);
    } catch (error) {
      if (isOvertaken(error)) place.frames = 0;
      else place.element.textContent = "no picture"; // the object itself can be shown all the same
    }
  }

  private put({ element, number }: Place, picture: Picture | null): void {
    if (picture === null) return element.replaceChildren("no picture");
    const had = element.contains(document.activeElement);
    const view = turntable(picture, `Picture of ${describe(this.page, number)}`);
    view.tabIndex = 0; // who comes to a still one gets it all around
    element.replaceChildren(view);
    if (had) view.focus();
  }
}
