// Keyboard control of the tree (ARIA tree): arrows move up, down, to the parent and to the first child, and fold;
// one item is in the tab order.
import { keptParent, lanesOf } from "../../shared/overview";
import { entryOf, type Page } from "../../shared/page";

/** Does a branch have a folded ancestor? wanted: positions in page.branches, as b. */
export function foldedAway(page: Page, wanted: Set<number>, folded: Set<number>, b: number): boolean {
  for (let up = keptParent(page, wanted, b); up >= 0; up = keptParent(page, wanted, up)) if (folded.has(up)) return true;
  return false;
}

interface Node {
  number: number;
  branch: number;
  parent: number;
  element: SVGElement;
}

export class TreeKeys {
  /** by lane */
  private nodes: Node[] = [];
  private folded = new Set<number>();
  private parents = new Set<number>();

  /** fold(number, on): of an entry */
  constructor(
    private readonly place: HTMLElement,
    private readonly fold: (number: number, on: boolean) => void,
  ) {
    place.addEventListener("keydown", (event) => this.press(event));
  }

  /** After drawing. kept: the drawn subset of `wanted`. */
  update(page: Page, kept: Set<number>, wanted: Set<number>, folded: Set<number>): void {
    const lanes = lanesOf(page, kept);
    this.folded = folded;
    this.parents = new Set([...wanted].map((b) => keptParent(page, wanted, b)));
    this.nodes = [...this.place.querySelectorAll<SVGElement>("[data-entry]")].map((element) => {
      const number = Number(element.dataset.entry);
      const { branch } = entryOf(page, number);
      return { number, branch, parent: keptParent(page, kept, branch), element };
    });
    this.nodes.sort((p, q) => (lanes[p.branch] ?? 0) - (lanes[q.branch] ?? 0) || entryOf(page, p.number).tau - entryOf(page, q.number).tau);
    const depth = new Map<number, number>([[-1, 0]]);
    for (const { branch, parent, element } of this.nodes) {
      depth.set(branch, (depth.get(parent) ?? 0) + 1);
      element.setAttribute("role", "treeitem");
      element.setAttribute("aria-level", String(depth.get(branch)));
      element.setAttribute("tabindex", "-1");
      if (this.parents.has(branch)) element.setAttribute("aria-expanded", String(!folded.has(branch)));
    }
  }

  /** Puts the item of an entry into the tab order. */
  setTabStop(number: number): void {
    const at = Math.max(0, this.nodes.findIndex((node) => node.number === number));
    this.nodes.forEach(({ element }, i) => element.setAttribute("tabindex", i === at ? "0" : "-1"));
  }

  private press(event: KeyboardEvent): void {
    const at = this.nodes.findIndex(({ element }) => element === event.target);
    const node = this.nodes[at];
    if (!node || event.defaultPrevented) return;
    if (event.key === "Enter" || event.key === " ") return node.element.dispatchEvent(new MouseEvent("click")), event.preventDefault();
    const isParent = this.parents.has(node.branch);
    const isFolded = this.folded.has(node.branch);
    if (event.key === "ArrowLeft" && isParent && !isFolded) this.foldAt(node.number, true);
    else if (event.key === "ArrowRight" && isParent && isFolded) this.foldAt(node.number, false);
    else if (!this.go(this.next(event.key, at, node))) return;
    event.preventDefault();
  }

  private next(key: string, at: number, node: Node): number | null {
    if (key === "ArrowUp") return at - 1;
    if (key === "ArrowDown") return at + 1;
    if (key === "Home") return 0;
    if (key === "End") return this.nodes.length - 1;
    if (key === "ArrowLeft") return this.nodes.findIndex(({ branch }) => branch === node.parent);
    if (key === "ArrowRight") return this.nodes.findIndex(({ parent }) => parent === node.branch);
    return null;
  }

  /** Returns whether the key was handled. */
  private go(to: number | null): boolean {
    const element = to === null ? undefined : this.nodes[to]?.element;
    element?.focus();
    return to !== null;
  }

  private foldAt(number: number, on: boolean): void {
    this.fold(number, on);
    this.nodes.find((node) => node.number === number)?.element.focus();
  }
}
