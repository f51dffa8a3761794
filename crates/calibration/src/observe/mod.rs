//! From a recording to what its drivers could choose, second by second.

mod changes;
mod desired;
mod in_view;
mod known;
mod place;
mod side;
mod spells;

use laneweave_models::Style;
use laneweave_models::change::{LaneChangeModel, Mcdm};
use laneweave_network::Side;
use laneweave_recorded::{Assumed, Frame, Replay, ReplayError};
use laneweave_recordings::{Extent, LaneChange, Matched, extents, lane_changes};
use laneweave_sim::Navigator;
use rayon::prelude::*;

pub use changes::{ObservedChange, Unused};
pub use desired::{DesiredSpeed, NODES};
pub(crate) use desired::{FREE, Shown, Speeds, USUAL_LOGS, distribution, moments};
pub(crate) use in_view::InView;
pub use known::{FreeTime, Known};
pub use place::Place;
pub use side::{ByDesired, GapDemands, PLAIN, SideSeen, gap_terms};
use spells::{End, SpellTimes};

/// How a recording is observed.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The style of all drivers: their car-following model, and the readings of the incentives.
    pub style: Style,
    /// Decisions are looked at so often in a second; drivers decide once a second, at an unknown phase.
    pub phases: u32,
    /// When a change begins.
    pub begin: Begin,
    /// What is told of the drivers.
    pub known: Known,
}

/// When a change begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Begin {
    /// Where its path shows it; or so long before the crossing as [`USUAL_LEAD`], if many changes of the recording had
    /// begun before their vehicles were first seen.
    Auto,
    /// So long before its vehicle's centre crosses the line [s].
    Lead(f64),
}

/// Time before the crossing at which a change begins whose begin is not seen [s] (ours).
pub const USUAL_LEAD: f64 = 1.5;

impl Options {
    /// The usual ones for drivers of `style`.
    pub fn of(style: Style) -> Options {
        Options { style, phases: 2, begin: Begin::Auto, known: Known::default() }
    }
}

/// What was observed of all drivers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observations {
    /// Number of sites: recordings of one map are one site.
    pub sites: u32,
    /// Times that are looked at in a second.
    pub phases: u32,
    /// The recordings.
    pub recordings: Vec<ObservedRecording>,
    /// The drivers.
    pub drivers: Vec<ObservedDriver>,
    /// All lane changes.
    pub changes: Vec<ObservedChange>,
    /// Distance that vehicles drove [veh·km].
    pub veh_km: f64,
    /// Time for which they were seen on lanelets [veh·h].
    pub veh_h: f64,
}

/// How a recording was observed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObservedRecording {
    /// Time before the crossing at which changes begin [s]; `None`: where their paths show it.
    pub lead: Option<f64>,
    /// Time after a change in which drivers make no other one [s].
    pub cooldown: f64,
    /// Mean and standard deviation, over all drivers, of the logarithms of their desired speeds as factors on what the
    /// limit and the class allow.
    pub desired_logs: [f64; 2],
}

/// What was observed of one driver.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservedDriver {
    /// Its site.
    pub site: u32,
    /// The number of its recording.
    pub recording: u32,
    /// The id of its vehicle there.
    pub vehicle: i64,
    /// When it was first seen [s].
    pub first_seen: f64,
    /// What is known of its desired speed.
    pub desired: DesiredSpeed,
    /// The times in which it could begin a change.
    pub spells: Vec<ObservedSpell>,
}

/// A time in which a driver could begin a change.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservedSpell {
    /// What it saw, in the order of time.
    pub sightings: Vec<Sighting>,
    /// When it ends [s].
    pub until: f64,
    /// The side of the change that begins at its end, or of the desire, where the begins of desires are known.
    pub change: Option<Side>,
}

/// What a driver saw at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sighting {
    /// The time in units of one second over the number of phases; since the driver's own turn, if that is known.
    pub tick: i64,
    /// The sides to which it could change, left and right.
    pub sides: [Option<SideSeen>; 2],
}

impl Observations {
    /// Adds those of another recording.
    pub fn extend(&mut self, other: Observations) {
        self.sites = self.sites.max(other.sites);
        self.phases = other.phases;
        self.recordings.extend(other.recordings);
        self.changes.extend(other.changes);
        self.veh_km += other.veh_km;
        self.veh_h += other.veh_h;
        self.drivers.extend(other.drivers);
    }

    /// Seconds in which a driver could change to at least one side.
    pub fn seconds(&self) -> usize {
        let sightings = self.drivers.iter().flat_map(|it| &it.spells).flat_map(|it| &it.sightings);
        sightings.filter(|it| it.sides.iter().any(Option::is_some)).count() / self.phases.max(1) as usize
    }

    /// The changes that are used.
    pub fn used(&self) -> impl Iterator<Item = &ObservedChange> {
        self.changes.iter().filter(|it| it.unused.is_none())
    }
}

/// Where a recording belongs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Number of its site.
    pub site: u32,
    /// Its own number.
    pub recording: u32,
}

