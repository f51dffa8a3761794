//! From a scenario to a world that can run: everything is checked before anything is written.

use std::num::NonZero;
use std::sync::Arc;
use std::thread::available_parallelism;

use laneweave_maps::{Graph, Map, Size, regulations};
use laneweave_models::Style;
use laneweave_network::{LaneletIndex, Network};
use laneweave_sim::{Places, Setup, World, WorldError};

use super::conditions::Conditions;
use super::demand::{Amount, check_ways, demand};
use super::made_signals::MadeLights;
use super::map::read_map;
use super::scheduled::{Scheduled, classes};
use super::settling::{Settled, Settling, estimate, origins};
use super::signals::plans;
use super::turns::check_arrivals;
use super::{Origin, Scenario, SumoFile};
use crate::capacity::{Estimate, Queues};
use crate::fault::Fault;
use crate::late_trips::on_late_trips_of;
use crate::remarks::{remarks, unused_lanes};
use crate::replay::{Player, Recorded};
use crate::script::Script;
use crate::style::Population;

/// Maximum of threads.
const MOST_THREADS: usize = 256;
/// Default number of threads at most: that of a small machine.
const USUAL_THREADS: usize = 2;
/// Minimum and maximum of the step [s].
const STEPS: (f64, f64) = (0.01, 1.0);
/// Up to this step delays and rates of lane changes differ by at most 15 % from those at 0.1 s on most maps [s]
/// (measured).
const SAFE_STEP: f64 = 0.5;
/// Minimum interval of guidance [s].
const SHORTEST_GUIDANCE: f64 = 1.0;
/// Maximum simulated time [s].
pub(crate) const LONGEST: f64 = 1e7;
/// The names of the intervals of the output.
const RECORDING: &str = "a recording interval";
const FLOWS: &str = "an interval of flows";
const CHECKPOINTS: &str = "an interval of checkpoints";

/// A scenario that is ready to run.
pub struct Prepared {
    /// The world at its start. [`Prepared::step`] simulates it with the commands of the scenario.
    pub world: World,
    /// The commands that the scenario gives.
    pub script: Script,
    /// What is fixed before the run.
    pub conditions: Arc<Conditions>,
    /// Number of threads.
    pub threads: usize,
}

/// Reads the map and the styles of `scenario`, and makes its world.
///
/// # Errors
/// If something is missing, not readable, or invalid.
pub fn prepare(scenario: &Scenario, origin: &Origin) -> Result<Prepared, Fault> {
    prepare_with(scenario, origin, Playing::AsAsked, || read_map(scenario, origin))
}

/// The same as [`prepare`], with the recording that `player` plays in place of the one that the scenario names.
///
/// # Errors
/// If something is missing, not readable, or invalid.
pub fn prepare_playing(scenario: &Scenario, origin: &Origin, player: Player) -> Result<Prepared, Fault> {
    prepare_with(scenario, origin, Playing::Again(player), || read_map(scenario, origin))
}

/// The same as [`prepare`], with a recording in memory in place of the one that the scenario names.
///
/// # Errors
/// If something is missing, not readable, or invalid.
pub fn prepare_recorded(scenario: &Scenario, origin: &Origin, recorded: Recorded) -> Result<Prepared, Fault> {
    prepare_with(scenario, origin, Playing::Recorded(recorded), || read_map(scenario, origin))
}

/// What is played in a world.
enum Playing {
    /// The recording that the scenario names, if it names one.
    AsAsked,
    /// What was played before.
    Again(Player),
    /// A recording in memory.
    Recorded(Recorded),
}

impl Playing {
    /// The same network, on which drivers may change where those of the recording did.
    fn permit(&self, network: Network) -> Network {
        match self {
            Playing::AsAsked => network,
            Playing::Again(player) => network.permitting(player.permitted()),
            Playing::Recorded(recorded) => network.permitting(&recorded.permitted),
        }
    }

    /// Who plays it in a `world` at its start, whose (0, 0) is at the latitude and longitude `zero` [°].
    fn player(
        self,
        scenario: &Scenario,
        origin: &Origin,
        zero: Option<(f64, f64)>,
        world: &World,
    ) -> Result<Option<Player>, Fault> {
        match self {
            Playing::AsAsked => Player::of(scenario, origin, zero, world),
            Playing::Again(player) => Ok(Some(player)),
            Playing::Recorded(recorded) => Player::of_recorded(recorded, scenario, origin, world),
        }
    }
}

