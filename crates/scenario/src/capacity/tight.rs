//! The loads of roads so tight that not all vehicles can pass each other, as where opposite lanes are narrow or bend
//! tightly. Cars do, but a long vehicle may need both sides for itself, or a side that no other long one needs.

use laneweave_models::yielding::time_to_cover;
use laneweave_network::{Network, Position, Reach, Touch, Zone, ZoneKind};
use laneweave_sim::STANDS_BEFORE_A_ZONE;

use super::{Bottleneck, Load, Queues, Roads, curvature};

/// Such a place.
pub(super) struct Tight {
    /// Whether a long vehicle meets not even a car there.
    is_for_one: bool,
    /// Where its two sides begin.
    at: [Position; 2],
    sides: [Side; 2],
}

/// The vehicles on one side of it.
struct Side {
    /// The share of long ones.
    long: f64,
    /// Time between two vehicles [s].
    headway: f64,
    /// Time from when a long one starts from rest before it until it has left it, and that in which one that drives
    /// has left it [s].
    blocks: f64,
    clears: f64,
}

/// All such places without lights.
pub(super) fn places(network: &Network, queues: &Queues, is_lit: &[[bool; 2]]) -> Vec<Tight> {
    let is_tight = |it: &Zone| it.touch != Touch::Any && it.kind == ZoneKind::Crossing;
    let zones = network.junctions.zones.iter().zip(is_lit);
    let tight = zones.filter(|(zone, lit)| is_tight(zone) && **lit != [true; 2]);
    tight
        .map(|(Zone { sides, touch, .. }, _)| Tight {
            is_for_one: *touch == Touch::OneLong,
            at: [0, 1].map(|it| Position::new(sides[it].chain, sides[it].start.max(0.0))),
            sides: [0, 1].map(|it| Side::of(network, queues, &sides[it])),
        })
        .collect()
}

/// The loads of these places.
pub(super) fn loads<'a>(roads: &'a Roads, places: &'a [Tight]) -> impl Iterator<Item = Load> + 'a {
    places.iter().map(|place| {
        let flows = place.at.map(|it| roads.assignment.flow(it.chain, it.x)[1]);
        let lanelet = roads.lanelet(place.at[0].chain, place.at[0].x);
        Load::new(place.share(flows), Bottleneck::Junction(lanelet), place.at.to_vec())
    })
}

impl Tight {
    /// The share of the time that these `flows` of its sides take [veh/s].
    fn share(&self, flows: [f64; 2]) -> f64 {
        let Tight { is_for_one, sides: [one, other], .. } = self;
        let [flow, opposite] = flows;
        if flows.contains(&0.0) {
            0.0
        } else if *is_for_one {
            one.share(flow, other, opposite).max(other.share(opposite, one, flow))
        } else {
            // Long ones of both sides take turns: who waits holds up all behind it (ours).
            one.taken_by_long(flow) + other.taken_by_long(opposite)
        }
    }
}

impl Side {
    fn of(network: &Network, queues: &Queues, reach: &Reach) -> Side {
        let limit = network.chain(reach.chain).limit(reach.start.max(0.0));
        let curvature = curvature(network, reach.chain, [reach.start, reach.end]);
        let mixture = queues.mixture(limit, curvature);
        let way = reach.end - reach.start;
        let from_rest = STANDS_BEFORE_A_ZONE + way;
        Side {
            long: mixture.share_of_long(),
            headway: 1.0 / queues.stream(limit, curvature),
            blocks: mixture.mean_of_long(|length, desired| time_to_cover(from_rest + length, 0.0, desired)),
            clears: mixture.mean_of(|length, desired| (way + length) / desired),
        }
    }

    /// The share of the time that this `flow` takes on this side, beside an `opposite` one [veh/s] on the `other`. All
    /// pass with their headways. While a long vehicle of the other side is there, none does; and before one of their
    /// own can enter, the others have to leave (ours).
    fn share(&self, flow: f64, other: &Side, opposite: f64) -> f64 {
        flow * self.headway + other.taken_by_long(opposite) + flow * self.long * self.clears
    }

    /// The share of the time that the long vehicles of this `flow` [veh/s] are there.
    fn taken_by_long(&self, flow: f64) -> f64 {
        flow * self.long * self.blocks
    }
}

#[cfg(test)]
mod tests {
    use laneweave_network::{ChainIndex, Position};

    use super::{Side, Tight};

    /// A place with these shares of long vehicles on its sides.
    fn place(is_for_one: bool, long: [f64; 2]) -> Tight {
        Tight {
            is_for_one,
            at: [0, 1].map(|it| Position::new(ChainIndex(it), 0.0)),
            sides: long.map(|long| Side { long, headway: 2.0, blocks: 6.0, clears: 3.0 }),
        }
    }

    #[test]
    fn a_long_vehicle_takes_its_time_from_both_sides() {
        // Headways, long vehicles of the other side, and before the own ones.
        let fuller = 0.20 * 2.0 + 0.05 * 0.2 * 6.0 + 0.20 * 0.1 * 3.0;
        for [flows, long] in [[[0.20, 0.05], [0.1, 0.2]], [[0.05, 0.20], [0.2, 0.1]]] {
            assert!((place(true, long).share(flows) - fuller).abs() < 1e-12);
        }
    }

    #[test]
    fn where_two_long_vehicles_cannot_pass_each_other_they_take_turns() {
        let share = place(false, [0.1, 0.2]).share([0.20, 0.05]);
        assert!((share - 6.0 * (0.20 * 0.1 + 0.05 * 0.2)).abs() < 1e-12);
        assert_eq!(place(false, [0.0; 2]).share([0.5, 0.5]), 0.0);
    }

    #[test]
    fn cars_pass_each_other_and_a_side_without_traffic_holds_up_nobody() {
        assert_eq!(place(true, [0.0; 2]).share([0.2, 0.3]), 0.6);
        assert_eq!(place(true, [0.5; 2]).share([0.2, 0.0]), 0.0);
    }
}
