//! In which zones nobody stands, as others cross there. Ours.
//!
//! Where a map says which lanelets conflict, two lanes that only come near each other, or lead into one, leave drivers
//! where they have to stop: junctions follow each other so closely in drawn towns that a queue would never reach the
//! next line. Else all zones are kept clear, as shapes do not tell a crossing for certain.

use crate::junction::{Reach, Zone, ZoneKind};
use crate::lanelet::LaneletIndex;
use crate::network::Network;

/// Notes in which zones nobody stands: in all but those that the map excludes.
pub(super) fn settle(network: &Network, zones: &mut [Zone]) {
    for zone in zones {
        zone.is_kept_clear = cross(network, zone);
    }
}

/// Whether vehicles cross in a zone, as far as the map says.
fn cross(network: &Network, zone: &Zone) -> bool {
    let [ones, others] = zone.sides.each_ref().map(|it| lanelets(network, it));
    let pairs = || ones.iter().flat_map(|one| others.iter().map(move |other| [*one, *other]));
    let listed = |of: LaneletIndex| network.lanelets[of.at()].conflicting.as_ref();
    if pairs().any(|[one, other]| listed(one).is_none() || listed(other).is_none()) {
        return true;
    }
    let lists = |one: LaneletIndex, other: LaneletIndex| listed(one).is_some_and(|it| it.contains(&other));
    zone.kind == ZoneKind::Crossing && pairs().any(|[one, other]| lists(one, other) || lists(other, one))
}

/// The lanelets of a stretch of a chain.
fn lanelets<'a>(network: &'a Network, reach: &Reach) -> &'a [LaneletIndex] {
    let chain = network.chain(reach.chain);
    let first = chain.starts.partition_point(|it| *it <= reach.start).saturating_sub(1);
    let last = chain.starts.partition_point(|it| *it < reach.end).max(first + 1);
    &chain.lanelets[first..last]
}
