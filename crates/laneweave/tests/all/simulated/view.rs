//! The knowledge of a driver, in plain numbers.

use laneweave_models::change::{LaneView, Situation};

/// Tolerances of gaps and remaining distances [m], speeds [m/s] and remaining times [s], and relative tolerance of
/// mean spacings: the effect of 10 cm of noise and smoothing.
const GAP: f64 = 0.5;
const REMAINING: f64 = 1.0;
const SPEED: f64 = 0.45;
const TIME: f64 = 0.1;
const SPACING: f64 = 0.01;

/// A situation in numbers that can be compared.
#[derive(Clone, Debug)]
pub(crate) struct View {
    pub(crate) speed: f64,
    pub(crate) desired: f64,
    pub(crate) section: f64,
    pub(crate) lanes: [Lane; 2],
}

/// The own lane, or the one beside.
#[derive(Clone, Debug)]
pub(crate) struct Lane {
    ahead: Option<Neighbour>,
    behind: Option<Neighbour>,
    anticipated_speed: f64,
    mean_spacing: f64,
    mean_speed: f64,
    changes: u32,
    remaining: f64,
    onward: f64,
}

/// The leader or the follower.
#[derive(Clone, Copy, Debug)]
struct Neighbour {
    gap: f64,
    speed: f64,
}

impl View {
    pub(crate) fn of(situation: &Situation) -> View {
        View {
            speed: situation.me.pace.speed,
            desired: situation.me.pace.desired,
            section: situation.section,
            lanes: [&situation.here, &situation.there].map(Lane::of),
        }
    }

    /// Whether observed and true values are the same except for noise.
    pub(crate) fn agrees(&self, known: &View) -> bool {
        let foresees = |(seen, known): (&Lane, &Lane)| seen.foresees(known);
        self.agrees_here(known) && self.lanes.iter().zip(&known.lanes).all(foresees)
    }

    /// Whether they are, but for what the driver expects of junctions. Lights and rights of way are in no recording,
    /// and where a vehicle was going is so only up to where it was last seen.
    pub(crate) fn agrees_here(&self, known: &View) -> bool {
        near(self.speed, known.speed, SPEED)
            && self.desired == known.desired
            && near(self.section, known.section, REMAINING)
            && self.lanes.iter().zip(&known.lanes).all(|(seen, known)| seen.agrees(known))
    }
}

impl Lane {
    fn of(lane: &LaneView) -> Lane {
        Lane {
            ahead: lane.ahead.map(|it| Neighbour { gap: it.gap, speed: it.speed }),
            behind: lane.behind.map(|it| Neighbour { gap: it.gap, speed: it.driver.pace.speed }),
            anticipated_speed: lane.anticipated_speed,
            mean_spacing: lane.flow.spacing,
            mean_speed: lane.flow.speed,
            changes: lane.route.changes,
            remaining: lane.route.remaining,
            onward: lane.route.onward,
        }
    }

    fn agrees(&self, known: &Lane) -> bool {
        Neighbour::agree(self.ahead, known.ahead)
            && Neighbour::agree(self.behind, known.behind)
            && near(self.mean_spacing, known.mean_spacing, SPACING * known.mean_spacing)
            && near(self.mean_speed, known.mean_speed, SPEED)
            && self.changes == known.changes
            && near(self.remaining, known.remaining, REMAINING)
    }

    fn foresees(&self, known: &Lane) -> bool {
        near(self.anticipated_speed, known.anticipated_speed, SPEED) && near(self.onward, known.onward, TIME)
    }
}

impl Neighbour {
    fn agree(seen: Option<Neighbour>, known: Option<Neighbour>) -> bool {
        match (seen, known) {
            (Some(seen), Some(known)) => {
                near(seen.gap, known.gap, GAP) && near(seen.speed, known.speed, SPEED)
            }
            (seen, known) => seen.is_none() && known.is_none(),
        }
    }
}

/// Infinite values are equal, too.
fn near(one: f64, other: f64, bound: f64) -> bool {
    one == other || (one - other).abs() <= bound
}
