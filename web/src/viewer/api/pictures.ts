// Pictures of visible cards, loaded one at a time while no surface is being loaded: first a single frame, the whole
// turntable on interaction.
import { html } from "../../shared/dom";
import { describe } from "../../shared/names";
import type { Page, Picture } from "../../shared/page";
import { thumbnail, turntable } from "../../shared/turntable";
import { ConnectionError, isSuperseded, type Api } from "./api";
import { EVERYTHING } from "./entries";

const FRAMES = 12;

interface Place {
  number: number;
  element: HTMLElement;
  frames: number;
  /** a decorative still image */
  isSmall: boolean;
}

export class Pictures {
  private waiting: Place[] = [];
  private isLoading = false;
  /** without a connection */
  private readonly missed = new Set<Place>();
  private readonly places = new Map<Element, Place>();
  /** by the number of the object: the panel of the selected object shows them again and again */
  private readonly thumbnails = new Map<number, HTMLElement>();
  private readonly sight = new IntersectionObserver((all) => all.forEach((one) => this.onIntersection(one)), { rootMargin: "120px" });

  constructor(
    private readonly api: Api,
    private readonly page: Page,
  ) {
    api.connection.onChange(() => {
      if (api.connection.state !== "up") return;
      for (const place of this.missed) this.request(place, false);
      this.missed.clear();
    });
  }

  /** The element that will contain the picture of an object. */
  placeOf(number: number): HTMLElement {
    const element = html("div", { class: "picture" });
    if (number === EVERYTHING) return element;
    const place = this.watch(number, element, false);
    for (const event of ["pointermove", "focusin"]) element.addEventListener(event, () => place.frames === 1 && this.request(place, true));
    return element;
  }

  /** A small still image beside the words for an object: one element for each object. */
  thumbnailOf(number: number): HTMLElement {
    const known = this.thumbnails.get(number);
    if (known) return known;
    const element = html("span", { class: "thumb", "aria-hidden": "true" });
    this.thumbnails.set(number, element);
    if (number !== EVERYTHING) this.watch(number, element, true);
    return element;
  }

  private watch(number: number, element: HTMLElement, isSmall: boolean): Place {
    const place: Place = { number, element, frames: 0, isSmall };
    this.places.set(element, place);
    this.sight.observe(element);
    return place;
  }

  private onIntersection({ isIntersecting, target }: IntersectionObserverEntry): void {
    const place = this.places.get(target);
    if (!place || place.frames > 0) return;
    if (isIntersecting) this.request(place, false);
    else this.waiting = this.waiting.filter((other) => other !== place);
  }

  private request(place: Place, first: boolean): void {
    if (this.waiting.includes(place)) return;
    if (first) this.waiting.unshift(place);
    else this.waiting.push(place);
    void this.loadNext();
  }

  private async loadNext(): Promise<void> {
    if (this.isLoading) return;
    this.isLoading = true;
    while (this.waiting.length > 0) {
      await this.api.idle();
      const place = this.waiting.shift();
      if (place) await this.fill(place);
    }
    this.isLoading = false;
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
      if (isSuperseded(error)) place.frames = 0;
      else if (error instanceof ConnectionError) {
        place.frames = frames === 1 ? 0 : 1;
        this.missed.add(place);
      } else if (!place.isSmall) place.element.textContent = "no picture"; // the object can be shown nevertheless
    }
  }

  private put({ element, number, isSmall }: Place, picture: Picture | null): void {
    if (isSmall) return element.replaceChildren(...(picture ? [thumbnail(picture)] : []));
    if (picture === null) return element.replaceChildren("no picture");
    const had = element.contains(document.activeElement);
    const view = turntable(picture, `Picture of ${describe(this.page, number)}`);
    view.tabIndex = 0; // focusing a single frame loads the turntable
    element.replaceChildren(view);
    if (had) view.focus();
  }
}
