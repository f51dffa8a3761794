/** Numbers as people read them. */

export const fixed = (value: number | null | undefined, digits: number): string =>
  value === null || value === undefined ? 'not known' : value.toFixed(digits).replace('-', '−');

export const withUnit = (value: number | null | undefined, digits: number, unit: string): string =>
  value === null || value === undefined ? 'not known' : `${fixed(value, digits)} ${unit}`;

/** A time as minutes, seconds and tenths, with hours if there are any. */
export function clockTime(time_s: number): string {
  const tenths = Math.max(Math.round(time_s * 10), 0);
  const two = (value: number): string => String(value).padStart(2, '0');
  const hours = Math.floor(tenths / 36_000);
  const minutes = Math.floor(tenths / 600) % 60;
  const seconds = Math.floor(tenths / 10) % 60;
  return `${hours > 0 ? `${hours}:` : ''}${two(minutes)}:${two(seconds)}.${tenths % 10}`;
}

/** A number with three significant digits, or three places after the point; very small ones as powers of ten. */
export function short(value: number): string {
  const size = Math.abs(value);
  if (size === 0) return '0';
  const text = size < 0.0005 ? value.toExponential(1) : size < 1 ? value.toFixed(3) : value.toPrecision(size < 1000 ? 3 : 6);
  return (size < 0.0005 ? text : String(Number(text))).replaceAll('-', '−');
}
