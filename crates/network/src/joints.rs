//! The lanelets that continue another one: those that follow in the graph, and those that only begin at its end,
//! because the map's points were drawn twice.

use std::collections::HashMap;

use crate::build::NetworkError;
use crate::geometry::Point;
use crate::lanelet::{Lanelet, LaneletIndex};
use crate::network::Network;

/// Maximum distance between corners that were drawn twice [m]. Ours.
const MAXIMUM_GAP: f64 = 0.75;
/// Maximum bend of the road at a joint [rad]. Ours.
const MAXIMUM_BEND: f64 = 0.3;
/// Lanes on bridges are at least this far above each other [m].
const MAXIMUM_HEIGHT: f64 = 2.0;

/// For each lanelet those that continue it, first those of the graph.
pub fn onward(lanelets: &[Lanelet]) -> Vec<Vec<LaneletIndex>> {
    let mut starts: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    for (index, lanelet) in lanelets.iter().enumerate() {
        starts.entry(cell(&lanelet.left_border.points()[0])).or_default().push(index);
    }
    lanelets
        .iter()
        .map(|lanelet| {
            let end = lanelet.left_border.at(lanelet.left_border.length());
            let (column, row) = cell(&end);
            let cells = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (column + dx, row + dy)));
            let near = cells.filter_map(|it| starts.get(&it)).flatten().copied();
            let mut begins_there: Vec<LaneletIndex> = near
                .filter(|it| goes_on(lanelet, &lanelets[*it]))
                .map(|it| LaneletIndex(it as u32))
                .filter(|it| !lanelet.following.contains(it))
                .collect();
            begins_there.sort();
            lanelet.following.iter().copied().chain(begins_there).collect()
        })
        .collect()
}

impl Network {
    /// The same network, not yet regulated, in which lanelets that meet at their ends, but share no points, continue
    /// one another.
    ///
    /// # Errors
    /// None, as long as the network is sound.
    pub fn joined(self) -> Result<Network, NetworkError> {
        let Network { mut lanelets, driving_side, law, .. } = self;
        let onward = onward(&lanelets);
        lanelets.iter_mut().zip(onward).for_each(|(lanelet, onward)| lanelet.following = onward);
        let mut network = Network::new(lanelets, driving_side)?;
        network.law = law;
        Ok(network)
    }
}

fn cell(point: &Point) -> (i64, i64) {
    ((point.x / MAXIMUM_GAP).floor() as i64, (point.y / MAXIMUM_GAP).floor() as i64)
}

/// Whether `next` begins where `lanelet` ends, at both borders and in its direction.
fn goes_on(lanelet: &Lanelet, next: &Lanelet) -> bool {
    let meet = |end: Point, start: &Point| {
        end.distance(start) <= MAXIMUM_GAP && (end.z - start.z).abs() <= MAXIMUM_HEIGHT
    };
    let bend = next.centre.heading(0.0) - lanelet.centre.heading(lanelet.length());
    meet(lanelet.left_border.at(lanelet.left_border.length()), &next.left_border.points()[0])
        && meet(lanelet.right_border.at(lanelet.right_border.length()), &next.right_border.points()[0])
        && bend.cos() >= MAXIMUM_BEND.cos()
}