/// Makes the world of `scenario` on a `map` that was read or generated before. The path and the options of the map in
/// the scenario have no effect.
///
/// # Errors
/// If something is missing, not readable, or invalid.
pub fn prepare_on(map: Map, scenario: &Scenario, origin: &Origin) -> Result<Prepared, Fault> {
    prepare_with(scenario, origin, Playing::AsAsked, || Ok(map))
}

fn prepare_with(
    scenario: &Scenario,
    origin: &Origin,
    playing: Playing,
    map: impl FnOnce() -> Result<Map, Fault>,
) -> Result<Prepared, Fault> {
    check_numbers(scenario, origin)?;
    let [record_steps, flows_steps, checkpoint_steps] = intervals(scenario, origin)?;
    let threads = threads(scenario, origin, record_steps.is_some())?;
    let scheduled = Scheduled::of(scenario, origin)?;
    let mut mixture = scheduled.mixture(origin)?;
    let Population { driver_parameters, shares } =
        Population::draw(&mixture, scenario.run.seed_of_drivers())?;
    let driver_parameters = driving(scenario, driver_parameters);
    let map = map()?;
    let (network, places) = if scenario.map_options.joins_ends { joined(&map) } else { driven(&map) };
    let (network, mut problems) = (playing.permit(network), map.problems.clone());
    // A user cannot correct the built-in map.
    let remarks = || remarks(&map, &network, &places, &driver_parameters);
    let mut remarks = origin.map.map_or_else(remarks, |_| Vec::new());
    let schedule = scheduled.schedule(&network, &mut mixture, &mut problems)?;
    remarks.extend(unused_lanes(&network, classes(scenario, schedule.as_ref())));
    let plans = plans(scenario, origin, &network)?;
    let made = MadeLights::of(scenario, &plans, &network);
    let network = Arc::new(network.with_signals(&plans));
    check_places(scenario, &places, schedule.is_some())?;
    let build = |network: &Arc<Network>, amount: (Option<&Amount>, &[usize])| {
        let demand = match &schedule {
            Some(schedule) => schedule.demand(scenario.demand.fleet(), shares.clone()),
            None => demand(scenario, origin, network, places.clone(), shares.clone(), amount)?,
        };
        let setup = Setup { step: scenario.run.step_s, seed: scenario.run.seed, threads };
        World::new(Arc::clone(network), driver_parameters.clone(), demand, setup)
            .map_err(|error| unbuilt(scenario, origin, &error))
    };
    let measured = [0.0, scenario.run.duration_s].map(|it| scenario.run.warmup_s + it);
    let queues = Queues::new(&Population::by_speed(&mixture), scenario.demand.fleet(), network.law);
    let settling = Settling { scenario, measured, queues: &queues, made: &made };
    let Settled { world, basis, capacity } = settling.settle(&network, build)?;
    remarks.extend(on_late_trips_of(&world).into_iter().flatten());
    let origins = origins(&world, measured);
    let steps = |duration: f64| (duration / scenario.run.step_s).round() as u32;
    let warmup_steps = steps(scenario.run.warmup_s);
    let world = equipped(world, warmup_steps, scenario, origin)?;
    let estimated = || estimate(&world, measured, queues, made);
    let capacity = capacity.map_or_else(estimated, |known| Estimate::new(Box::new(move || known)));
    if schedule.is_none() {
        check_ways(scenario, origin, &world)?;
        check_arrivals(scenario, origin, &world)?;
    }
    let player = playing.player(scenario, origin, map.origin, &world)?;
    let script = Script::of(scenario, origin, &map.contents.obstacles, player, &world)?;
    let conditions = Conditions {
        warmup_steps,
        steps: steps(scenario.run.duration_s).max(1),
        record_steps,
        checkpoint_steps,
        flows_steps,
        demand_veh_h: origins.iter().map(|(_, rate)| rate).sum(),
        basis,
        origins,
        capacity,
        styles: mixture.iter().map(|(it, weight)| (it.typical().name.clone(), *weight)).collect(),
        mixture,
        problems,
        remarks,
        origin: map.origin,
    };
    Ok(Prepared { world, script, conditions: Arc::new(conditions), threads })
}

