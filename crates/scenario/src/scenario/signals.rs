//! Signal programs in a scenario.

use laneweave_network::{Extension, Id, LightConflict, LightIndex, Network, Position, SignalPlan, Turn};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::WrittenId;
use super::{Origin, Scenario};
use crate::fault::Fault;

/// Kind of the generated signal programs, for traffic lights without a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum MadeSignals {
    /// Fixed-time: cycle and greens by Webster (1958), for the demand.
    #[default]
    Fixed,
    /// Actuated: greens of 5 to 40 s that traffic extends.
    Actuated,
}

/// A signal program for traffic lights whose movements conflict: its phases, one after the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Signal {
    /// Offset: when the first phase begins [s].
    #[serde(default)]
    pub offset_s: f64,
    /// Cycle length [s]; optional, checked against the sum of all phases.
    pub cycle_s: Option<f64>,
    /// The phases in order.
    pub phases: Vec<SignalPhase>,
}

/// A phase: some traffic lights are green, then yellow, and then all are red.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SignalPhase {
    /// Ids of the traffic lights that are green; a light that is also green in the next phase stays green in between.
    #[schemars(with = "Vec<WrittenId>")]
    pub green: Vec<Id>,
    /// Green time [s], for a phase of fixed length.
    pub green_s: Option<f64>,
    /// Maximum green [s], if traffic extends the phase: counted from the first call for another phase.
    pub max_green_s: Option<f64>,
    /// Minimum green [s], if traffic extends the phase; default 5.
    pub min_green_s: Option<f64>,
    /// Gap time [s]: a green that traffic extends ends when no vehicle has arrived for so long; default 2.
    pub gap_s: Option<f64>,
    /// Yellow time after the green [s].
    #[serde(default = "usual_yellow")]
    pub yellow_s: f64,
    /// All-red time after the yellow [s].
    #[serde(default = "usual_all_red")]
    pub all_red_s: f64,
}

/// That of generated programs [s].
fn usual_yellow() -> f64 {
    3.0
}

/// The minimum of generated programs [s].
fn usual_all_red() -> f64 {
    2.0
}

/// Maximum of lights in the list of known ones.
const LISTED: usize = 8;
/// Maximum length of a part of a phase [s].
const LONGEST: f64 = 3600.0;

/// The signal plans that `scenario` gives to lights of `network`.
///
/// # Errors
/// If a light does not exist, a number is invalid, or lights whose movements conflict are green together.
pub(super) fn plans(
    scenario: &Scenario,
    origin: &Origin,
    network: &Network,
) -> Result<Vec<SignalPlan>, Fault> {
    let conflicts = if scenario.signals.is_empty() { Vec::new() } else { network.light_conflicts() };
    let mut plans: Vec<SignalPlan> = Vec::new();
    for (signal, number) in scenario.signals.iter().zip(0..) {
        let place = Place { origin, number };
        let plan = plan(signal, &place, network)?;
        let is_taken = |light: &LightIndex| plans.iter().any(|it| it.lights().any(|other| other == *light));
        if let Some(twice) = plan.lights().find(is_taken) {
            let what = format!("the traffic light {} already has a program", name(network, twice));
            return Err(Fault::new(place.of(&["phases"]), what, "use it in one program only"));
        }
        check_conflicts(&plan, &place, network, &conflicts)?;
        plans.push(plan);
    }
    Ok(plans)
}

/// The place of a program in its scenario.
struct Place<'a> {
    origin: &'a Origin,
    number: usize,
}

impl Place<'_> {
    fn of(&self, path: &[&str]) -> String {
        let number = self.number.to_string();
        self.origin.place(&[&["signals", &number], path].concat())
    }

    fn in_phase(&self, phase: usize, key: &str) -> String {
        self.of(&["phases", &phase.to_string(), key])
    }
}

fn plan(signal: &Signal, place: &Place, network: &Network) -> Result<SignalPlan, Fault> {
    if signal.phases.is_empty() {
        return Err(Fault::new(place.of(&["phases"]), "a program without phases", "give it one or more"));
    }
    if !signal.offset_s.is_finite() {
        let what = format!("an offset of {} s", signal.offset_s);
        return Err(Fault::new(place.of(&["offset_s"]), what, "choose a finite one"));
    }
    let mut turns = Vec::new();
    for (phase, number) in signal.phases.iter().zip(0..) {
        let SignalPhase { yellow_s: yellow, all_red_s: all_red, .. } = *phase;
        let place_of = |key: &str| place.in_phase(number, key);
        let (green, extension) = green(phase, place_of)?;
        check(place_of("yellow_s"), "a yellow time", yellow, Least::Above(0.0), LONGEST)?;
        check(place_of("all_red_s"), "an all-red time", all_red, Least::From(0.0), LONGEST)?;
        let lights = phase.green.iter().map(|id| light(network, *id, place_of("green")));
        turns.push(Turn { lights: lights.collect::<Result<_, _>>()?, green, extension, yellow, all_red });
    }
    let plan = SignalPlan { offset: signal.offset_s, turns };
    if plan.is_actuated() && signal.offset_s != 0.0 {
        let what = "an offset of an actuated program";
        return Err(Fault::new(place.of(&["offset_s"]), what, "leave it out"));
    }
    match signal.cycle_s {
        // A difference of a millisecond is no mistake.
        Some(cycle) if cycle.is_nan() || (cycle - plan.cycle()).abs() > 1e-3 => {
            let what = format!("a cycle of {cycle} s, but its phases last {} s", plan.cycle());
            Err(Fault::new(place.of(&["cycle_s"]), what, "remove it, or change a phase"))
        }
        _ => Ok(plan),
    }
}

