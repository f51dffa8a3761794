//! The lanelets around a vehicle, and how they are linked: a graph.

use laneweave::network::{ChainIndex, Lanelet, LaneletIndex, LightState, Network, PlaceKind, Sign};
use laneweave::sim::Vehicle;
use laneweave::{Fault, Simulation};
use serde::{Deserialize, Serialize};

use super::vehicles::{AHEAD, Frame, SPEED};
use super::{Part, scaled};
use crate::task::wrong;

/// The columns of a lanelet behind its points: whether there is one; whether the vehicle is on it; whether its way
/// leads over it; the speed limit and the width, where the number behind a slash is 1; whether a light on it is not
/// green.
pub const LANELET_COLUMNS: [&str; 6] =
    ["is_there", "is_own", "is_on_way", "speed_limit_mps/40", "width_m/10", "light_is_closed"];
/// The columns of a link: the places of two lanelets, and 0 if the second one continues the first, 1 or 2 if it is on
/// its left or right and a change is allowed. All are −1 where there is no link.
pub const LINK_COLUMNS: [&str; 3] = ["from", "to", "kind"];

/// Width that is 1 [m].
const WIDTH: f64 = 10.0;

/// The lanelets around the vehicle, the nearest first, and how they are linked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Lanes {
    /// How many vehicles.
    pub nearest: usize,
    /// How many lanelets.
    pub lanelets: usize,
    /// How many points of each centre line, at equal distances from its start to its end.
    pub points: usize,
    /// How many links.
    pub links: usize,
}

impl Default for Lanes {
    fn default() -> Lanes {
        Lanes { nearest: 8, lanelets: 24, points: 6, links: 64 }
    }
}

impl Lanes {
    /// The parts with the lanelets and the links.
    pub(super) fn parts(&self) -> [Part; 2] {
        let points =
            (0..self.points).flat_map(|it| [format!("ahead_{it}_m/100"), format!("left_{it}_m/100")]);
        let columns = points.chain(LANELET_COLUMNS.map(str::to_owned)).collect();
        let lanelets = Part { name: "lanelets", shape: vec![self.lanelets, self.columns()], columns };
        [lanelets, Part::new("links", &[self.links, LINK_COLUMNS.len()], &LINK_COLUMNS)]
    }

    fn columns(&self) -> usize {
        2 * self.points + LANELET_COLUMNS.len()
    }

    /// # Errors
    /// If a number is not in its range.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let Lanes { nearest: _, lanelets, points, links } = *self;
        if (1..=256).contains(&lanelets) && (2..=32).contains(&points) && links <= 1024 {
            return Ok(());
        }
        let remedy = "choose 1 to 256 lanelets with 2 to 32 points, and up to 1024 links";
        Err(wrong("observation.lanes", "a number out of range", remedy))
    }

    pub(super) fn write(&self, simulation: &Simulation, ego: &Vehicle, frame: &Frame, numbers: &mut [f32]) {
        let network = simulation.network();
        let (lanelets, links) = numbers.split_at_mut(self.lanelets * self.columns());
        let near = self.near(network, frame);
        let way = way(simulation, ego);
        let (own, _) = network.chain(ego.spot.chain).lanelet(ego.x());
        for (row, index) in lanelets.chunks_exact_mut(self.columns()).zip(&near) {
            let lanelet = &network.lanelets[index.at()];
            let (points, columns) = row.split_at_mut(2 * self.points);
            self.write_points(lanelet, frame, points);
            let is = |it: bool| f32::from(u8::from(it));
            columns.copy_from_slice(&[
                1.0,
                is(*index == own),
                is(way.contains(index)),
                scaled(lanelet.speed_limit, SPEED),
                scaled(lanelet.width(0.5 * lanelet.length()), WIDTH),
                is(is_closed(simulation, *index)),
            ]);
        }
        links.fill(-1.0);
        let place = |index: LaneletIndex| near.iter().position(|it| *it == index);
        let all = near.iter().zip(0..).flat_map(|(index, from)| {
            let lanelet = &network.lanelets[index.at()];
            let following = lanelet.following.iter().map(|it| (*it, 0.0));
            let beside = [(lanelet.left, 1.0), (lanelet.right, 2.0)];
            let beside = beside.into_iter().filter_map(|(it, kind)| Some((it?, kind)));
            following.chain(beside).map(move |(to, kind)| (from, to, kind))
        });
        let known = all.filter_map(|(from, to, kind)| Some([from as f32, place(to)? as f32, kind]));
        for (row, link) in links.chunks_exact_mut(LINK_COLUMNS.len()).zip(known) {
            row.copy_from_slice(&link);
        }
    }

    fn write_points(&self, lanelet: &Lanelet, frame: &Frame, places: &mut [f32]) {
        for (place, number) in places.chunks_exact_mut(2).zip(0..) {
            let share = f64::from(number) / (self.points - 1) as f64;
            let point = lanelet.centre.at(share * lanelet.length());
            place.copy_from_slice(&frame.local(point.x, point.y).map(|it| scaled(it, AHEAD)));
        }
    }

    /// The lanelets near the vehicle, the nearest first.
    fn near(&self, network: &Network, frame: &Frame) -> Vec<LaneletIndex> {
        let mut near: Vec<(f64, LaneletIndex)> = network
            .lanelets
            .iter()
            .zip(0..)
            .map(|(lanelet, index)| (lanelet.centre.distance_to(&frame.origin()), LaneletIndex(index)))
            .filter(|it| it.0 <= AHEAD)
            .collect();
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.into_iter().take(self.lanelets).map(|it| it.1).collect()
    }
}

/// The lanelets of the chains over which the vehicle will drive, as far as it is seen.
fn way(simulation: &Simulation, ego: &Vehicle) -> Vec<LaneletIndex> {
    let (network, scene) = (simulation.network(), simulation.scene());
    let mut lanelets = Vec::new();
    let mut end = -ego.x();
    let mut next: Option<ChainIndex> = Some(ego.spot.chain);
    while let Some(chain) = next.filter(|_| end < 2.0 * AHEAD) {
        lanelets.extend(&network.chain(chain).lanelets);
        end += network.chain(chain).length;
        next = scene.next(ego.driver.goal.destination(), chain);
    }
    lanelets
}

/// Whether a light on a lanelet is not green.
fn is_closed(simulation: &Simulation, lanelet: LaneletIndex) -> bool {
    let (network, scene) = (simulation.network(), simulation.scene());
    let start = network.start_of(lanelet);
    let end = start.x + network.lanelets[lanelet.at()].length();
    let places = network.junctions.on(start.chain).places.iter();
    places.filter(|it| (start.x..=end).contains(&it.station)).any(|it| {
        matches!(it.what, PlaceKind::Sign(Sign::Light(light)) if scene.light(light) != LightState::Green)
    })
}
