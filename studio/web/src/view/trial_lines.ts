// The trials of one node, drawn where they were made: what was accepted green and in front, the others by what became
// of them.
import * as THREE from "three";
import type { Asked, Trial, Vec3 } from "../protocol/types";

/** Colours that are told apart with any eye: the page's legend takes the same. */
export const outcomeColours = ["#d5563f", "#d99a2b", "#5b8fd0", "#a672b8", "#8a8f88", "#c46a8f"];
export const acceptedColour = "#8fd14a";
export const goodColour = "#4f8f5e";

/** Rejected outcomes in the order in which they get their colours. */
export const outcomesOf = (asked: Asked): string[] =>
  [...new Set(asked.trials.filter((trial) => !trial.taken).map((trial) => trial.outcome))].sort();

export function trialColour(trial: Trial, outcomes: string[]): string {
  if (trial.taken) return acceptedColour;
  // What met the rules and was not taken is nearly what was: a paler green.
  if (trial.outcome === "grown") return goodColour;
  return outcomeColours[Math.max(0, outcomes.indexOf(trial.outcome)) % outcomeColours.length] ?? "#888888";
}

export class TrialLines {
  readonly root = new THREE.Group();

  show(at_m: Vec3, asked: Asked | null): void {
    this.clear();
    if (asked) {
      const outcomes = outcomesOf(asked);
      this.add(asked.trials.filter((trial) => !trial.taken), outcomes, 0.7, 30);
      this.add(asked.trials.filter((trial) => trial.taken), outcomes, 1, 31);
    }
    const dot = new THREE.Points(
      new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(at_m, 3)),
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

  private add(trials: Trial[], outcomes: string[], opacity: number, order: number): void {
    if (trials.length === 0) return;
    const position: number[] = [];
    const colour: number[] = [];
    for (const trial of trials) {
      position.push(...trial.from_m, ...trial.to_m);
      const c = new THREE.Color(trialColour(trial, outcomes));
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
