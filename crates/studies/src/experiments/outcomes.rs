//! What comes of lane changes on a motorway without ramps. Its lanes are chains of equal length, numbered from the slow
//! side, so that vehicles on different lanes are compared by how far along they are.

use std::collections::BTreeMap;

use laneweave::study::Moments;
use laneweave::{LaneChange, LaneChangeKind, Side, Simulation, VehicleId};

/// The speed that a change gained is measured over this time [s] (ours).
const AFTER: f64 = 15.0;
/// The traffic that a driver leaves is what was so far behind and ahead of it in its old lane [m]: the paper's window.
const WINDOW: [f64; 2] = [100.0, 200.0];
/// A new follower with less than this time gap was cut off [s] (ours).
const SHORT: f64 = 1.0;

/// What came of completed lane changes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcomes {
    /// How much faster drivers are than the traffic that they left, in the time after a discretionary change [m/s].
    /// Who leaves an empty lane is compared with its own speed at the change.
    pub(crate) gains: Moments,
    /// Changes back to the slow side, and how many of these drivers had passed nobody since they left it.
    pub(crate) returns: Share,
    /// Changes, and how many left their new followers a short time gap.
    pub(crate) discretionary: Share,
    pub(crate) keeping: Share,
    /// Who was ahead when a driver changed to the fast side.
    ahead: BTreeMap<VehicleId, Vec<VehicleId>>,
    races: Vec<Race>,
}

/// How many of all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Share {
    all: u32,
    some: u32,
}

/// A driver and the traffic that it left, from a change on.
#[derive(Clone, Debug, PartialEq)]
struct Race {
    until: f64,
    own: Place,
    left: Vec<Place>,
}

/// A vehicle at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    id: VehicleId,
    lane: usize,
    /// Front and rear bumper [m].
    front: f64,
    rear: f64,
    speed: f64,
}

impl Share {
    fn add(&mut self, is_one: bool) {
        self.all += 1;
        self.some += u32::from(is_one);
    }

    /// In percent; `None` of nothing.
    pub(crate) fn percent(self) -> Option<f64> {
        (self.all > 0).then(|| 100.0 * f64::from(self.some) / f64::from(self.all))
    }
}

impl Outcomes {
    /// Notes a completed `change`, at whose time traffic is that of `simulation`.
    pub(crate) fn note(&mut self, simulation: &Simulation, change: &LaneChange) {
        let places: Vec<Place> = simulation
            .views()
            .filter(|it| it.is_in_lane())
            .map(|it| Place {
                id: it.id(),
                lane: it.spot.chain.at(),
                front: it.x(),
                rear: it.motion.rear(),
                speed: it.speed(),
            })
            .collect();
        if let Some(own) = places.iter().find(|it| it.id == change.vehicle) {
            self.note_at(own, &places, change.side, change.kind, simulation.time_s());
        }
    }

    fn note_at(&mut self, own: &Place, places: &[Place], side: Side, kind: LaneChangeKind, time: f64) {
        match side {
            Side::Left => {
                let ahead = places.iter().filter(|it| it.front > own.front).map(|it| it.id).collect();
                self.ahead.insert(own.id, ahead);
            }
            Side::Right => {
                if let Some(were_ahead) = self.ahead.remove(&own.id) {
                    // Whoever is further to the fast side was not overtaken.
                    let is_passed = |it: &Place| {
                        it.lane <= own.lane && it.front < own.front && were_ahead.contains(&it.id)
                    };
                    self.returns.add(!places.iter().any(is_passed));
                }
            }
        }
        let is_short = new_follower(own, places).is_some_and(|it| own.rear - it.front < SHORT * it.speed);
        match kind {
            LaneChangeKind::Discretionary => {
                self.discretionary.add(is_short);
                self.races.push(Race { until: time + AFTER, own: *own, left: left_by(own, places, side) });
            }
            LaneChangeKind::Keeping => self.keeping.add(is_short),
            LaneChangeKind::Route => {}
        }
    }

    /// Measures the gains of changes that are long enough ago.
    pub(crate) fn look(&mut self, simulation: &Simulation) {
        let time = simulation.time_s();
        self.races.retain(|race| {
            let is_over = time >= race.until;
            if is_over {
                let gain = race.gain(time - race.until + AFTER, |id| simulation.view(id).map(|it| it.x()));
                gain.into_iter().for_each(|it| self.gains.add(it));
            }
            !is_over
        });
    }
}