/// The sets of driver parameters of a world of `scenario`: those of its population, and further ones beside a
/// recording.
pub fn driving(scenario: &Scenario, driver_parameters: Vec<Style>) -> Vec<Style> {
    if scenario.replay.is_asked() {
        Population::with_other_speeds(driver_parameters)
    } else {
        driver_parameters
    }
}

impl Prepared {
    /// A warning for the screen if the step is so long that it changes the traffic, in a line.
    pub fn step_warning(&self) -> Option<String> {
        let step = self.world.clock().dt;
        (step > SAFE_STEP).then(|| {
            format!(
                "run.step_s = {step}: above {SAFE_STEP} s drivers need larger gaps, so delays grow by a third or more, \
                 and there are fewer lane changes; set {SAFE_STEP} or less"
            )
        })
    }
}

/// The intervals of samples, of flows and of checkpoints, in steps.
fn intervals(scenario: &Scenario, origin: &Origin) -> Result<[Option<u32>; 3], Fault> {
    let in_steps = |key, what, interval| whole_steps(scenario.run.step_s, origin, key, what, interval);
    let record_steps = in_steps("record_s", RECORDING, scenario.output.record_s)?;
    let flows_steps = in_steps("flows_s", FLOWS, scenario.output.flows_s)?;
    check_samples(scenario, origin, record_steps)?;
    Ok([record_steps, flows_steps, in_steps("checkpoint_s", CHECKPOINTS, scenario.output.checkpoint_s)?])
}

/// Checks that trips can start somewhere: at these places, or where others are.
fn check_places(scenario: &Scenario, places: &Places, has_others: bool) -> Result<(), Fault> {
    if places.origins.is_empty() && !has_others {
        let what = "no vehicle can drive on the map: no lanelet of 10 m or more begins at its edge, and from no lanelet of 20 m or \
                    more outside conflict areas can another be reached";
        return Err(Fault::new(scenario.map.display(), what, "choose a map with longer lanelets"));
    }
    Ok(())
}

/// The world with its trip log, its warm-up, its audit and the guidance of `scenario`.
pub(super) fn equipped(
    world: World,
    warmup_steps: u32,
    scenario: &Scenario,
    origin: &Origin,
) -> Result<World, Fault> {
    let world = world.with_trip_log().warming_up(warmup_steps);
    let world = if scenario.run.audit { world.audited() } else { world };
    match scenario.guidance.interval_s {
        0.0 => Ok(world),
        interval => world.guided(interval).map_err(|error| {
            let place = origin.place(&["guidance", "interval_s"]);
            Fault::new(place, error, "set guidance.interval_s = 0, or choose fewer destinations")
        }),
    }
}

/// The roads of `map` with their junctions, and where trips on them start and end.
pub fn driven(map: &Map) -> (Network, Places) {
    with_places(map, map.network.clone())
}

/// The same of a map on which lanelets that meet at their ends continue one another.
fn joined(map: &Map) -> (Network, Places) {
    // A network that was sound is so with more joints.
    with_places(map, map.network.clone().joined().unwrap_or_else(|_| map.network.clone()))
}

fn with_places(map: &Map, network: Network) -> (Network, Places) {
    let network = network.regulated(&regulations(map));
    let places = places(&network, &map.graph);
    (network, places)
}

/// Trip ends: the entrances and exits, or, on a map without one of them, every lane outside of junctions.
fn places(network: &Network, graph: &Graph) -> Places {
    if !network.entrances.is_empty() && !network.exits.is_empty() {
        return Places::at_gates(network).reachable(network);
    }
    let all = graph.conflicting.iter().zip(0..);
    Places::along(network, all.filter(|(others, _)| others.is_empty()).map(|(_, it)| LaneletIndex(it)))
}

/// Checks that there are samples if a file needs them.
fn check_samples(scenario: &Scenario, origin: &Origin, record_steps: Option<u32>) -> Result<(), Fault> {
    if record_steps.is_none() && scenario.output.sumo.contains(&SumoFile::Fcd) {
        let what = "fcd.xml is sampled at output.record_s, which is 0";
        return Err(Fault::new(origin.place(&["output", "sumo"]), what, "remove fcd, or set record_s = 1"));
    }
    Ok(())
}

