//! From the demand and the styles of a scenario to those of the world.

use laneweave_network::Network;
use laneweave_sim::{Demand, Place, Places, Rate, Share};

use super::{Origin, Scenario, headways};
use crate::fault::{Fault, did_you_mean};
use crate::style::{StyleTemplate, find};
use crate::units::METRES_PER_KM;

/// Demand of a lane where nothing is said [veh/h].
const USUAL_DEMAND: f64 = 1000.0;
/// Demand along a kilometre of lanes on which trips start, where nothing is said [veh/h]: some ten vehicles on it, if a trip
/// takes three minutes. Ours.
const USUAL_STARTS: f64 = 200.0;
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

/// The demand at each of `places`, and the weights of the destinations.
///
/// # Errors
/// If an entrance or exit is not there, or a number makes no sense.
pub(super) fn demand(
    scenario: &Scenario,
    origin: &Origin,
    network: &Network,
    places: Places,
    population: Vec<Share>,
) -> Result<Demand, Fault> {
    let wanted = &scenario.demand;
    let lanes: usize = places.origins.iter().map(|place| place.chains().len()).sum();
    let total = wanted.vehicles_per_hour.unwrap_or_else(|| usual_demand(network, &places.origins));
    let place = origin.place(&["demand", "vehicles_per_hour"]);
    check_rate(total, lanes, place, "a demand")?;
    let mut demand = Demand::over(places, total, wanted.trucks, population);
    for (id, rate) in &wanted.entrances {
        let place = origin.place(&["demand", "entrances", id]);
        let index = named(demand.origins.iter().map(|it| &it.place), id, "entrance", &place)?;
        let lanes = demand.origins[index].place.chains().len();
        check_rate(*rate, lanes, place, &format!("a demand at the entrance {id}"))?;
        demand.origins[index].rate = Rate::constant(*rate);
    }
    let mut weights = vec![1.0; demand.destinations.len()];
    for (id, weight) in &wanted.exits {
        let place = origin.place(&["demand", "exits", id]);
        let index = named(demand.destinations.iter(), id, "exit", &place)?;
        if !(weight.is_finite() && *weight >= 0.0) {
            let what = format!("the exit {id} has the weight {weight}");
            return Err(Fault::new(place, what, "give it a finite weight of 0 or more"));
        }
        weights[index] = *weight;
    }
    if !weights.is_empty() && weights.iter().all(|it| *it == 0.0) {
        let place = origin.place(&["demand", "exits"]);
        return Err(Fault::new(place, "no exit has a weight", "give at least one of them a weight above 0"));
    }
    demand.origins.iter_mut().for_each(|it| it.weights.clone_from(&weights));
    demand.headways = wanted.headways.into();
    headways::check(&demand, origin)?;
    Ok(demand)
}

/// Demand where nothing is said [veh/h].
fn usual_demand(network: &Network, origins: &[Place]) -> f64 {
    let of_place = |place: &Place| match place {
        Place::Gate(gate) => USUAL_DEMAND * gate.chains.len() as f64,
        Place::Kerb(kerb) => {
            let (lanelet, _) = network.lanelet_at(kerb.chain, kerb.station);
            USUAL_STARTS * lanelet.length() / METRES_PER_KM
        }
    };
    origins.iter().map(of_place).sum()
}

/// Which of `places` is called `id`.
fn named<'a>(
    places: impl Iterator<Item = &'a Place> + Clone,
    id: &str,
    what: &str,
    at: &str,
) -> Result<usize, Fault> {
    places.clone().position(|it| it.id().to_string() == id).ok_or_else(|| {
        let known: Vec<String> = places.map(|it| it.id().to_string()).collect();
        let remedy = did_you_mean(id, known.iter().map(String::as_str));
        Fault::new(at, format!("the map has no {what} {id:?}"), remedy)
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
