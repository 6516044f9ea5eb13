// Which keys are numbers that a slider can turn, and between which ends. What a key may be at all is often far more than
// anybody wants (a segment of 1000 voxel widths), so a slider's ends are what is near to what stands there, inside that.
import { describe, isCurve, typesOf, type KeyInfo, type Schema } from "./schema";

export interface NumberKind {
  low: number;
  high: number;
  whole: boolean;
  /** In the reference's words: degrees, voxel widths, weight. */
  unit: string;
}

export function numberKind(info: KeyInfo): NumberKind | null {
  const plain = info.choices.find((each) => isNumeric(each));
  if (!plain) return null;
  const low = plain.minimum ?? plain.exclusiveMinimum ?? -Infinity;
  const high = plain.maximum ?? plain.exclusiveMaximum ?? Infinity;
  return {
    low,
    high,
    whole: typesOf(plain).includes("integer"),
    unit: describe(info.schema).unit,
  };
}

const isNumeric = (schema: Schema): boolean =>
  !isCurve(schema) && typesOf(schema).some((type) => type === "number" || type === "integer");

/** A slider's ends for what stands there, or for the default where nothing does. */
export function reach(kind: NumberKind, values: number[], unit: string): { low: number; high: number } {
  const most = Math.max(0, ...values.map(Math.abs));
  const span = kind.high - kind.low;
  if (Number.isFinite(span) && span <= 360 && !unit) return { low: kind.low, high: kind.high };
  const high = most > 0 ? niceAbove(most * (kind.whole && most < 10 ? 4 : 2.5)) : kind.whole ? 10 : 1;
  const signed = kind.low < 0 && (values.some((value) => value < 0) || kind.low === -kind.high);
  const low = signed ? -high : Math.max(0, Number.isFinite(kind.low) && !unit ? kind.low : 0);
  return { low, high: unit ? high : Math.min(high, kind.high) };
}

/** The next of 1, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten. */
export function niceAbove(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const factor = [1, 2, 2.5, 3, 4, 5, 6, 8, 10].find((each) => each * power >= value * 0.9999) ?? 10;
  return factor * power;
}
