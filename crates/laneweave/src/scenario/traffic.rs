//! From the demand and the styles of a scenario to those of the world.

use laneweave_network::{Gate, Network};
use laneweave_sim::{Demand, Share};

use super::{Origin, Scenario};
use crate::fault::{Fault, did_you_mean};
use crate::style::{StyleTemplate, find};

/// Demand of a lane where nothing is said [veh/h].
const USUAL_DEMAND: f64 = 1000.0;
/// Nobody has seen more vehicles an hour on one lane than a quarter of this.
const LARGEST_DEMAND: f64 = 10_000.0;

/// The styles of a scenario with their weights.
///
/// # Errors
/// If a style is not known or wrong, or the weights make no mixture.
pub(super) fn mixture(scenario: &Scenario, origin: &Origin) -> Result<Vec<(StyleTemplate, f64)>, Fault> {
    let mut mixture = Vec::new();
    for (name, weight) in &scenario.styles {
        let place = || origin.place(&["styles", name]);
        let template = StyleTemplate::parse(&find(name, origin.style_folder(), place)?)?;
        if !(weight.is_finite() && *weight >= 0.0) {
            let what = format!("the style {name:?} has the weight {weight}");
            return Err(Fault::new(place(), what, "give it a finite weight of 0 or more"));
        }
        mixture.push((template, *weight));
    }
    let total: f64 = scenario.styles.values().sum();
    if !(total.is_finite() && total > 0.0) {
        let what = format!("the weights of the styles add up to {total}");
        return Err(Fault::new(
            origin.place(&["styles"]),
            what,
            "give at least one of them a weight above 0",
        ));
    }
    Ok(mixture)
}

/// The demand at each entrance, and the weight of each exit.
///
/// # Errors
/// If an entrance or exit is not there, or a number makes no sense.
pub(super) fn demand(
    scenario: &Scenario,
    origin: &Origin,
    network: &Network,
    population: Vec<Share>,
) -> Result<Demand, Fault> {
    let wanted = &scenario.demand;
    let lanes: usize = network.entrances.iter().map(|gate| gate.chains.len()).sum();
    let total = wanted.vehicles_per_hour.unwrap_or(USUAL_DEMAND * lanes as f64);
    let place = origin.place(&["demand", "vehicles_per_hour"]);
    check_rate(total, lanes, place, "a demand")?;
    let mut demand = Demand::even(network, total, wanted.trucks, population);
    for (id, rate) in &wanted.entrances {
        let place = origin.place(&["demand", "entrances", id]);
        let index = gate(&network.entrances, id, "entrance", &place)?;
        let lanes = network.entrances[index].chains.len();
        check_rate(*rate, lanes, place, &format!("a demand at the entrance {id}"))?;
        demand.rates[index] = *rate;
    }
    for (id, weight) in &wanted.exits {
        let place = origin.place(&["demand", "exits", id]);
        let index = gate(&network.exits, id, "exit", &place)?;
        if !(weight.is_finite() && *weight >= 0.0) {
            let what = format!("the exit {id} has the weight {weight}");
            return Err(Fault::new(place, what, "give it a finite weight of 0 or more"));
        }
        demand.destinations[index] = *weight;
    }
    if !demand.destinations.is_empty() && demand.destinations.iter().all(|it| *it == 0.0) {
        let place = origin.place(&["demand", "exits"]);
        return Err(Fault::new(place, "no exit has a weight", "give at least one of them a weight above 0"));
    }
    Ok(demand)
}

/// The place of the gate called `id`.
fn gate(gates: &[Gate], id: &str, what: &str, place: &str) -> Result<usize, Fault> {
    gates.iter().position(|gate| gate.id.to_string() == id).ok_or_else(|| {
        let known: Vec<String> = gates.iter().map(|gate| gate.id.to_string()).collect();
        let remedy = did_you_mean(id, known.iter().map(String::as_str));
        Fault::new(place, format!("the map has no {what} {id:?}"), remedy)
    })
}

fn check_rate(rate: f64, lanes: usize, place: String, what: &str) -> Result<(), Fault> {
    let largest = LARGEST_DEMAND * lanes as f64;
    if (0.0..=largest).contains(&rate) {
        return Ok(());
    }
    let remedy = format!("choose 0 to {largest} veh/h for the {lanes} lanes there");
    Err(Fault::new(place, format!("{what} of {rate} veh/h"), remedy))
}
