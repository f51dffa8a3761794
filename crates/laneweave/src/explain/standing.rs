//! Why a vehicle stands, in words.

use laneweave_network::Network;
use laneweave_sim::{FIRST_OBSTACLE, JunctionHindrance, Spot, StandsFor, VehicleId, World, wait_cycle};

/// A vehicle, or an obstacle by its place in the scenario.
fn named(id: VehicleId) -> String {
    match id.checked_sub(FIRST_OBSTACLE) {
        Some(number) => format!("obstacle {}", number + 1),
        None => format!("vehicle {id}"),
    }
}

/// Why the vehicle at `spot` stands, with all who wait for each other where that is so.
pub(crate) fn why_it_stands(world: &World, spot: Spot) -> String {
    let reason = stands_for(&laneweave_sim::stands_for(world, spot), world.network());
    match &wait_cycle(world, spot)[..] {
        [] => reason,
        circle => format!("{reason}; {} wait for each other, each for the next", vehicles(circle)),
    }
}

/// The reason, as one sentence.
fn stands_for(it: &StandsFor, network: &Network) -> String {
    match it {
        StandsFor::Leader { vehicle, gap } => {
            format!("it stands behind {}, {gap:.1} m ahead", named(*vehicle))
        }
        StandsFor::Light(id) => format!("it waits at traffic light {id}"),
        StandsFor::StopSign => "it stops at a stop sign".into(),
        StandsFor::After(others) => format!("it goes after {}", vehicles(others)),
        StandsFor::LaneEnd(distance) => format!("its lane ends {distance:.1} m ahead"),
        StandsFor::LastPlace(distance) => {
            format!("the last place for a route-driven lane change is {distance:.1} m ahead")
        }
        StandsFor::Obstacle { vehicle, gap } => {
            format!("{} stands in its lane {gap:.1} m ahead: it looks for a gap beside it", named(*vehicle))
        }
        StandsFor::LetsIn(distance) => {
            format!("it yields to a vehicle that changes lanes {distance:.1} m ahead")
        }
        StandsFor::Stop(left) => format!("it rests at a stop of its line for another {left:.1} s"),
        StandsFor::Nothing => "nothing blocks it: it starts to drive".into(),
        StandsFor::Junction { areas, why, others } => {
            let lanelet = |it| network.lanelet_at(it).0.id;
            let areas: Vec<String> = areas
                .iter()
                .map(|sides| sides.map(lanelet))
                .map(|[one, other]| format!("lanelets {one} and {other}"))
                .collect();
            let why = match why {
                JunctionHindrance::Others => {
                    let go = if others.len() == 1 { "has" } else { "have" };
                    format!("{} {go} priority", vehicles(others))
                }
                JunctionHindrance::Space => "there is no storage space beyond".into(),
                JunctionHindrance::Roundabout => "the roundabout is full".into(),
            };
            format!("it waits for the conflict area of {}: {why}", areas.join(", of "))
        }
    }
}

fn vehicles(ids: &[VehicleId]) -> String {
    match ids {
        [] => "others".into(),
        [one] => format!("vehicle {one}"),
        all => format!("vehicles {}", all.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
}
