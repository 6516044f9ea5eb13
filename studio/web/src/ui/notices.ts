// Messages that come and go in the corner. What went wrong stays until it is put away.
import { make, type Child } from "../base/dom";

const stays_ms = 6000;

export class Notices {
  constructor(private readonly place: HTMLElement) {}

  say(...words: Child[]): void {
    const notice = this.add("notice", words);
    window.setTimeout(() => notice.remove(), stays_ms);
  }

  /** The same words are not said twice at a time. */
  fault(words: string): void {
    if ([...this.place.children].some((each) => each.firstChild?.textContent === words)) return;
    const notice = this.add("notice is-fault", [make("span", {}, words)]);
    window.setTimeout(() => notice.remove(), 4 * stays_ms);
  }

  private add(kind: string, words: Child[]): HTMLElement {
    const notice: HTMLElement = make("div", { class: kind }, ...words,
      make("button", { type: "button", "aria-label": "Put away", onclick: () => notice.remove() }, "×"));
    this.place.append(notice);
    while (this.place.childElementCount > 4) this.place.firstElementChild?.remove();
    return notice;
  }
}