/// Observes all drivers of the recording of `matched`, from `origin`.
///
/// # Errors
/// If the style's numbers make no sense for a driver.
pub fn observe(
    matched: &Matched<'_>,
    navigator: &Navigator,
    options: &Options,
    origin: Origin,
) -> Result<Observations, ReplayError> {
    let changes = lane_changes(matched);
    let shown = extents(matched, &changes);
    let (extents, lead) = begins(matched, &changes, shown.clone(), options.begin);
    let cooldown = cooldown(&changes, &extents, &options.style);
    let styles = [options.style.clone()];
    let by_speeds = |track| Assumed::by_its_speeds(matched, track, 0);
    let first = Replay::new(matched, &changes, navigator, &styles, by_speeds)?.without_destinations();
    let (estimated, desired_logs) = desired::desired_speeds(matched, &first);
    let desired = options.known.desired_speeds(matched, estimated);
    let by_posterior = |track: usize| Assumed { parameters: 0, speed_factor: desired[track].mean() };
    let replay = Replay::new(matched, &changes, navigator, &styles, by_posterior)?.without_destinations();
    let all = changes.iter().zip(extents.iter().zip(&shown));
    let mut observed: Vec<ObservedChange> =
        all.map(|(it, (used, shown))| ObservedChange::of(matched, it, [*used, *shown])).collect();
    let mut times = match &options.known.free {
        Some(free) => known::known_spells(matched, free),
        None => spells::spell_times(matched, &changes, &extents, cooldown),
    };
    changes::mark_unused(&mut observed, &times);
    let watch = Watch { matched, replay: &replay, options, origin, desired: &desired };
    let spells = watch.sightings(&times);
    let mut drivers: Vec<ObservedDriver> = Vec::new();
    for (spell, sightings) in times.drain(..).zip(spells) {
        watch.add(&mut drivers, &spell, sightings, &changes, &mut observed);
    }
    let (veh_km, veh_h) = exposure(matched);
    let (sites, phases, changes) = (origin.site + 1, options.phases, observed);
    let recordings = vec![ObservedRecording { lead, cooldown, desired_logs }];
    Ok(Observations { sites, phases, recordings, drivers, changes, veh_km, veh_h })
}

/// The begin and the end of each change, with its begin where the options have it; and the lead, if all have the same.
fn begins(
    matched: &Matched,
    changes: &[LaneChange],
    extents: Vec<Extent>,
    begin: Begin,
) -> (Vec<Extent>, Option<f64>) {
    /// Largest share of changes that had begun before their vehicles were first seen, so that begins are shown (ours).
    const MOST_BEGUN: f64 = 0.2;
    let both = changes.iter().zip(&extents);
    let begun = both.filter(|(change, it)| it.began < first_seen(matched, change) + changes::EDGE).count();
    let lead = match begin {
        Begin::Lead(lead) => lead,
        Begin::Auto if begun as f64 <= MOST_BEGUN * changes.len() as f64 => return (extents, None),
        Begin::Auto => USUAL_LEAD,
    };
    let around = |it: &LaneChange| Extent { began: it.time - lead, ended: it.time + lead };
    (changes.iter().map(around).collect(), Some(lead))
}

/// When the vehicle of a change was first seen [s].
fn first_seen(matched: &Matched, change: &LaneChange) -> f64 {
    let first = matched.recording.tracks[change.track].states.first();
    first.map_or(f64::INFINITY, |it| it.frame as f64 * matched.recording.step)
}

/// Time after a change in which drivers make no other one [s]: that of the style, or less where the recording shows
/// that they do.
fn cooldown(changes: &[LaneChange], extents: &[Extent], style: &Style) -> f64 {
    /// Share of the times between two changes that may be shorter (ours).
    const SHORTER: f64 = 0.1;
    let pairs = changes.windows(2).zip(extents.windows(2)).filter(|(it, _)| it[0].track == it[1].track);
    let mut times: Vec<f64> = pairs.map(|(_, it)| (it[1].began - it[0].ended).max(0.0)).collect();
    times.sort_by(f64::total_cmp);
    let shortest = times.get((SHORTER * times.len() as f64) as usize);
    shortest.map_or(style.manner.calm, |it| it.min(style.manner.calm))
}

/// Distance driven [veh·km], and time [veh·h].
fn exposure(matched: &Matched) -> (f64, f64) {
    let step = matched.recording.step;
    let tracks = matched.recording.tracks.iter().zip(&matched.places);
    let seen = tracks.flat_map(|(track, places)| track.states.iter().zip(places)).filter(|it| it.1.is_some());
    let (metres, count) = seen.fold((0.0, 0_usize), |(m, n), (state, _)| (m + state.speed * step, n + 1));
    (metres / 1000.0, count as f64 * step / 3600.0)
}

/// A look that a driver takes at its lanes, in the order of frames.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Look {
    frame: i64,
    /// The number of its spell.
    spell: usize,
    /// The tick, since the turn of its driver.
    tick: i64,
}

