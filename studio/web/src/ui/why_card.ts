// Why a node grew as it did, in words and counts, beside its trials in the view.
import { grouped, make, refill } from "../base/dom";
import type { WhyAnswer } from "../protocol/types";
import { isAccepted, outcomeColour, outcomesOf } from "../view/trial_lines";

export function showWhy(card: HTMLElement, why: WhyAnswer, plantName: string, close: () => void): void {
  const outcomes = outcomesOf(why);
  const groups = outcomes
    .map((outcome) => ({ outcome, trials: why.trials.filter((trial) => trial.outcome === outcome) }))
    .sort((a, b) => Number(isAccepted(b.outcome)) - Number(isAccepted(a.outcome)) || b.trials.length - a.trials.length);
  refill(card,
    make("button", { class: "close", type: "button", "aria-label": "Close", onclick: close }, "×"),
    make("h2", {}, `${plantName}, node ${why.node}`),
    make("p", { class: "outcome" }, `Iteration ${why.iteration}: ${why.outcome.replaceAll("_", " ")}`),
    why.sensed.length ? make("h3", {}, "What it felt") : null,
    make("table", {}, make("tbody", {}, ...why.sensed.map((each) => make("tr", {}, make("td", {}, each.name.replaceAll("_", " ")), make("td", {}, String(Number(each.value.toPrecision(3)))))))),
    groups.length ? make("h3", {}, `${grouped(why.trials.length)} trials`) : make("h3", {}, "It made no trials"),
    make("table", {}, make("tbody", {}, ...groups.map(({ outcome, trials }) => {
      const dot = make("i");
      dot.style.background = outcomeColour(outcome, outcomes);
      return make("tr", {}, make("td", {}, dot, trials[0]?.words || outcome.replaceAll("_", " ")), make("td", {}, grouped(trials.length)));
    }))));
  card.hidden = false;
}
