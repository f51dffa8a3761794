import type { TrafficEvent } from '../protocol/messages.ts';

/** How an event is drawn: its shape and its colour. The shapes are in the order of the shader. */
export interface EventLook {
  shape: 'circle' | 'diamond' | 'square' | 'star' | 'triangle' | 'ring';
  colour: string;
  name: string;
}

export const SHAPES: readonly EventLook['shape'][] = ['circle', 'diamond', 'square', 'star', 'triangle', 'ring'];

export const EVENT_LOOKS: Record<string, EventLook> = {
  discretionary: { shape: 'circle', colour: '#0a84c4', name: 'discretionary change' },
  route: { shape: 'diamond', colour: '#e69f00', name: 'change for the route' },
  keeping: { shape: 'square', colour: '#109e73', name: 'change to the slow side' },
  collision: { shape: 'star', colour: '#d4002a', name: 'collision' },
  emergency_braking: { shape: 'triangle', colour: '#d55e00', name: 'emergency braking' },
  missed_turn: { shape: 'ring', colour: '#9a4fb5', name: 'missed turn' },
};

export const isImportant = (event: TrafficEvent): boolean => event.kind !== 'lane_change';

/** The look of an event; lane changes of other kinds look like discretionary ones. */
export function lookOf(event: TrafficEvent): EventLook {
  if (isImportant(event)) return EVENT_LOOKS[event.kind];
  return EVENT_LOOKS[event.text ?? ''] ?? EVENT_LOOKS.discretionary;
}

/** An outline of a shape around zero, with the radius 1, for drawings; y points downwards. */
export const SHAPE_PATHS: Record<EventLook['shape'], string> = {
  circle: 'M1 0A1 1 0 1 1-1 0A1 1 0 1 1 1 0Z',
  diamond: 'M0-1.15L1.15 0L0 1.15L-1.15 0Z',
  square: 'M-.85-.85H.85V.85H-.85Z',
  star: 'M0-1.3L.38-.52L1.24-.4L.62.2L.76 1.05L0 .65L-.76 1.05L-.62.2L-1.24-.4L-.38-.52Z',
  triangle: 'M0-1.15L1.1.85H-1.1Z',
  ring: 'M1 0A1 1 0 1 1-1 0A1 1 0 1 1 1 0ZM.5 0A.5.5 0 1 0-.5 0A.5.5 0 1 0 .5 0Z',
};
