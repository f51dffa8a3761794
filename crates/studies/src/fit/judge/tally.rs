//! What is counted and measured of traffic, recorded or simulated: both in the same way, from a recording.

use std::collections::HashMap;

use laneweave_models::Style;
use laneweave_models::change::Situation;
use laneweave_network::{ChainIndex, LaneletIndex, Network, Position, Side};
use laneweave_recorded::{Assumed, Replay};
use laneweave_recordings::{
    Extent, LaneChange, Matched, Place, RecordedChangeKind, Recording, cut_ins, extents, lane_changes,
};
use laneweave_scenario::Fault;
use laneweave_study::units::METRES_PER_KM;

use crate::fit::sources::Site;

/// Density is measured in sections of lanes of this length [m], over this time [s] (ours).
const SECTION: f64 = 100.0;
const INTERVAL: f64 = 30.0;
/// Classes of density.
pub(super) const CLASSES: usize = 3;
/// A driver is looked at this time before it crosses the line [s].
const BEFORE: f64 = 1.5;
/// Gaps count as offered to a driver that it had beside it at most so long before its change began, at a look each
/// second [s] (ours).
const LOOKS: u32 = 10;
/// Bounds of the classes of offered gaps: to the new leader and to the new follower together [m] (ours).
pub(super) const OFFERED: [f64; 2] = [30.0, 60.0];
/// Without a vehicle ahead or behind a gap counts as this long [m].
const LONGEST_GAP: f64 = 150.0;
/// A change that begins or ends this near to the first or last sight of its vehicle may have been cut off there [s].
const EDGE: f64 = 0.2;
/// The pace of vehicles that drove at least so far counts [m].
const FAR: f64 = 100.0;

/// Traffic in a section of a lane for some time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Section {
    pub(super) metres: f64,
    pub(super) seconds: f64,
    /// Its length times the interval [m·s].
    pub(super) area: f64,
    pub(super) changes: u32,
}

/// What was counted and measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Tally {
    sections: Vec<Section>,
    /// Lane changes by kind: discretionary, for the route, unknown.
    pub(super) kinds: [u32; 3],
    /// By lane from the slow side: distance [m], and lane changes from it.
    pub(super) lanes: Vec<(f64, u32)>,
    /// Anticipated gains of speed of lane changes [m/s].
    pub(super) gains: Vec<f64>,
    /// Gaps to the new leaders and to the new followers [m].
    pub(super) gaps: [Vec<f64>; 2],
    /// Gaps beside drivers who then changed lanes there, by length: how many there were, and how many were taken.
    pub(super) offered: [[u32; 2]; OFFERED.len() + 1],
    /// Of cut-ins: headways of the followers [s], inverse times to collision [1/s], and the braking with which the
    /// follower comes to the speed of the vehicle before it reaches it [m/s²].
    pub(super) headways: Vec<f64>,
    pub(super) inverse_times: Vec<f64>,
    pub(super) needed_braking: Vec<f64>,
    /// Durations of lane changes that were seen as a whole [s].
    pub(super) durations: Vec<f64>,
    /// Times per distance of vehicles [s/km].
    pub(super) paces: Vec<f64>,
}

/// Where and when traffic is measured.
pub(super) struct Scope<'a> {
    /// The place.
    pub(super) site: &'a Site,
    /// The times [s].
    pub(super) times: [f64; 2],
    /// The style of all drivers: it says how they anticipate speeds.
    pub(super) style: &'a Style,
}

impl Tally {
    /// Adds what is measured of a recording.
    ///
    /// # Errors
    /// If the style makes no sense.
    pub(super) fn add(&mut self, recording: &Recording, scope: &Scope) -> Result<(), Fault> {
        let matched = Matched::new(&scope.site.network, recording);
        let all = lane_changes(&matched);
        let extents = extents(&matched, &all);
        let within = counted(&matched, &all, &extents, scope);
        for at in &within {
            let (change, extent) = (&all[*at], &extents[*at]);
            self.kinds[match change.kind {
                RecordedChangeKind::Discretionary => 0,
                RecordedChangeKind::Route => 1,
                RecordedChangeKind::Unknown => 2,
            }] += 1;
            self.lane(&scope.site.network, change.from).1 += 1;
            if extent.ended <= seen(&matched, change)[1] - EDGE {
                self.durations.push(extent.ended - extent.began);
            }
        }
        let changes: Vec<LaneChange> = within.iter().map(|it| all[*it].clone()).collect();
        for it in cut_ins(&matched, &changes) {
            self.headways.push(it.headway());
            self.inverse_times.push(it.inverse_time_to_collision());
            self.needed_braking.push(it.needed_braking());
        }
        let changes: Vec<&LaneChange> = changes.iter().collect();
        self.add_motion(&matched, &changes, scope);
        self.add_situations(&matched, (&all, &extents), &within, scope)
    }

