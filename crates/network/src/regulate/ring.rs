//! Rings: lanes that lead back to their start and turn once around, to the side on which traffic does not drive. Round
//! ones are roundabouts.

use std::f64::consts::PI;
use std::ops::Range;

use super::precedence::turned;
use crate::chain::{Chain, ChainIndex};
use crate::network::Network;

/// A ring of any shape is no longer than this [m], and a round one no longer than that: a longer way around with
/// straight sides is a block of a town (ours).
const LONGEST: f64 = 250.0;
const LONGEST_ROUND: f64 = 450.0;
/// Around a roundabout the curvatures of the chains differ by at most this factor (ours).
const ROUND: f64 = 4.0;
/// Shorter chains do not count for this [m]: their curvature is not known exactly.
const SHORT: f64 = 5.0;
/// How far a ring turns [rad], with the errors of its points.
const ONCE_AROUND: Range<f64> = 1.6 * PI..2.4 * PI;

/// What a chain is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ring {
    /// No ring.
    No,
    /// A ring that is not round, such as one of left turns.
    AnyShape,
    /// A roundabout.
    Round,
}

/// For each chain the ring that it is part of.
pub(super) fn rings(network: &Network) -> Vec<Ring> {
    (0..network.chains.len()).map(|it| ring_of(network, ChainIndex(it as u32))).collect()
}

/// A way from the start of a chain on.
#[derive(Clone, Copy)]
struct Way {
    length: f64,
    /// The turn so far [rad].
    turn: f64,
    /// Direction at its end [rad].
    heading: f64,
    /// The least and the largest curvature of its chains [1/m].
    curvatures: [f64; 2],
}

impl Way {
    fn along(chain: &Chain) -> Way {
        let points = chain.centre.points();
        let headings: Vec<f64> =
            points.windows(2).map(|it| (it[1].y - it[0].y).atan2(it[1].x - it[0].x)).collect();
        let turn: f64 = headings.windows(2).map(|it| turned(it[0], it[1])).sum();
        let curvature = turn.abs() / chain.length;
        let curvatures = if chain.length < SHORT { [f64::INFINITY, 0.0] } else { [curvature; 2] };
        Way { length: chain.length, turn, heading: headings[headings.len() - 1], curvatures }
    }

    /// The same way, and on along `chain`.
    fn on(&self, chain: &Chain) -> Way {
        let next = Way::along(chain);
        let joint = turned(self.heading, next.heading - next.turn);
        Way {
            length: self.length + next.length,
            turn: self.turn + joint + next.turn,
            heading: next.heading,
            curvatures: [
                self.curvatures[0].min(next.curvatures[0]),
                self.curvatures[1].max(next.curvatures[1]),
            ],
        }
    }

    fn is_round(&self) -> bool {
        let [least, largest] = self.curvatures;
        largest <= ROUND * least
    }

    fn may_be_ring(&self) -> bool {
        self.length <= if self.is_round() { LONGEST_ROUND } else { LONGEST }
    }
}

fn ring_of(network: &Network, start: ChainIndex) -> Ring {
    let near_sign = network.driving_side.overtaking().sign();
    let first = network.chain(start);
    let first_heading = first.centre.heading(0.0);
    let way = Way::along(first);
    if !way.may_be_ring() {
        return Ring::No;
    }
    // Each chain is reached once, along the shortest path.
    let mut open = vec![(start, way)];
    let mut seen = vec![start];
    while let Some(nearest) = (0..open.len()).min_by(|a, b| open[*a].1.length.total_cmp(&open[*b].1.length)) {
        let (at, way) = open.swap_remove(nearest);
        for next in &network.chain(at).following {
            if *next == start {
                let turn = way.turn + turned(way.heading, first_heading);
                return match ONCE_AROUND.contains(&(near_sign * turn)) {
                    true if way.is_round() => Ring::Round,
                    true => Ring::AnyShape,
                    false => Ring::No,
                };
            }
            if seen.contains(next) {
                continue;
            }
            let further = way.on(network.chain(*next));
            if further.may_be_ring() {
                seen.push(*next);
                open.push((*next, further));
            }
        }
    }
    Ring::No
}
