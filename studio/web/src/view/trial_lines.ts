// The trials of one node, drawn where they were made: what was accepted green and in front, the others by what became
// of them.
import * as THREE from "three";
import type { WhyAnswer } from "../protocol/types";

/** Colours that are told apart with any eye: the page's legend takes the same. */
export const outcomeColours = ["#d5563f", "#d99a2b", "#5b8fd0", "#a672b8", "#8a8f88", "#c46a8f"];
export const acceptedColour = "#7fc241";

export const isAccepted = (outcome: string): boolean => /^(accepted|taken|grew)/.test(outcome);

export function outcomeColour(outcome: string, all: string[]): string {
  if (isAccepted(outcome)) return acceptedColour;
  const rejected = all.filter((each) => !isAccepted(each));
  return outcomeColours[Math.max(0, rejected.indexOf(outcome)) % outcomeColours.length] ?? "#888888";
}

export const outcomesOf = (why: WhyAnswer): string[] => [...new Set(why.trials.map((trial) => trial.outcome))].sort();

export class TrialLines {
  readonly root = new THREE.Group();

  show(why: WhyAnswer): void {
    this.clear();
    const outcomes = outcomesOf(why);
    this.add(why, why.trials.filter((trial) => !isAccepted(trial.outcome)), outcomes, 0.75, 30);
    this.add(why, why.trials.filter((trial) => isAccepted(trial.outcome)), outcomes, 1, 31);
    const dot = new THREE.Points(
      new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(why.at_m, 3)),
      new THREE.PointsMaterial({ size: 9, sizeAttenuation: false, color: 0xffffff, depthTest: false, toneMapped: false }),
    );
    dot.renderOrder = 32;
    this.root.add(dot);
  }

  clear(): void {
    for (const child of [...this.root.children] as (THREE.LineSegments | THREE.Points)[]) {
      this.root.remove(child);
      child.geometry.dispose();
      (child.material as THREE.Material).dispose();
    }
  }

  private add(why: WhyAnswer, trials: WhyAnswer["trials"], outcomes: string[], opacity: number, order: number): void {
    if (trials.length === 0) return;
    const position: number[] = [];
    const colour: number[] = [];
    for (const trial of trials) {
      position.push(...(trial.from_m ?? why.at_m), ...trial.to_m);
      const c = new THREE.Color(outcomeColour(trial.outcome, outcomes));
      colour.push(c.r, c.g, c.b, c.r, c.g, c.b);
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colour, 3));
    const material = new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, opacity, depthTest: false, toneMapped: false });
    const lines = new THREE.LineSegments(geometry, material);
    lines.renderOrder = order;
    this.root.add(lines);
  }
}