    /// The lane of a lanelet.
    fn lane(&mut self, network: &Network, lanelet: LaneletIndex) -> &mut (f64, u32) {
        let number = lane_number(network, lanelet);
        if self.lanes.len() <= number {
            self.lanes.resize(number + 1, (0.0, 0));
        }
        &mut self.lanes[number]
    }

    /// Adds distances, times, and paces.
    fn add_motion(&mut self, matched: &Matched, changes: &[&LaneChange], scope: &Scope) {
        let step = matched.recording.step;
        let mut sections: HashMap<(ChainIndex, u32, u32), Section> = HashMap::new();
        let network = matched.network;
        let key = |lanelet: LaneletIndex, station: f64, time: f64| {
            let Position { chain, x } = network.start_of(lanelet);
            let section = ((x + station).max(0.0) / SECTION) as u32;
            (chain, section, ((time - scope.times[0]) / INTERVAL) as u32)
        };
        for (track, places) in matched.recording.tracks.iter().zip(&matched.places) {
            let (mut metres, mut seconds) = (0.0, 0.0);
            for (state, place) in track.states.iter().zip(places) {
                let time = state.frame as f64 * step;
                let Some(Place { lanelet, station, .. }) = place.filter(|_| scope.holds(time)) else {
                    continue;
                };
                let section = sections.entry(key(lanelet, station, time)).or_default();
                section.metres += state.speed * step;
                section.seconds += step;
                self.lane(network, lanelet).0 += state.speed * step;
                metres += state.speed * step;
                seconds += step;
            }
            if metres >= FAR {
                self.paces.push(METRES_PER_KM * seconds / metres);
            }
        }
        for change in changes {
            let places = &matched.places[change.track];
            let states = &matched.recording.tracks[change.track].states;
            let at = states.partition_point(|it| (it.frame as f64) * step < change.time);
            let before = places[..at].iter().rev().flatten().next();
            if let Some(Place { lanelet, station, .. }) = before {
                sections.entry(key(*lanelet, *station, change.time)).or_default().changes += 1;
            }
        }
        let mut sections: Vec<_> = sections.into_iter().collect();
        sections.sort_unstable_by_key(|it| it.0);
        self.sections.extend(sections.into_iter().map(|((chain, number, interval), it)| {
            let length = (network.chain(chain).length - f64::from(number) * SECTION).clamp(1.0, SECTION);
            let time =
                (scope.times[1] - scope.times[0] - f64::from(interval) * INTERVAL).clamp(1.0, INTERVAL);
            Section { area: length * time, ..it }
        }));
    }

    /// Adds what drivers saw before they changed lanes.
    fn add_situations(
        &mut self,
        matched: &Matched,
        (all, extents): (&[LaneChange], &[Extent]),
        within: &[usize],
        scope: &Scope,
    ) -> Result<(), Fault> {
        let styles = [scope.style.clone()];
        let by_speeds = |track| Assumed::by_its_speeds(matched, track, 0);
        let replay = Replay::new(matched, all, &scope.site.navigator, &styles, by_speeds);
        let wrong = |error| Fault::new(&scope.style.name, error, "choose another style");
        let replay = replay.map_err(wrong)?.without_destinations();
        for at in within {
            let change = &all[*at];
            let look = |time: f64| {
                let frame = replay.frame((time / matched.recording.step).round() as i64);
                frame.perceive(change.vehicle, change.side).map(|it| Offer::of(&it))
            };
            if let Some(offer) = look(change.time - BEFORE) {
                self.gains.push(offer.gain);
                self.gaps.iter_mut().zip(offer.gaps).for_each(|(all, gap)| all.push(gap));
            }
            // Before, the vehicle was in another lane.
            let earlier =
                all.iter().zip(extents).filter(|it| it.0.track == change.track && it.0.time < change.time);
            let since = earlier.map(|it| it.1.ended).fold(f64::NEG_INFINITY, f64::max);
            let times = (0..LOOKS).map(|it| extents[*at].began - f64::from(it));
            for (number, offer) in times.take_while(|it| *it >= since).map_while(look).enumerate() {
                let [offered, taken] = &mut self.offered[offer.class()];
                *offered += 1;
                *taken += u32::from(number == 0);
            }
        }
        Ok(())
    }

