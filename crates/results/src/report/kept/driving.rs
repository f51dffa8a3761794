//! Driving behaviour by style: distances to the leader, times to collision, accelerations; sampled every five
//! seconds.

use laneweave_models::Style;
use laneweave_models::change::time_to_collision;
use laneweave_models::follow::Ahead;
use laneweave_network::ChainIndex;
use laneweave_sim::{Spot, World};
use laneweave_study::Histogram;
use laneweave_study::units::KMH_PER_MPS;
use serde::{Deserialize, Serialize};

/// Time between two samples [s]: in less time a vehicle changes little.
const SAMPLING: f64 = 5.0;
/// Bins of time gaps and of times to collision [s]: their width and number.
const TIME_GAPS: (f64, usize) = (0.25, 32);
const TIMES_TO_COLLISION: (f64, usize) = (0.5, 30);
/// Bins of speeds [km/h]: their width and number.
const SPEEDS: (f64, usize) = (5.0, 60);
/// Bins of accelerations [m/s²]: the first, their width and number.
const ACCELERATIONS: (f64, f64, usize) = (-8.0, 0.25, 48);
/// Minimum speed for a time gap [m/s]; ours.
const MOVES: f64 = 2.0;

/// Observes the drivers.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Driving {
    /// Style of each set of driver parameters.
    style_of: Vec<u16>,
    /// The samples, by style.
    pub styles: Vec<StyleDriving>,
}

/// The driving behaviour of a style.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct StyleDriving {
    /// The style.
    pub name: String,
    /// Samples: one for each vehicle on the road every five seconds.
    pub samples: u64,
    /// Distance driven, from the speeds at the samples [m].
    pub distance: f64,
    /// Samples of vehicles with a leader within sight.
    pub following: u64,
    /// Speeds [km/h].
    pub speeds: Histogram,
    /// Net time gaps to the leader, of the moving vehicles among them [s].
    pub time_gaps: Histogram,
    /// Times to collision of those that close in on their leaders [s].
    pub times_to_collision: Histogram,
    /// Accelerations [m/s²].
    pub accelerations: Histogram,
}

impl Driving {
    /// What is kept for the styles of `world`.
    pub fn of(world: &World) -> Driving {
        let styles = names(world).into_iter().map(StyleDriving::new).collect();
        Driving { style_of: styles_of(world), styles }
    }

    /// Whether it goes on from `new`, which has seen nothing: the same styles and bins.
    pub(super) fn fits(&self, new: &Driving) -> bool {
        self.style_of == new.style_of
            && self.styles.len() == new.styles.len()
            && self.styles.iter().zip(&new.styles).all(|(it, new)| it.fits(new))
    }

    /// Observes the world after a step.
    pub fn observe(&mut self, world: &World) {
        let clock = world.clock();
        if !clock.step.is_multiple_of(clock.steps(SAMPLING)) {
            return;
        }
        let duration = f64::from(clock.steps(SAMPLING)) * clock.dt;
        let scene = world.scene();
        for (chain, lane) in (0..).map(ChainIndex).zip(scene.lanes) {
            let motions = lane.motions();
            for (index, (it, car)) in motions.iter().zip(lane.drivers()).enumerate() {
                // What a user drives shows nothing of a style.
                if car.is_shadow || car.is_external {
                    continue;
                }
                let style = &mut self.styles[usize::from(self.style_of[car.parameters as usize])];
                style.samples += 1;
                style.distance += it.speed * duration;
                style.speeds.add(it.speed * KMH_PER_MPS);
                style.accelerations.add(f64::from(it.acceleration));
                let ahead = match motions.get(index + 1) {
                    Some(leader) => Some(Ahead::steady(leader.rear() - it.x, leader.speed)),
                    None => scene.ahead(scene.viewpoint(Spot { chain, index })),
                };
                style.see(it.speed, ahead);
            }
        }
    }
}

impl StyleDriving {
    fn new(name: String) -> StyleDriving {
        let (from, width, bins) = ACCELERATIONS;
        StyleDriving {
            name,
            samples: 0,
            distance: 0.0,
            following: 0,
            speeds: Histogram::new(0.0, SPEEDS.0, SPEEDS.1),
            time_gaps: Histogram::new(0.0, TIME_GAPS.0, TIME_GAPS.1),
            times_to_collision: Histogram::new(0.0, TIMES_TO_COLLISION.0, TIMES_TO_COLLISION.1),
            accelerations: Histogram::new(from, width, bins),
        }
    }

    fn fits(&self, new: &StyleDriving) -> bool {
        self.name == new.name
            && self.speeds.fits(&new.speeds)
            && self.time_gaps.fits(&new.time_gaps)
            && self.times_to_collision.fits(&new.times_to_collision)
            && self.accelerations.fits(&new.accelerations)
    }

    fn see(&mut self, speed: f64, ahead: Option<Ahead>) {
        /// Maximum distance of a leader [m]: drivers see no further.
        const SIGHT: f64 = laneweave_models::change::SIGHT;
        let Some(ahead) = ahead.filter(|it| it.gap < SIGHT) else { return };
        self.following += 1;
        if speed >= MOVES {
            self.time_gaps.add(ahead.gap / speed);
        }
        if speed > ahead.speed {
            self.times_to_collision.add(time_to_collision(ahead.gap, speed, ahead.speed));
        }
    }
}

/// The names of the styles, in the order of the demand.
pub(super) fn names(world: &World) -> Vec<String> {
    typical(world).map(|it| it.name.clone()).collect()
}

/// One set of driver parameters of each style, in the order of the demand.
pub(super) fn typical(world: &World) -> impl Iterator<Item = &Style> {
    let driver_parameters = world.scene().driver_parameters;
    world.demand().population.iter().map(|it| &driver_parameters[it.first as usize])
}

/// For each set of driver parameters the index of its style in the demand. Further sets than those of the demand repeat
/// them in their order.
pub(super) fn styles_of(world: &World) -> Vec<u16> {
    let styles = world.demand().population.iter().zip(0..);
    let sets = styles.flat_map(|(share, style)| std::iter::repeat_n(style, share.count as usize));
    sets.collect::<Vec<u16>>().into_iter().cycle().take(world.driver_parameters().len()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_closes_in_has_a_time_to_collision_and_who_moves_a_time_gap() {
        let mut style = StyleDriving::new("any".into());
        let ahead = |gap, speed| Some(Ahead::steady(gap, speed));
        // 20 m at 10 m/s: 2 s; closing at 4 m/s: 5 s.
        style.see(10.0, ahead(20.0, 6.0));
        style.see(10.0, ahead(20.0, 10.0));
        style.see(1.0, ahead(2.0, 0.0));
        style.see(10.0, ahead(300.0, 0.0));
        style.see(10.0, None);
        let seen = |it: &Histogram| (it.total(), it.quantile(1.0));
        assert_eq!(style.following, 3);
        assert_eq!(seen(&style.time_gaps), (2, Some(2.25)));
        assert_eq!(seen(&style.times_to_collision), (2, Some(5.5)));
    }
}