/// The smallest allowed value of a number.
#[derive(Clone, Copy)]
enum Least {
    From(f64),
    Above(f64),
}

fn check(place: String, what: &str, value: f64, least: Least, most: f64) -> Result<(), Fault> {
    let (is_enough, least) = match least {
        Least::From(least) => (value >= least, least.to_string()),
        Least::Above(least) => (value > least, format!("more than {least}")),
    };
    if is_enough && value <= most {
        return Ok(());
    }
    Err(Fault::new(place, format!("{what} of {value} s"), format!("choose {least} to {most} s")))
}

/// The green of a phase, the maximum if traffic extends it, and how traffic extends it.
fn green(phase: &SignalPhase, place: impl Fn(&str) -> String) -> Result<(f64, Option<Extension>), Fault> {
    let SignalPhase { green_s, max_green_s, min_green_s, gap_s, .. } = *phase;
    match (green_s, max_green_s) {
        (Some(green), None) if min_green_s.is_none() && gap_s.is_none() => {
            check(place("green_s"), "a green time", green, Least::Above(0.0), LONGEST)?;
            Ok((green, None))
        }
        (None, Some(most)) => {
            check(place("max_green_s"), "a maximum green", most, Least::Above(0.0), LONGEST)?;
            let usual = Extension::default();
            let least = min_green_s.unwrap_or(usual.least.min(most));
            check(place("min_green_s"), "a minimum green", least, Least::Above(0.0), most)?;
            let gap = gap_s.unwrap_or(usual.gap);
            check(place("gap_s"), "a gap time", gap, Least::From(0.0), LONGEST)?;
            Ok((most, Some(Extension { least, gap })))
        }
        (Some(_), _) => {
            let what = "both a fixed and an actuated green";
            Err(Fault::new(
                place("green_s"),
                what,
                "remove green_s, or remove min_green_s, max_green_s and gap_s",
            ))
        }
        (None, None) => {
            let remedy = "give green_s, or max_green_s if traffic extends it";
            Err(Fault::new(place("green"), "a phase without a green time", remedy))
        }
    }
}

/// The light with this id.
fn light(network: &Network, id: Id, place: String) -> Result<LightIndex, Fault> {
    let lights = &network.junctions.lights;
    let index = lights.iter().position(|it| it.id == id);
    index.map(|it| LightIndex(it as u32)).ok_or_else(|| {
        let mut known: Vec<Id> = lights.iter().map(|it| it.id).collect();
        known.sort_unstable();
        let first = known.partition_point(|it| *it < id).saturating_sub(LISTED / 2);
        let first = first.min(known.len().saturating_sub(LISTED));
        let nearest: Vec<String> = known.iter().skip(first).take(LISTED).map(Id::to_string).collect();
        let remedy = match known.len() {
            0 => "leave it out".into(),
            1..=LISTED => format!("its traffic lights are {}", nearest.join(", ")),
            count => format!("the nearest ids of its {count} traffic lights are {}", nearest.join(", ")),
        };
        Fault::new(place, format!("the map has no traffic light {id}"), remedy)
    })
}

/// Checks that no conflicting lights are green together, and that no light is left out that conflicts with these.
fn check_conflicts(
    plan: &SignalPlan,
    place: &Place,
    network: &Network,
    conflicts: &[LightConflict],
) -> Result<(), Fault> {
    for conflict in conflicts {
        let [one, other] = conflict.lights;
        let phase_of = |light| plan.turns.iter().position(|it| it.lights.contains(&light));
        let left_out = match (phase_of(one), phase_of(other)) {
            (Some(phase), None) => Some((phase, one, other)),
            (None, Some(phase)) => Some((phase, other, one)),
            _ => None,
        };
        if let Some((phase, named, left_out)) = left_out {
            let [named, left_out] = [named, left_out].map(|it| name(network, it));
            let ways = ways(network, conflict);
            let what =
                format!("the traffic light {left_out} has no phase, but conflicts with {named}: {ways}");
            return Err(Fault::new(
                place.in_phase(phase, "green"),
                what,
                "add it to a phase of this program",
            ));
        }
        let together =
            plan.turns.iter().position(|it| it.lights.contains(&one) && it.lights.contains(&other));
        if let Some(phase) = together.filter(|_| !conflict.is_ordered) {
            let [one, other] = [one, other].map(|it| name(network, it));
            let ways = ways(network, conflict);
            let what = format!(
                "the traffic lights {one} and {other} are green together, but {ways}, and neither has priority"
            );
            return Err(Fault::new(place.in_phase(phase, "green"), what, "put them into different phases"));
        }
    }
    Ok(())
}

fn name(network: &Network, light: LightIndex) -> Id {
    network.junctions.lights[light.at()].id
}

/// The movements that conflict, in words.
fn ways(network: &Network, conflict: &LightConflict) -> String {
    let zone = &network.junctions.zones[conflict.zone.at()];
    let lanelets = [conflict.side, 1 - conflict.side].map(|side| {
        let reach = &zone.sides[usize::from(side)];
        network.lanelet_at(Position::new(reach.chain, 0.5 * (reach.start + reach.end))).0.id
    });
    format!("lanelets {} and {} conflict", lanelets[0], lanelets[1])
}