    /// Lane changes.
    pub(super) fn changes(&self) -> u32 {
        self.kinds.iter().sum()
    }

    /// Distance of all vehicles [m], and their time [s].
    pub(super) fn exposure(&self) -> [f64; 2] {
        let all = self.sections.iter();
        all.fold([0.0; 2], |[metres, seconds], it| [metres + it.metres, seconds + it.seconds])
    }

    /// Lane changes per vehicle-kilometre.
    pub(super) fn rate(&self) -> Option<f64> {
        rate(self.changes(), self.exposure()[0])
    }

    /// The densities between which a third of the distance is driven each [veh/km].
    pub(super) fn thirds(&self) -> [f64; CLASSES - 1] {
        let mut all: Vec<(f64, f64)> = self.sections.iter().map(|it| (it.density(), it.metres)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total = self.exposure()[0];
        std::array::from_fn(|class| {
            let (share, mut sum) = ((class + 1) as f64 / CLASSES as f64, 0.0);
            let found = all.iter().find(|it| {
                sum += it.1;
                sum >= share * total
            });
            found.map_or(f64::INFINITY, |it| it.0)
        })
    }

    /// Mean densities of the traffic in the classes [veh/km].
    pub(super) fn densities(&self) -> [f64; CLASSES] {
        self.by_density(self.thirds()).map(|it| it.density())
    }

    /// All traffic by class of density.
    pub(super) fn by_density(&self, thirds: [f64; CLASSES - 1]) -> [Section; CLASSES] {
        let mut sums = [Section::default(); CLASSES];
        for it in &self.sections {
            let sum = &mut sums[thirds.partition_point(|bound| *bound <= it.density())];
            sum.changes += it.changes;
            sum.metres += it.metres;
            sum.seconds += it.seconds;
            sum.area += it.area;
        }
        sums
    }
}

/// What a driver has beside it.
struct Offer {
    /// The anticipated gain of speed [m/s].
    gain: f64,
    /// The gaps to the new leader and to the new follower [m].
    gaps: [f64; 2],
}

impl Offer {
    fn of(Situation { here, there, .. }: &Situation) -> Offer {
        let gaps = [there.ahead.map(|it| it.gap), there.behind.map(|it| it.gap)];
        Offer {
            gain: there.anticipated_speed - here.anticipated_speed,
            gaps: gaps.map(|it| it.map_or(LONGEST_GAP, |it| it.min(LONGEST_GAP))),
        }
    }

    /// The class of its length.
    fn class(&self) -> usize {
        let length: f64 = self.gaps.iter().sum();
        OFFERED.partition_point(|bound| *bound <= length)
    }
}

impl Section {
    /// Edie's density of its lane [veh/km].
    fn density(&self) -> f64 {
        METRES_PER_KM * self.seconds / self.area.max(f64::MIN_POSITIVE)
    }
}

/// The lane changes that count: those that began in view. A simulated vehicle comes in the middle of its lane, so that
/// none had begun before.
fn counted(matched: &Matched, all: &[LaneChange], extents: &[Extent], scope: &Scope) -> Vec<usize> {
    let began = |at: &usize| extents[*at].began >= seen(matched, &all[*at])[0] + EDGE;
    (0..all.len()).filter(|at| scope.holds(all[*at].time) && began(at)).collect()
}

/// When the vehicle of a change was first and last seen [s].
fn seen(matched: &Matched, change: &LaneChange) -> [f64; 2] {
    let (states, step) = (&matched.recording.tracks[change.track].states, matched.recording.step);
    [0, states.len() - 1].map(|it| states[it].frame as f64 * step)
}

impl Scope<'_> {
    fn holds(&self, time: f64) -> bool {
        (self.times[0]..=self.times[1]).contains(&time)
    }
}

/// Lane changes per vehicle-kilometre.
pub(super) fn rate(changes: u32, metres: f64) -> Option<f64> {
    (metres > 0.0).then(|| f64::from(changes) / (metres / METRES_PER_KM))
}

/// The number of a lanelet's lane from the slow side, from 0 on.
fn lane_number(network: &Network, lanelet: LaneletIndex) -> usize {
    let slower = |it: &LaneletIndex| {
        let lanelet = &network.lanelets[it.at()];
        match network.driving_side.overtaking() {
            Side::Left => lanelet.right.or(lanelet.adjacent_right),
            Side::Right => lanelet.left.or(lanelet.adjacent_left),
        }
    };
    // No road has more lanes than the map has lanelets.
    std::iter::successors(slower(&lanelet), slower).take(network.lanelets.len()).count()
}
