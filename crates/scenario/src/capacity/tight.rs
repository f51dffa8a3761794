//! The loads of roads so tight that a long vehicle needs both sides of them, as where opposite lanes are narrow or bend
//! tightly: cars pass each other there, and a long vehicle goes alone.

use laneweave_models::yielding::time_to_cover;
use laneweave_network::{Position, Touch, Zone, ZoneKind};
use laneweave_sim::STANDS_BEFORE_A_ZONE;

use super::{Bottleneck, Load, Roads};

/// The loads of all such places without lights.
pub(super) fn loads<'a>(roads: &'a Roads) -> impl Iterator<Item = Load> + 'a {
    let is_lit = roads.network.lit_sides();
    let zones = roads.network.junctions.zones.iter().zip(is_lit);
    let is_tight = |it: &Zone| it.touch == Touch::OneLong && it.kind == ZoneKind::Crossing;
    zones.filter(move |(zone, lit)| is_tight(zone) && *lit != [true; 2]).map(|(zone, _)| load(roads, zone))
}

/// The vehicles on one side of it.
struct Side {
    /// Flow of all, and of the long ones [veh/s].
    flow: f64,
    long: f64,
    /// Time between two of them [s].
    headway: f64,
    /// Time from when a long one starts from rest before it until it has left it, and that in which one that drives
    /// has left it [s].
    blocks: f64,
    clears: f64,
}

/// The load of a `zone`. On each side all pass with their headways. While a long vehicle of the other side is there,
/// none does; and before one of their own can enter, the others have to leave (ours).
fn load(roads: &Roads, zone: &Zone) -> Load {
    let sides = [0, 1].map(|side| of_side(roads, zone, side));
    let share = |own: &Side, other: &Side| {
        if own.flow == 0.0 || other.flow == 0.0 {
            return 0.0;
        }
        own.flow * own.headway + other.long * other.blocks + own.long * other.clears
    };
    let [one, other] = &sides;
    let at = zone.sides.map(|it| Position::new(it.chain, it.start.max(0.0)));
    let lanelet = roads.lanelet(at[0].chain, at[0].x);
    Load::new(share(one, other).max(share(other, one)), Bottleneck::Junction(lanelet), at.to_vec())
}

fn of_side(roads: &Roads, zone: &Zone, side: usize) -> Side {
    let reach = &zone.sides[side];
    let limit = roads.network.chain(reach.chain).limit(reach.start.max(0.0));
    let curvature = roads.curvature(reach.chain, [reach.start, reach.end]);
    let mixture = roads.queues.mixture(limit, curvature);
    let way = reach.end - reach.start;
    let flow = roads.assignment.flow(reach.chain, reach.start.max(0.0))[1];
    Side {
        flow,
        long: flow * mixture.share_of_long(),
        headway: 1.0 / roads.queues.stream(limit, curvature),
        blocks: mixture
            .mean_of_long(|length, desired| time_to_cover(STANDS_BEFORE_A_ZONE + way + length, 0.0, desired)),
        clears: mixture.mean_of(|length, desired| (way + length) / desired),
    }
}
