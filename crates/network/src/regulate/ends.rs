//! Where a lane that ends beside another one ends for vehicles that would touch those beside them.

use super::contact::{Contact, SAMPLE};
use super::kinship::TO_LEAVE;
use crate::chain::{Beside, Chain, ChainIndex};
use crate::lanelet::Side;
use crate::network::Network;
use crate::width::{BODIES, LEAST_WINDOW};

/// Lets lanes that end beside others end before the first place where those who wait there and those who pass would
/// touch, as in a bend: no zone keeps them apart there, since it would take the road on which the lane is left.
/// Enough of that road stays.
pub(super) fn shorten(network: &mut Network, contacts: &[([ChainIndex; 2], Vec<Contact>)]) {
    let mut ends: Vec<(ChainIndex, [f64; 2])> = Vec::new();
    for (pair, contacts) in contacts {
        for side in [0, 1] {
            let [lane, beside] = [pair[side], pair[1 - side]];
            let chain = network.chain(lane);
            if chain.is_lane_drop() {
                let touching = [false, true].map(|is_long| {
                    let of_side = contacts.iter().map(|it| (it, it.stations[side]));
                    let first = of_side
                        .filter(|(it, at)| is_left(chain, beside, *at, is_long) && touches(it, is_long));
                    first.map(|(_, at)| at - SAMPLE).fold(f64::INFINITY, f64::min)
                });
                ends.push((lane, touching));
            }
        }
    }
    for (lane, touching) in ends {
        let chain = &mut network.chains[lane.at()];
        let Some(window) = chain.last_window() else { continue };
        let least = [LEAST_WINDOW, TO_LEAVE].map(|it| window + it);
        for (is_long, (end, least)) in touching.into_iter().zip(least).enumerate() {
            let end = end.max(least);
            if end < chain.driven_until(is_long == 1) {
                chain.open[is_long][1] = end;
                chain.is_restricted = true;
            }
        }
    }
}

/// Whether a car, or a long vehicle, may change from `station` of a lane that ends to the lane `beside`, on the last
/// stretch where it has to.
fn is_left(lane: &Chain, beside: ChainIndex, station: f64, is_long: bool) -> bool {
    let until = lane.driven_until(is_long);
    let leads = |it: &Beside| it.chain == beside && (it.start..=it.end).contains(&station);
    (lane.driven_until(true) - TO_LEAVE..=until).contains(&station)
        && Side::BOTH.into_iter().any(|side| lane.stretches(side).iter().any(leads))
}

/// Whether a car, or a long vehicle, on one lane would touch a long vehicle on the other.
fn touches(contact: &Contact, is_long: bool) -> bool {
    contact.nearest < 0.5 * (BODIES[usize::from(is_long)] + BODIES[1])
}