fn check_numbers(scenario: &Scenario, origin: &Origin) -> Result<(), Fault> {
    let Scenario { demand, run, output, .. } = scenario;
    let check = |path: &[&str], what: &str, value: f64, (from, to): (f64, f64), unit: &str| {
        if (from..=to).contains(&value) {
            return Ok(());
        }
        let what = format!("{what} of {value}{unit}");
        Err(Fault::new(origin.place(path), what, format!("choose {from} to {to}{unit}")))
    };
    check(&["run", "step_s"], "a step", run.step_s, STEPS, " s")?;
    check(&["run", "duration_s"], "a duration", run.duration_s, (run.step_s, LONGEST), " s")?;
    check(&["run", "warmup_s"], "a warm-up", run.warmup_s, (0.0, LONGEST), " s")?;
    let shares = [
        ("trucks", "a share of trucks", demand.trucks),
        ("buses", "a share of buses", demand.buses),
        ("motorcycles", "a share of motorcycles", demand.motorcycles),
        ("taxis", "a share of taxis", demand.taxis),
        ("emergency", "a share of emergency vehicles", demand.emergency),
    ];
    let mut room = 1.0;
    for (key, what, share) in shares {
        check(&["demand", key], what, share, (0.0, room), "")?;
        room -= share;
    }
    if let Some(size) = scenario.map_options.max_size_mb {
        let largest = Size::MAXIMUM.mb();
        check(&["map_options", "max_size_mb"], "a largest map", size, (f64::MIN_POSITIVE, largest), " MB")?;
    }
    let guidance = scenario.guidance.interval_s;
    if guidance != 0.0 {
        let path = ["guidance", "interval_s"];
        check(&path, "an interval of guidance", guidance, (SHORTEST_GUIDANCE, LONGEST), " s")?;
    }
    check(&["output", "record_s"], RECORDING, output.record_s, (0.0, LONGEST), " s")?;
    check(&["output", "checkpoint_s"], CHECKPOINTS, output.checkpoint_s, (0.0, LONGEST), " s")?;
    check(&["output", "flows_s"], FLOWS, output.flows_s, (0.0, LONGEST), " s")
}

/// The interval [s] of the output with this `key` and the name `what`, in steps; `None` for an interval of 0.
fn whole_steps(
    step: f64,
    origin: &Origin,
    key: &str,
    what: &str,
    interval: f64,
) -> Result<Option<u32>, Fault> {
    /// Tolerance of an interval around a whole number of steps, in steps.
    const TOLERANCE: f64 = 1e-6;
    let steps = interval / step;
    if interval > 0.0 && steps < 1.0 - TOLERANCE {
        let what = format!("{what} of {interval} s is shorter than a step of {step} s");
        let remedy = format!("choose {step} s or a multiple of it, 0 to switch it off, or a shorter step");
        return Err(Fault::new(origin.place(&["output", key]), what, remedy));
    }
    if (steps - steps.round()).abs() <= TOLERANCE {
        return Ok(Some(steps.round() as u32).filter(|steps| *steps > 0));
    }
    // Rounded: otherwise 3 × 0.1 would be shown with all its digits.
    let above = (steps.ceil() * step * 1e6).round() / 1e6;
    let what = format!("{what} of {interval} s is not a multiple of the step of {step} s");
    let remedy = format!("choose a multiple of it, such as {above} s");
    Err(Fault::new(origin.place(&["output", key]), what, remedy))
}

fn threads(scenario: &Scenario, origin: &Origin, records: bool) -> Result<usize, Fault> {
    let usual = || {
        let cores = available_parallelism().map_or(1, NonZero::get);
        // The writer of trajectories needs a core of its own: a thread of the simulation would wait for it.
        let free = cores - usize::from(records);
        free.clamp(1, USUAL_THREADS)
    };
    let threads = scenario.run.threads.map_or_else(usual, |it| it.get());
    if threads > MOST_THREADS {
        let place = origin.place(&["run", "threads"]);
        return Err(Fault::new(place, format!("{threads} threads"), format!("choose 1 to {MOST_THREADS}")));
    }
    Ok(threads)
}

/// Why there is no world.
pub(super) fn unbuilt(scenario: &Scenario, origin: &Origin, error: &WorldError) -> Fault {
    match error {
        WorldError::Threads { .. } => {
            let remedy = "choose fewer, or close other programs";
            Fault::new(origin.place(&["run", "threads"]), error, remedy)
        }
        _ => Fault::new(scenario.map.display(), error, "correct it"),
    }
}
