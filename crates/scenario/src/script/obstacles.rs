//! The obstacles of a scenario: when they come, and when they are taken away.

use laneweave_network::Rectangle;
use laneweave_sim::{CommandError, VehicleId, World};
use serde::{Deserialize, Serialize};

use super::{Wrong, first_step_from, refused};
use crate::fault::Fault;
use crate::scenario::{LONGEST, Obstacle};

/// An obstacle of the scenario.
#[derive(Clone)]
pub(super) struct Planned {
    ground: Rectangle,
    from_step: u32,
    until_step: Option<u32>,
}

/// What has become of an obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Stage {
    /// It has not come yet.
    Ahead,
    /// Its place is not free.
    Waits,
    /// It stands on the road, with this id.
    Stands(VehicleId),
    /// It was taken away.
    Over,
    /// Its time is over, and its place was never free.
    Missed,
}

/// An obstacle as it is planned, if it is possible in `world`.
pub(super) fn planned(obstacle: &Obstacle, world: &World) -> Result<Planned, Wrong> {
    let Obstacle { lanelet, position_m, length_m, width_m, from_s, until_s } = *obstacle;
    let in_range = |key, time_s: f64| {
        let wrong = || (key, format!("a time of {time_s} s"), format!("choose 0 to {LONGEST} s"));
        (0.0..=LONGEST)
            .contains(&time_s)
            .then_some(first_step_from(time_s, world.clock().dt))
            .ok_or_else(wrong)
    };
    let from_step = in_range("from_s", from_s)?;
    let until_step = until_s.map(|it| in_range("until_s", it)).transpose()?;
    if until_step.is_some_and(|it| it <= from_step) {
        let what = format!("it is taken away at {} s, and comes at {from_s} s", until_s.unwrap_or_default());
        return Err(("until_s", what, "choose a later time, or leave it out".into()));
    }
    let ground = world.obstacle_in_lane(lanelet, position_m, [length_m, width_m]).map_err(|error| {
        let key = match error {
            CommandError::Number { what: "a length", .. } => "length_m",
            CommandError::Number { .. } => "width_m",
            CommandError::Place { .. } => "position_m",
            _ => "lanelet",
        };
        let Fault { what, remedy, .. } = refused("", &error);
        (key, what, remedy)
    })?;
    Ok(Planned { ground, from_step, until_step })
}

impl Planned {
    /// One that stands in the map all the time, if it touches a lane of `world`.
    pub(super) fn of_map(ground: &Rectangle, world: &World) -> Option<Planned> {
        let planned = Planned { ground: *ground, from_step: 0, until_step: None };
        world.is_in_lanes(ground).then_some(planned)
    }

    /// What becomes of the obstacle with this `number` before the next step of `world`. One that comes waits for a
    /// while until whoever drives behind can stop far enough behind it to go round it.
    pub(super) fn go_on(&self, number: u32, stage: Stage, world: &mut World) -> Stage {
        let (step, patience) = (world.clock().step, world.clock().steps(super::WAITS));
        let is_over = self.until_step.is_some_and(|it| it <= step);
        match stage {
            Stage::Stands(id) if is_over => {
                world.remove_obstacle(id);
                Stage::Over
            }
            Stage::Ahead | Stage::Waits if is_over => Stage::Missed,
            Stage::Ahead | Stage::Waits if self.from_step <= step => {
                let waits = step < self.from_step + patience;
                if waits && !world.has_room_behind_obstacle(&self.ground) {
                    return Stage::Waits;
                }
                world.put_obstacle(number, &self.ground).map_or(Stage::Waits, Stage::Stands)
            }
            _ => stage,
        }
    }
}
