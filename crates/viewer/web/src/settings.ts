import type { Hand } from './protocol/messages.ts';

/** A number that can be set by hand. */
export interface Setting {
  /** The same for all that set the same number. */
  name: string;
  value: number;
}

/** The number that is set by hand, if it is one. */
export function settingOf(hand: Hand): Setting | null {
  if ('set_parameter' in hand) {
    const { style, parameter, value } = hand.set_parameter;
    return { name: `${parameter} of ${style}`, value };
  }
  if ('set_share' in hand) return { name: `share of ${hand.set_share.style}`, value: hand.set_share.weight };
  if ('set_demand' in hand) return { name: `demand of ${hand.set_demand.origin}`, value: hand.set_demand.vehicles_per_hour };
  if ('set_offset' in hand) return { name: `offset of ${hand.set_offset.light}`, value: hand.set_offset.offset_s };
  return null;
}

/** The ids of the lanelets that are closed by hand. */
export function closedBy(set: readonly Hand[]): Set<string> {
  const closed = set.flatMap((hand) => ('close_lanelet' in hand && hand.close_lanelet.is_closed ? [hand.close_lanelet.lanelet] : []));
  return new Set(closed);
}
