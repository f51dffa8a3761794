//! One driver: its whole trip line by line, or one moment of it.

use std::fmt::Write;

use laneweave_network::{Network, Position};
use laneweave_sim::{Account, Act, Event, Spot, VehicleId, World};
use laneweave_study::units::KMH_PER_MPS;

use crate::Simulation;

use super::flip::flips;
use super::standing::why_it_stands;
use super::words::{act, flip_in_words, story};

/// The explanation of a driver at a moment, if it was on the road.
#[derive(Clone, Debug, PartialEq)]
pub enum Moment {
    /// Its account, in words.
    Told(String),
    /// It was on the road at other times only [s].
    At(f64, f64),
    /// It never entered.
    Never,
}

/// Slower than this a vehicle stands [m/s].
const STANDS: f64 = 0.1;
/// A standstill is reported after this time [s]. Ours.
const TOLD_AFTER: f64 = 10.0;

/// The position of vehicle `id`'s main entry, if it is on the road.
fn spot_of(world: &World, id: VehicleId) -> Option<Spot> {
    world.vehicle(id).filter(|it| it.is_in_lane()).map(|it| it.spot)
}

/// The account of the driver of `id` when it last considered lanes, or waited for a gap, at or before `time` [s]. The
/// `simulation` is run up to there, but at most `steps` steps. `with_flips`: including the flips of its decision.
pub fn moment(simulation: &mut Simulation, id: VehicleId, time: f64, steps: u32, with_flips: bool) -> Moment {
    /// Maximum time between two considerations of lanes [s].
    const LONGEST_EPOCH: f64 = 60.0;
    let (mut told, mut seen) = (None, None);
    for _ in 0..steps {
        let world = simulation.world();
        let now = world.clock().time();
        if let Some(spot) = spot_of(world, id) {
            let (first, _) = seen.unwrap_or((now, now));
            seen = Some((first, now));
            if now > time - LONGEST_EPOCH && now <= time + 0.5 * world.clock().dt {
                let account = laneweave_sim::explain(world, spot);
                if account.act != Act::DrivesOn || told.is_none() {
                    told = Some(full(world, &account, with_flips));
                }
            }
        } else if let Some((from, until)) = seen {
            return told.filter(|_| time <= until).map_or(Moment::At(from, until), Moment::Told);
        }
        if now >= time && seen.is_some_and(|(from, _)| from <= time) {
            break;
        }
        simulation.advance();
    }
    match (told, seen) {
        (Some(told), Some((from, _))) if from <= time => Moment::Told(told),
        (_, Some((from, until))) => Moment::At(from, until),
        _ => Moment::Never,
    }
}

/// What the driver of `id` makes of its lanes now, and is about to do. `None` if it is in no lane.
pub(crate) fn now(world: &World, id: VehicleId) -> Option<String> {
    let spot = spot_of(world, id)?;
    Some(full(world, &laneweave_sim::explain(world, spot), false))
}

fn full(world: &World, account: &Account, with_flips: bool) -> String {
    let scene = world.scene();
    let motion = scene.motion(account.spot);
    let found = if with_flips { flips(account, world.clock().dt) } else { Vec::new() };
    let mut told = story(account, world.network(), (motion.x, motion.speed), &found);
    if motion.speed < STANDS {
        // Writing to a string never fails.
        let _ = writeln!(told, "  {}", why_it_stands(world, account.spot));
    }
    told
}

/// The trip of the driver of `id`, line by line: its actions with their times and reasons. `None` if it did not enter
/// within `steps` steps, which are simulated.
pub fn trip(simulation: &mut Simulation, id: VehicleId, steps: u32, with_flips: bool) -> Option<String> {
    let mut lines = Lines::default();
    let told_after = simulation.world().clock().steps(TOLD_AFTER);
    let mut stood = 0;
    for _ in 0..steps {
        let world = simulation.world();
        let now = world.clock().time();
        match spot_of(world, id) {
            Some(spot) => {
                let account = laneweave_sim::explain(world, spot);
                if lines.text.is_empty() {
                    lines.single(now, &format!("enters {}", place(world.network(), spot, world)));
                }
                lines.take(now, &account, with_flips, world.clock().dt);
                stood = if world.scene().motion(spot).speed < STANDS { stood + 1 } else { 0 };
                if stood == told_after {
                    let why = why_it_stands(world, spot);
                    lines.single(now, &format!("has stood for {TOLD_AFTER} s: {why}"));
                }
            }
            None if !lines.text.is_empty() => break,
            None => {}
        }
        simulation.advance();
        let world = simulation.world();
        for event in world.events() {
            match event {
                Event::LaneChange(change) if change.vehicle == id => {
                    let lanelet = |at: Position| world.network().lanelet_at(at).0.id;
                    let line = if change.is_completed {
                        let [from, to] = [change.from, change.to].map(lanelet);
                        format!(
                            "has completed the change; crossed from lanelet {from} to {to} at {:.1} s",
                            change.time
                        )
                    } else {
                        "is back in its lane".into()
                    };
                    lines.single(world.clock().time(), &line);
                }
                Event::Left { vehicle, duration, .. } if *vehicle == id => {
                    lines.single(world.clock().time(), &format!("completes its trip after {duration:.1} s"));
                }
                _ => {}
            }
        }
    }
    lines.end();
    (!lines.text.is_empty()).then_some(lines.text)
}

fn place(network: &Network, spot: Spot, world: &World) -> String {
    let scene = world.scene();
    let motion = scene.motion(spot);
    let (lanelet, along) = network.lanelet_at(Position::new(spot.chain, motion.x));
    format!("on lanelet {}, {along:.1} m, at {:.1} km/h", lanelet.id, motion.speed * KMH_PER_MPS)
}

/// Lines; successive ones of the same kind become one.
#[derive(Default)]
struct Lines {
    text: String,
    /// The present line: its kind, begin and end, number of moments, last text.
    open: Option<(std::mem::Discriminant<Act>, f64, f64, u32, String)>,
}

impl Lines {
    fn take(&mut self, now: f64, account: &Account, with_flips: bool, dt: f64) {
        if matches!(account.act, Act::DrivesOn | Act::Changes(_)) {
            return;
        }
        let kind = std::mem::discriminant(&account.act);
        let mut said = act(account);
        if let Some(flip) = flips(account, dt).first().filter(|_| with_flips) {
            let _ = write!(said, "\n{:>22}would have changed it: {}", "", flip_in_words(account, flip));
        }
        match &mut self.open {
            Some((open, _, until, count, last)) if *open == kind => {
                (*until, *last) = (now, said);
                *count += 1;
            }
            _ => {
                self.end();
                self.open = Some((kind, now, now, 1, said));
            }
        }
    }

    fn single(&mut self, now: f64, line: &str) {
        self.end();
        // Writing to a string never fails.
        let _ = writeln!(self.text, "{now:>8.1} s          {line}");
    }

    fn end(&mut self) {
        if let Some((_, from, until, count, said)) = self.open.take() {
            let last = if count > 1 { "most recently: " } else { "" };
            let _ = if from == until {
                writeln!(self.text, "{from:>8.1} s          {said}")
            } else {
                writeln!(self.text, "{from:>8.1}–{until:<8.1}s {last}{said}")
            };
        }
    }
}
