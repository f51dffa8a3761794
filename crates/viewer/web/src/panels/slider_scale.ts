/** How places of a slider, from 0 to 1, become values. Wide ranges are finer near zero, or near the least value. */
export interface SliderScale {
  minimum: number;
  maximum: number;
  value(place: number): number;
  place(value: number): number;
}

/** A range that is this many times as wide as the usual value gets a scale that is not linear. */
const WIDE = 12;
/** Without a limit the slider reaches this many times the usual value. */
const OPEN_REACH = 10;
const LEAST_OPEN_REACH = 0.1;

/** `usual` is a value in the middle of interest, such as the one at the start. A limit that is null is open. */
export function sliderScale(minimum: number | null, maximum: number | null, usual: number): SliderScale {
  const reach = Math.max(Math.abs(usual) * OPEN_REACH, LEAST_OPEN_REACH);
  const low = minimum ?? Math.min(-reach, maximum ?? 0);
  const high = maximum ?? Math.max(reach, low + reach);
  const middle = low <= 0 && high >= 0 ? 0 : low;
  const size = Math.abs(usual - middle) || (high - low) / 100;
  if (high - low <= WIDE * size) return linear(low, high);
  const bend = (value: number): number => Math.asinh((value - middle) / size);
  const [from, to] = [bend(low), bend(high)];
  return {
    minimum: low,
    maximum: high,
    value: (place) => limit(middle + Math.sinh(from + (to - from) * place) * size, low, high),
    place: (value) => (bend(limit(value, low, high)) - from) / (to - from),
  };
}

function linear(low: number, high: number): SliderScale {
  const span = high - low || 1;
  return {
    minimum: low,
    maximum: high,
    value: (place) => low + span * place,
    place: (value) => (limit(value, low, high) - low) / span,
  };
}

const limit = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);

/** A value with as many digits as a hand on a slider can mean. */
export function rounded(value: number): number {
  return Number(value.toPrecision(3));
}
