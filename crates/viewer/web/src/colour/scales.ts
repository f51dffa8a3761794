import { SAME } from '../protocol/frame.ts';
import { rgb, UNKNOWN_COLOUR, type Rgb } from './palette.ts';

/** Colours from low to high. Their lightness grows or falls all the way, so that they read in grey, too. */
const CIVIDIS = ['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#8a8678', '#a59c74', '#c3b369', '#e1cc55', '#fee838'];
const VIRIDIS = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b', '#fde725'];
const YELLOW_PURPLE = ['#ffdf5a', '#ffb03b', '#f5793a', '#d0354f', '#8c1a6a', '#4a0d55'];
const BLUE_ORANGE = ['#1f5fa8', '#5b8fc4', '#a3bfdc', '#dfe3e8', '#f0c68f', '#e2933a', '#b95f0a'];

export interface Scale {
  colours: readonly string[];
  /** What the ends and the middle of the legend say. */
  labels: readonly [low: string, middle: string, high: string];
  unit: string;
}

export type VehicleColour = 'style' | 'speed' | 'state' | 'desire' | 'delay' | 'since_change' | 'difference';

export type VehicleScale = Exclude<VehicleColour, 'style' | 'state'>;

export const FASTEST_COLOUR_MPS = 40;

export const VEHICLE_SCALES: Record<VehicleScale, Scale> = {
  speed: { colours: VIRIDIS, labels: ['0', '72', '144'], unit: 'km/h' },
  desire: { colours: BLUE_ORANGE, labels: ['against', '0', 'for a change'], unit: 'tanh(G/θ)' },
  delay: { colours: CIVIDIS, labels: ['0', '254', '508'], unit: 's lost on this trip' },
  difference: { colours: YELLOW_PURPLE, labels: ['0.5 or less', '63', '127 or no twin'], unit: 'm; grey: at the same place' },
  since_change: { colours: VIRIDIS.toReversed(), labels: ['0', '127', '254 or never'], unit: 's since the last change' },
};

export type Heat = 'none' | 'changes' | 'speed' | 'density';

export interface HeatScale extends Scale {
  /** The value at the high end. */
  top: number;
}

export const HEAT_SCALES: Record<Exclude<Heat, 'none'>, HeatScale> = {
  changes: { colours: CIVIDIS, labels: ['0', '500', '1000 or more'], unit: 'lane changes per km and hour', top: 1000 },
  speed: { colours: VIRIDIS, labels: ['0', '65', '130'], unit: 'km/h', top: 130 },
  density: { colours: CIVIDIS, labels: ['0', '50', '100 or more'], unit: 'vehicles per km', top: 100 },
};

/** The colour at a place from 0 to 1 of a scale. */
export function colourAt(colours: readonly string[], share: number): Rgb {
  const place = Math.min(Math.max(share, 0), 1) * (colours.length - 1);
  const below = Math.min(Math.floor(place), colours.length - 2);
  const from = rgb(colours[below]);
  const to = rgb(colours[below + 1]);
  const part = place - below;
  return [from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part, from[2] + (to[2] - from[2]) * part];
}

/**
 * The 256 colours of the values of a byte, as the bytes of a picture. Value 0 is unknown where the scale has such a value. Vehicles that do
 * not differ from their twins are grey.
 */
export function byteColours(scale: VehicleScale): Uint8Array {
  const bytes = new Uint8Array(256 * 4);
  for (let value = 0; value < 256; value += 1) {
    const isUnknown = (value === 0 && scale !== 'speed') || (value === SAME && scale === 'difference');
    const share = scale === 'speed' ? value / 4 / FASTEST_COLOUR_MPS : (value - 1) / 254;
    const colour = isUnknown ? rgb(UNKNOWN_COLOUR) : colourAt(VEHICLE_SCALES[scale].colours, share);
    for (let part = 0; part < 3; part += 1) bytes[value * 4 + part] = Math.round(colour[part] * 255);
    bytes[value * 4 + 3] = 255;
  }
  return bytes;
}

/** A scale as the background of its legend. */
export const gradient = (colours: readonly string[]): string => `linear-gradient(to right, ${colours.join(', ')})`;
