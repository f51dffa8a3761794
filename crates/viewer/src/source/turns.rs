//! Where drivers signal because they turn: after a fork, on a lane that leaves the direction of the one before it.

use std::f64::consts::{PI, TAU};

use laneweave::network::{ChainIndex, Network};
use laneweave::sim::Vehicle;
use laneweave::{Side, Simulation};

/// A driver signals from so far before the fork on [m]; ours.
const BEFORE: f64 = 40.0;
/// So far beyond the fork it has turned [m].
const BEYOND: f64 = 30.0;
/// A turn changes the direction by more than this [rad].
const TURN: f64 = PI / 6.0;

/// For each chain after a fork the side to which it turns.
pub(super) struct Turns(Vec<Option<Side>>);

impl Turns {
    pub(super) fn of(network: &Network) -> Turns {
        let mut turns = vec![None; network.chains.len()];
        for before in &network.chains {
            if before.following.len() < 2 {
                continue;
            }
            let heading = before.centre.heading(before.length);
            for after in &before.following {
                let chain = network.chain(*after);
                let turned = chain.centre.heading(BEYOND.min(chain.length)) - heading;
                turns[after.at()] = side(turned);
            }
        }
        Turns(turns)
    }

    /// The side to which the driver of a vehicle turns here.
    pub(super) fn side(&self, simulation: &Simulation, vehicle: &Vehicle) -> Option<Side> {
        let (chain, x) = (vehicle.spot.chain, vehicle.x());
        let here = self.after(chain).filter(|_| x < BEYOND);
        here.or_else(|| {
            let is_near = simulation.network().chain(chain).length - x < BEFORE;
            let next = is_near.then(|| simulation.scene().next(vehicle.driver.goal.destination(), chain))?;
            self.after(next?)
        })
    }

    fn after(&self, chain: ChainIndex) -> Option<Side> {
        self.0.get(chain.at()).copied().flatten()
    }
}

/// The side of a change of direction [rad], if it is a turn.
fn side(turned: f64) -> Option<Side> {
    let turned = (turned + PI).rem_euclid(TAU) - PI;
    match turned {
        _ if turned > TURN => Some(Side::Left),
        _ if turned < -TURN => Some(Side::Right),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_changes_of_direction_by_more_than_thirty_degrees() {
        let of_degrees = |it: f64| side(it.to_radians());
        assert_eq!([25.0, -25.0, 360.0, -350.0].map(of_degrees), [None; 4]);
        assert_eq!([35.0, 100.0, -300.0].map(of_degrees), [Some(Side::Left); 3]);
        assert_eq!([-35.0, 300.0, -90.0].map(of_degrees), [Some(Side::Right); 3]);
    }

    #[test]
    fn on_a_grid_of_streets_drivers_turn_to_both_sides_and_drive_straight_on() {
        let map = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/grid.osm");
        let simulation = Simulation::from_file(map).expect("a map");
        let network = simulation.network();
        let turns = Turns::of(network);
        let after_forks = network.chains.iter().filter(|it| it.following.len() > 1);
        let sides: Vec<_> = after_forks.flat_map(|it| &it.following).map(|it| turns.after(*it)).collect();
        for side in [None, Some(Side::Left), Some(Side::Right)] {
            assert!(sides.iter().filter(|it| **it == side).count() >= sides.len() / 5, "{side:?}");
        }
    }
}
