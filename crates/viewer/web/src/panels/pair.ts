import type { Driver } from '../protocol/messages.ts';
import { fixed, withUnit } from './words.ts';

const KMH_PER_MPS = 3.6;

/** Facts of two vehicles, the second one seen from the first. The gap is along the lane where both are on the same one. */
export function pairFacts(first: Driver, second: Driver): [name: string, value: string][] {
  const distance = Math.hypot(second.x - first.x, second.y - first.y);
  const lengths = (first.length_m + second.length_m) / 2;
  const isSameLane = first.lanelet !== null && first.lanelet === second.lanelet;
  const known = isSameLane && first.position_m !== null && second.position_m !== null;
  const ahead = known ? second.position_m! - first.position_m! : null;
  const gap = Math.max((ahead === null ? distance : Math.abs(ahead)) - lengths, 0);
  const rear = ahead === null || ahead >= 0 ? first : second;
  const front = rear === first ? second : first;
  const closing = (rear.speed_kmh - front.speed_kmh) / KMH_PER_MPS;
  const collision = ahead === null ? 'not on the same lane' : closing > 0.05 ? withUnit(gap / closing, 1, 's') : 'none: they do not close in';
  return [
    ['distance of centres', withUnit(distance, 1, 'm')],
    ['gap', `${fixed(gap, 1)} m ${ahead === null ? 'in a straight line' : `${ahead >= 0 ? 'ahead' : 'behind'} on the lane`}`],
    ['time to collision', collision],
    ['speed', `${fixed(second.speed_kmh, 1)} km/h, ${fixed(second.speed_kmh - first.speed_kmh, 1)} km/h more`],
    ['style', second.style ?? 'not known'],
    ['state', second.state ?? 'not known'],
  ];
}
