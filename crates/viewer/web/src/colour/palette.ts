/** Colours that people with all kinds of colour vision tell apart (after Okabe and Ito), and patterns that need no colour. */

export type Rgb = [red: number, green: number, blue: number];

const STYLE_COLOURS = ['#0a84c4', '#e69f00', '#109e73', '#d6617f', '#7fc4ec', '#d55e00', '#e8dc3a', '#9a9fa8'];

/** Marks on the roof, in the order of the shader. */
export const PATTERNS = ['plain', 'stripe', 'bars', 'dot', 'cross', 'two stripes', 'chevron', 'frame'] as const;

export const STYLE_COLOUR_COUNT = STYLE_COLOURS.length;

export const styleColour = (style: number): string => STYLE_COLOURS[style % STYLE_COLOURS.length];

/** Styles with the same colour have different patterns. */
export const stylePattern = (style: number): number =>
  (style + Math.floor(style / STYLE_COLOURS.length)) % PATTERNS.length;

/** The four phases of a driver: cruises, wants, changes, aborts. */
export const PHASES = [
  { name: 'cruises', colour: '#8a97a6' },
  { name: 'wants a change', colour: '#e69f00' },
  { name: 'changes', colour: '#0a84c4' },
  { name: 'aborts', colour: '#d55e00' },
] as const;

export const UNKNOWN_COLOUR = '#8d939b';

/** Red, green and blue from 0 to 1, as they are written. */
export function rgb(hex: string): Rgb {
  const value = Number.parseInt(hex.slice(1), 16);
  return [((value >> 16) & 255) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}
