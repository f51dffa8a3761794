//! Commands of users that change what all drivers know, before any of them decides.

use laneweave_network::{ChainIndex, LaneletIndex, Position};

use crate::driver::me::Attending;
use crate::driver::turn::next_turn;
use crate::route::navigate::Navigator;
use crate::route::roads::Roads;
use crate::state::command::{Command, Commanded};
use crate::state::lane::DriverState;
use crate::state::moment::Moment;
use crate::state::traffic::Traffic;

/// Carries out those of `commands` that change the roads, or what drivers know of them.
pub(super) fn change_roads(roads: &mut Roads, traffic: &mut Traffic, commands: &[Commanded]) {
    for Commanded { command, .. } in commands {
        if let Command::SetParameter { style, parameter, value } = command {
            roads.changed_parameters_mut().set(style, *parameter, *value);
            renew_drivers(roads, traffic, style);
        }
    }
    if commands.iter().any(|it| matches!(it.command, Command::CloseLanelet { .. })) {
        let closed = closed_after(roads, commands);
        close(roads, traffic, |roads| roads.close(closed));
    }
}

/// The lanelets that are closed after `commands`.
fn closed_after(roads: &Roads, commands: &[Commanded]) -> Vec<LaneletIndex> {
    let mut closed = roads.navigator().closures().closed().to_vec();
    for Commanded { command, .. } in commands {
        if let Command::CloseLanelet { lanelet, is_closed } = command
            && let Some(lanelet) = roads.network().lanelet_with(*lanelet)
        {
            closed.retain(|it| *it != lanelet);
            closed.extend(is_closed.then_some(lanelet));
        }
    }
    closed
}

/// Changes where lanes are closed. Drivers who have a closed one ahead, or no longer have one, consider lanes at once.
pub(super) fn close(roads: &mut Roads, traffic: &mut Traffic, change: impl FnOnce(&mut Roads)) {
    let before: Vec<Option<f64>> = closures_ahead(roads, traffic).collect();
    change(roads);
    let now: Vec<Option<f64>> = closures_ahead(roads, traffic).collect();
    let step = traffic.clock().step;
    let mut is_changed = before.iter().zip(&now).map(|(before, now)| before != now);
    for lane in traffic.lanes_mut() {
        for index in 0..lane.drivers().len() {
            if is_changed.next().unwrap_or(false) {
                let (_, driver, lane_change) = lane.entry_mut(index);
                (driver.due, driver.needs_full_update) = (step, true);
                lane_change.last_place = f64::INFINITY;
            }
        }
    }
}

/// For each entry the distance to the next closed lanelet on its route [m].
fn closures_ahead(roads: &Roads, traffic: &Traffic) -> impl Iterator<Item = Option<f64>> {
    let (network, navigator) = (roads.network(), roads.navigator());
    let lanes = traffic.lanes().iter().zip((0..).map(ChainIndex));
    lanes.flat_map(move |(lane, chain)| {
        let entries = lane.motions().iter().zip(lane.drivers());
        entries.map(move |(motion, driver)| {
            let destination = driver.goal.destination();
            let ahead = navigator.closure_ahead(network, destination, chain, motion.x, Navigator::SIGNED);
            ahead.map(|it| it.ahead)
        })
    })
}

/// Renews all that drivers of `style` derived from its numbers: their desired speeds and their turns.
fn renew_drivers(roads: &Roads, traffic: &mut Traffic, style: &str) {
    let (network, clock) = (roads.network(), traffic.clock());
    let moment = Moment { clock, random: roads.random(), overtaking: network.driving_side.overtaking() };
    for (lane, number) in traffic.lanes_mut().iter_mut().zip(0..) {
        for index in 0..lane.drivers().len() {
            let (motion, driver, _) = lane.entry_mut(index);
            let own = roads.style(driver.parameters);
            if own.name == style {
                let at = Position::new(ChainIndex(number), motion.x);
                desire_speed(driver, roads.outlook(driver).until_turn(at, motion.speed, driver.due, clock));
                let period = Attending::with(&own.attention, motion.id, moment).period;
                driver.due = driver.due.min(next_turn(motion.id, clock.step, period));
            }
        }
    }
}

/// Lets a driver desire the speed `desired` [m/s]. It falls to a lower one gradually.
pub(super) fn desire_speed(driver: &mut DriverState, desired: f32) {
    driver.limit_desired = desired;
    driver.desired = driver.desired.max(driver.limit_desired);
}
