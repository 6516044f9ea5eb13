// Why a node grew as it did, in words and counts, beside its trials in the view.
import { grouped, make, refill } from "../base/dom";
import type { Asked, WhyAnswer } from "../protocol/types";
import { outcomesOf, trialColour } from "../view/trial_lines";

export interface WhyHost {
  draw(asked: Asked | null): void;
  close(): void;
}

export function showWhy(card: HTMLElement, why: WhyAnswer, host: WhyHost): void {
  const questions = [
    { title: "How it came", asked: why.came },
    { title: "What it tried last", asked: why.last },
  ].filter((each): each is { title: string; asked: Asked } => !!each.asked);
  const body = make("div", {});
  const choose = (index: number): void => {
    const question = questions[index];
    host.draw(question?.asked ?? null);
    refill(body, question ? askedTable(question.asked) : make("p", { class: "outcome" }, "It is where the seed stands, and has tried nothing since."));
    buttons.forEach((button, i) => button.setAttribute("aria-pressed", String(i === index)));
  };
  const buttons = questions.map(({ title }, i) => make("button", { class: "button", type: "button", onclick: () => choose(i) }, title));
  refill(card,
    make("button", { class: "close", type: "button", "aria-label": "Close", onclick: () => host.close() }, "×"),
    make("h2", {}, why.name),
    make("p", { class: "outcome" }, `Node ${why.node}, grown in iteration ${why.born + 1}`),
    make("div", { class: "choices" }, ...buttons), body,
    why.sensed.length ? make("h3", {}, "What it felt") : null,
    make("table", {}, make("tbody", {}, ...why.sensed.map((each) => make("tr", {}, make("td", {}, each.name.replace(/_vx$/, ", voxel widths").replaceAll("_", " ")), make("td", {}, String(Number(each.value.toPrecision(3)))))))));
  card.hidden = false;
  choose(0);
}

function askedTable(asked: Asked): HTMLElement {
  const outcomes = outcomesOf(asked);
  const groups = new Map<string, { words: string; colour: string; count: number; rank: number }>();
  for (const trial of asked.trials) {
    const key = trial.taken ? "taken" : trial.outcome;
    const group = groups.get(key) ?? {
      words: trial.taken ? "taken" : trial.outcome === "grown" ? "met the rules, and another was liked better" : trial.words || trial.outcome.replaceAll("_", " "),
      colour: trialColour(trial, outcomes), count: 0, rank: trial.taken ? 0 : trial.outcome === "grown" ? 1 : 2,
    };
    group.count += 1;
    groups.set(key, group);
  }
  const rows = [...groups.values()].sort((a, b) => a.rank - b.rank || b.count - a.count).map((group) => {
    const dot = make("i");
    dot.style.background = group.colour;
    return make("tr", {}, make("td", {}, dot, group.words), make("td", {}, grouped(group.count)));
  });
  return make("div", {},
    make("p", { class: "outcome" }, `Iteration ${asked.iteration + 1}: ${asked.words || asked.outcome.replaceAll("_", " ")}. ${asked.trials.length ? `${grouped(asked.trials.length)} trials:` : "It made no trials."}`),
    make("table", {}, make("tbody", {}, ...rows)));
}