/// A recording being observed.
struct Watch<'a> {
    matched: &'a Matched<'a>,
    replay: &'a Replay<'a>,
    options: &'a Options,
    origin: Origin,
    desired: &'a [DesiredSpeed],
}

impl Watch<'_> {
    /// When the driver of a track decides: the time since the last whole second [s].
    fn turn(&self, track: usize) -> f64 {
        self.options.known.turn(self.matched.recording.tracks[track].id)
    }

    fn tick_of(&self, time: f64) -> i64 {
        (time * f64::from(self.options.phases) - 1e-9).ceil() as i64
    }

    /// The frame of a tick of a driver with this `turn` [s].
    fn frame_of(&self, tick: i64, turn: f64) -> i64 {
        ((tick as f64 / f64::from(self.options.phases) + turn) / self.matched.recording.step).round() as i64
    }

    /// What the drivers of all spells saw.
    fn sightings(&self, times: &[SpellTimes]) -> Vec<Vec<Sighting>> {
        let mut looks: Vec<Look> = Vec::new();
        for (spell, number) in times.iter().zip(0..) {
            let turn = self.turn(spell.track);
            let ticks = self.tick_of(spell.from - turn)..self.tick_of(spell.until - turn);
            looks.extend(ticks.map(|tick| Look { frame: self.frame_of(tick, turn), spell: number, tick }));
        }
        looks.sort_unstable();
        let together: Vec<&[Look]> = looks.chunk_by(|a, b| a.frame == b.frame).collect();
        let seen: Vec<Vec<(usize, Sighting)>> =
            together.par_iter().map(|it| self.at_frame(it, times)).collect();
        let mut sightings = vec![Vec::new(); times.len()];
        for (number, sighting) in seen.into_iter().flatten() {
            sightings[number].push(sighting);
        }
        sightings
    }

    /// What drivers saw in one frame.
    fn at_frame(&self, looks: &[Look], times: &[SpellTimes]) -> Vec<(usize, Sighting)> {
        let mut frame = self.replay.frame(looks[0].frame);
        let of = |&Look { spell, tick, .. }: &Look| {
            (spell, Sighting { tick, sides: self.sides(&mut frame, times[spell].track) })
        };
        looks.iter().map(of).collect()
    }

    /// What the driver of a track sees on both sides, for each of its possible desired speeds.
    fn sides(&self, frame: &mut Frame<'_>, track: usize) -> [Option<SideSeen>; 2] {
        let vehicle = self.matched.recording.tracks[track].id;
        let LaneChangeModel::Mcdm(model) = &self.options.style.change else { return [None, None] };
        let route = if model.speed.weight > 0.0 { model.route.weight / model.speed.weight } else { 0.0 };
        let model = side::unit_weights(model);
        Side::BOTH.map(|side| self.side(frame, (track, vehicle), side, (&model, route)))
    }

    fn side(
        &self,
        frame: &mut Frame<'_>,
        (track, vehicle): (usize, i64),
        side: Side,
        (model, route): (&Mcdm, f64),
    ) -> Option<SideSeen> {
        let place = Place::of(self.matched.network, frame, vehicle, side, self.origin.site)?;
        let mut seen = SideSeen::of(&frame.perceive(vehicle, side)?, (&self.options.style, model), place);
        let desired = &self.desired[track];
        for (node, (factor, _)) in desired.nodes.iter().enumerate() {
            frame.suppose(vehicle, *factor);
            let by_desired = ByDesired::of(&frame.perceive(vehicle, side)?, model, route);
            seen.by_desired[node..].fill(by_desired);
        }
        frame.suppose(vehicle, desired.mean());
        Some(seen)
    }

    /// Adds a spell to its driver.
    fn add(
        &self,
        drivers: &mut Vec<ObservedDriver>,
        times: &SpellTimes,
        sightings: Vec<Sighting>,
        changes: &[LaneChange],
        observed: &mut [ObservedChange],
    ) {
        let track = &self.matched.recording.tracks[times.track];
        let side = match times.end {
            End::Sight => None,
            End::Change(number) => observed[number].unused.is_none().then(|| changes[number].side),
            End::Desire(side) => Some(side),
        };
        let last = || sightings.iter().rev().take(self.options.phases as usize);
        let is_permitted = |it: &Side| last().count() > 0 && last().all(|seen| seen.sides[it.at()].is_some());
        let change = side.filter(is_permitted);
        if let (End::Change(number), Some(_), None) = (times.end, side, change) {
            observed[number].unused = Some(Unused::NotPermitted);
        }
        let Origin { site, recording } = self.origin;
        let is_it = |it: &ObservedDriver| it.vehicle == track.id;
        if !drivers.last().is_some_and(is_it) {
            let first = track.states.first().map_or(0, |it| it.frame);
            drivers.push(ObservedDriver {
                site,
                recording,
                vehicle: track.id,
                first_seen: first as f64 * self.matched.recording.step,
                desired: self.desired[times.track].clone(),
                spells: Vec::new(),
            });
        }
        if let Some(driver) = drivers.last_mut() {
            driver.spells.push(ObservedSpell { sightings, until: times.until, change });
        }
    }
}
