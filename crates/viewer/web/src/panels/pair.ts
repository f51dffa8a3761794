import type { Driver } from '../protocol/messages.ts';
import { fixed, withUnit } from './words.ts';

const KMH_PER_MPS = 3.6;
/** Vehicles that close in more slowly than this do not collide. */
const LEAST_CLOSING_MPS = 0.05;

interface Gap {
  metres: number;
  /** The vehicle behind and the one ahead on the same way; null if they are not on one. */
  inOrder: [rear: Driver, front: Driver] | null;
}

/** Facts of two vehicles, the second one seen from the first. Of recorded vehicles nobody knows which follows which. */
export function pairFacts(first: Driver, second: Driver): [name: string, value: string][] {
  const { metres, inOrder } = gapBetween(first, second);
  const where = inOrder === null ? 'in a straight line' : inOrder[0] === first ? 'ahead' : 'behind';
  const faster = second.speed_kmh - first.speed_kmh;
  return [
    ['distance of centres', withUnit(distance(first, second), 1, 'm')],
    ['gap', `${fixed(metres, 1)} m ${where}`],
    ['time to collision', timeToCollision(metres, inOrder, first.style !== null && second.style !== null)],
    ['speed', `${fixed(second.speed_kmh, 1)} km/h, ${fixed(Math.abs(faster), 1)} km/h ${faster < 0 ? 'slower' : 'faster'}`],
    ['style', second.style ?? 'not known'],
    ['state', second.state ?? 'not known'],
  ];
}

/** Along the way where one follows the other or both are on the same lanelet, else in a straight line. */
function gapBetween(first: Driver, second: Driver): Gap {
  if (first.leader?.id === second.id) return { metres: first.leader.gap_m, inOrder: [first, second] };
  if (second.leader?.id === first.id) return { metres: second.leader.gap_m, inOrder: [second, first] };
  const lengths = (first.length_m + second.length_m) / 2;
  const isSameLane = first.lanelet !== null && first.lanelet === second.lanelet;
  if (!isSameLane || first.position_m === null || second.position_m === null) {
    return { metres: Math.max(distance(first, second) - lengths, 0), inOrder: null };
  }
  const ahead = second.position_m - first.position_m;
  return { metres: Math.max(Math.abs(ahead) - lengths, 0), inOrder: ahead >= 0 ? [first, second] : [second, first] };
}

function timeToCollision(gap_m: number, inOrder: Gap['inOrder'], hasDrivers: boolean): string {
  if (inOrder === null) return hasDrivers ? 'neither follows the other' : 'not known';
  const [rear, front] = inOrder;
  const closing = (rear.speed_kmh - front.speed_kmh) / KMH_PER_MPS;
  return closing > LEAST_CLOSING_MPS ? withUnit(gap_m / closing, 1, 's') : 'none: they do not close in';
}

const distance = (first: Driver, second: Driver): number => Math.hypot(second.x - first.x, second.y - first.y);
