// A number as it is written: with its unit, and with as many decimals as a hand would write.

export interface Amount {
  value: number;
  /** Empty, or one of mm, cm, m, vx. */
  unit: string;
}

const form = /^([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)( *)(mm|cm|m|vx)?$/;

export function readAmount(text: string): Amount | null {
  const found = form.exec(text.trim());
  return found ? { value: Number(found[1]), unit: found[3] ?? "" } : null;
}

export const writeAmount = (amount: Amount, step: number): string =>
  writeNumber(amount.value, step) + (amount.unit ? ` ${amount.unit}` : "");

/** With the decimals of the step and no zeros behind. */
export function writeNumber(value: number, step: number): string {
  const decimals = Math.max(0, Math.min(8, -Math.floor(Math.log10(step) + 1e-9)));
  const text = value.toFixed(decimals);
  const bare = text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  return bare === "-0" ? "0" : bare;
}

/** 1, 2 or 5 times a power of ten, about a hundred or two to the span: whole degrees, hundredths of a weight. */
export function stepOf(span: number, whole: boolean): number {
  const raw = span / 180;
  const power = 10 ** Math.floor(Math.log10(raw));
  const nice = [1, 2, 5].find((factor) => factor * power >= raw * 0.9999999) ?? 10;
  const step = nice * power;
  return whole ? Math.max(1, Math.round(step)) : step;
}