impl Race {
    /// How much faster the driver was in this `time` [s] than those it left [m/s], by where they are now. `None` if it
    /// has left the road, or if they all have.
    fn gain(&self, time: f64, now: impl Fn(VehicleId) -> Option<f64>) -> Option<f64> {
        let speed = |it: &Place| now(it.id).map(|now| (now - it.front) / time);
        let mut others = Moments::default();
        self.left.iter().filter_map(speed).for_each(|it| others.add(it));
        let usual = if self.left.is_empty() { self.own.speed } else { others.estimate()?.mean };
        Some(speed(&self.own)? - usual)
    }
}

/// The vehicle behind in the new lane.
fn new_follower<'a>(own: &Place, places: &'a [Place]) -> Option<&'a Place> {
    let behind = places.iter().filter(|it| it.lane == own.lane && it.front < own.front);
    behind.max_by(|a, b| a.front.total_cmp(&b.front))
}

/// The vehicles around in the lane that was left to this `side`.
fn left_by(own: &Place, places: &[Place], side: Side) -> Vec<Place> {
    let is_old = |lane: usize| match side {
        Side::Left => lane + 1 == own.lane,
        Side::Right => lane == own.lane + 1,
    };
    let [behind, ahead] = WINDOW;
    let is_near = |it: &Place| (-behind..ahead).contains(&(it.front - own.front));
    places.iter().filter(|it| is_old(it.lane) && is_near(it)).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(id: VehicleId, lane: usize, front: f64) -> Place {
        Place { id, lane, front, rear: front - 5.0, speed: 20.0 }
    }

    /// Vehicle 1 goes to the fast side at 100 m, and back at 500 m, when the vehicle ahead of it is at `other`.
    fn returned(other: Place) -> Option<f64> {
        let mut outcomes = Outcomes::default();
        let mut note = |own: Place, other: Place, side| {
            outcomes.note_at(&own, &[own, other], side, LaneChangeKind::Keeping, 0.0);
        };
        note(at(1, 1, 100.0), at(2, 0, 150.0), Side::Left);
        note(at(1, 0, 500.0), other, Side::Right);
        outcomes.returns.percent()
    }

    #[test]
    fn a_return_passed_nobody_if_the_leader_is_still_ahead() {
        assert_eq!(returned(at(2, 0, 520.0)), Some(100.0));
        assert_eq!(returned(at(2, 0, 480.0)), Some(0.0));
        // It went to the fast side itself: passed on the slow side, not overtaken.
        assert_eq!(returned(at(2, 1, 480.0)), Some(100.0));
    }

    #[test]
    fn a_change_to_the_slow_side_that_was_never_left_is_no_return() {
        let mut outcomes = Outcomes::default();
        let own = at(1, 0, 100.0);
        outcomes.note_at(&own, &[own], Side::Right, LaneChangeKind::Keeping, 0.0);
        assert_eq!(outcomes.returns.percent(), None);
    }

    #[test]
    fn a_follower_within_a_second_counts_for_the_kind_of_the_change() {
        let mut outcomes = Outcomes::default();
        let own = at(1, 1, 100.0);
        for (behind, kind) in [(76.0, LaneChangeKind::Keeping), (74.0, LaneChangeKind::Discretionary)] {
            // One in the old lane is no follower.
            let places = [own, at(2, 1, behind), at(3, 0, 94.0)];
            outcomes.note_at(&own, &places, Side::Left, kind, 0.0);
        }
        assert_eq!(outcomes.keeping.percent(), Some(100.0));
        assert_eq!(outcomes.discretionary.percent(), Some(0.0));
    }

    #[test]
    fn a_gain_is_over_the_traffic_near_in_the_lane_that_was_left() {
        let own = at(1, 1, 100.0);
        let places =
            [own, at(2, 1, 110.0), at(3, 0, 140.0), at(4, 0, 40.0), at(5, 0, 310.0), at(6, 2, 120.0)];
        let left = left_by(&own, &places, Side::Left);
        assert_eq!(left.iter().map(|it| it.id).collect::<Vec<_>>(), [3, 4]);
        assert_eq!(left_by(&own, &places, Side::Right), [at(6, 2, 120.0)]);
        let race = Race { until: 15.0, own, left };
        // 22, 18 and 16 m/s in ten seconds.
        let after = |id: VehicleId| {
            [(1, 320.0), (3, 320.0), (4, 200.0)].into_iter().find(|it| it.0 == id).map(|it| it.1)
        };
        assert_eq!(race.gain(10.0, after), Some(5.0));
        let gone = |id: VehicleId| after(id).filter(|_| id != 4);
        assert_eq!(race.gain(10.0, gone), Some(4.0));
        let alone = Race { left: Vec::new(), ..race.clone() };
        assert_eq!(alone.gain(10.0, after), Some(2.0));
        assert_eq!(race.gain(10.0, |_| None), None);
    }
}
