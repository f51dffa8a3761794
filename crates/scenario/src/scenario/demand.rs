//! From the demand of a scenario to that of the world.

use laneweave_network::{Classes, Network, Position};
use laneweave_sim::{Demand, Fleet, Place, Places, Rate, Share, Trips, World};
use laneweave_study::units::METRES_PER_KM;

use super::line::{add_lines, check_lines};
use super::turns::set_turns;
use super::{OdRow, Origin, Scenario, VehiclesPerHour, headways};
use crate::fault::{Fault, did_you_mean};

/// Default demand of a lane where the scenario gives that of others, or where there is no estimate [veh/h].
const USUAL_DEMAND: f64 = 1000.0;
/// The same along a kilometre of lanes on which trips start [veh/h]: some ten vehicles on it, if a trip
/// takes three minutes. Ours.
const USUAL_STARTS: f64 = 200.0;
/// Maximum flow of a lane [veh/h]; a quarter of it is more than was ever observed.
const LARGEST_DEMAND: f64 = 10_000.0;

/// The demand where a scenario gives none.
pub(super) enum Amount {
    /// Over all origins, by their lanes for cars [veh/h].
    Total(f64),
    /// Of each origin [veh/h].
    Each(Vec<f64>),
}

/// The demand at each of `places`, and the weights of the destinations. Where the scenario gives none, it is `amount`,
/// or else the default one. Nobody starts at the origins with the numbers `avoided`, unless the scenario names them.
///
/// # Errors
/// If an entrance or exit does not exist, or a number is invalid.
pub(super) fn demand(
    scenario: &Scenario,
    origin: &Origin,
    network: &Network,
    places: Places,
    population: Vec<Share>,
    (amount, avoided): (Option<&Amount>, &[usize]),
) -> Result<Demand, Fault> {
    let wanted = &scenario.demand;
    let lanes: usize = places.origins.iter().map(|it| it.chains().len()).sum();
    // A table of origins and destinations is the whole demand, unless a total is given for the other origins.
    let usual = || if wanted.od.is_empty() { usual_demand(network, &places.origins) } else { 0.0 };
    let total = wanted.vehicles_per_hour.unwrap_or_else(|| match amount {
        Some(Amount::Total(total)) => *total,
        Some(Amount::Each(rates)) => rates.iter().sum(),
        None => usual(),
    });
    check_rate(total, lanes, origin.place(&["demand", "vehicles_per_hour"]), "a demand")?;
    let mut demand = Demand::over(network, places, total, wanted.fleet(), population);
    avoid(&mut demand, avoided, total);
    if let Some(Amount::Each(rates)) = amount {
        demand.origins.iter_mut().zip(rates).for_each(|(it, rate)| it.rate = Rate::constant(*rate));
    }
    let weights = weights(scenario, origin, &demand)?;
    demand.origins.iter_mut().for_each(|it| it.weights.clone_from(&weights));
    set_turns(scenario, origin, network, &mut demand)?;
    set_single_rates(scenario, origin, &mut demand)?;
    set_od_rows(scenario, origin, &mut demand)?;
    if !wanted.profile.is_empty() {
        let place = origin.place(&["demand", "profile"]);
        let factor = by_pieces(&wanted.profile, place, (f64::MAX, "a factor", ""))?;
        demand.origins.iter_mut().for_each(|it| it.rate = it.rate.times(&factor));
    }
    add_lines(scenario, origin, network, &mut demand)?;
    demand.headways = wanted.headways.into();
    headways::check(&demand, network, origin)?;
    Ok(demand)
}

impl super::Demand {
    /// The classes that drive, those of lines among them.
    pub(crate) fn classes(&self) -> Classes {
        let shares = self.fleet().shares().into_iter().filter(|it| it.1 > 0.0).map(|it| it.0);
        shares.chain(self.line.iter().map(|it| it.class)).collect()
    }

    /// The shares of the classes of its vehicles.
    pub(crate) fn fleet(&self) -> Fleet {
        let super::Demand { trucks, buses, motorcycles, taxis, emergency, .. } = *self;
        Fleet { trucks, buses, motorcycles, taxis, emergency }
    }
}

/// Moves the demand of the `avoided` origins to the others, so that it is `total` vehicles per hour.
fn avoid(demand: &mut Demand, avoided: &[usize], total: f64) {
    avoided.iter().for_each(|it| demand.origins[*it].rate = Rate::constant(0.0));
    let left: f64 = demand.origins.iter().map(|it| it.rate.highest()).sum();
    if left > 0.0 && !avoided.is_empty() {
        let factor = Rate::constant(total / left);
        demand.origins.iter_mut().for_each(|it| it.rate = it.rate.times(&factor));
    }
}

/// Weight of each of the destinations.
fn weights(scenario: &Scenario, origin: &Origin, demand: &Demand) -> Result<Vec<f64>, Fault> {
    let mut weights = vec![1.0; demand.destinations.len()];
    for (id, weight) in &scenario.demand.exits {
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
    Ok(weights)
}

/// Single entrances get rates of their own.
fn set_single_rates(scenario: &Scenario, origin: &Origin, demand: &mut Demand) -> Result<(), Fault> {
    for (id, rate) in &scenario.demand.entrances {
        let place = origin.place(&["demand", "entrances", id]);
        let index = named(demand.origins.iter().map(|it| &it.place), id, "entrance", &place)?;
        let lanes = demand.origins[index].place.chains().len();
        let what = format!("a demand at the entrance {id}");
        demand.origins[index].rate = match rate {
            VehiclesPerHour::Constant(rate) => {
                check_rate(*rate, lanes, place, &what)?;
                Rate::constant(*rate)
            }
            VehiclesPerHour::OverTime(pieces) => {
                by_pieces(pieces, place, (LARGEST_DEMAND * lanes as f64, &what, " veh/h"))?
            }
        };
    }
    Ok(())
}

/// An origin in the table of origins and destinations gets the sum of its rows as its rate, and the rows as the weights
/// of its destinations.
fn set_od_rows(scenario: &Scenario, origin: &Origin, demand: &mut Demand) -> Result<(), Fault> {
    let mut sums: Vec<Option<f64>> = vec![None; demand.origins.len()];
    for (row, number) in scenario.demand.od.iter().zip(0..) {
        let place = |key| place_in_row(origin, number, key);
        let (from, to) = ends(row, demand, place)?;
        if scenario.demand.entrances.contains_key(&row.from) {
            let what = format!("the entrance {} also has a demand in demand.entrances", row.from);
            return Err(Fault::new(place("from"), what, "remove it there, or remove this row"));
        }
        let it = &mut demand.origins[from];
        if sums[from].is_none() {
            it.weights.fill(0.0);
            it.trips = Trips::All;
        }
        let sum = sums[from].unwrap_or(0.0) + row.vehicles_per_hour;
        let what = format!("a demand from {} to {}", row.from, row.to);
        let lanes = it.place.chains().len();
        check_rate(row.vehicles_per_hour, lanes, place("vehicles_per_hour"), &what)?;
        check_rate(
            sum,
            lanes,
            place("vehicles_per_hour"),
            &format!("a demand at the entrance {}", row.from),
        )?;
        it.weights[to] += row.vehicles_per_hour;
        it.rate = Rate::constant(sum);
        sums[from] = Some(sum);
    }
    Ok(())
}

/// Checks that somebody of the demand may start at every origin for which it gives a rate, and that every line, and
/// every row of the table of origins and destinations, has a route.
///
/// # Errors
/// The first origin at which nobody may start, or the first line or row without a route.
pub(super) fn check_ways(scenario: &Scenario, origin: &Origin, world: &World) -> Result<(), Fault> {
    for (start, number) in world.demand().origins.iter().zip(0..) {
        let id = start.place.id().to_string();
        let is_named =
            scenario.demand.entrances.contains_key(&id) || scenario.demand.od.iter().any(|it| it.from == id);
        if is_named && start.rate.highest() > 0.0 && world.starting_at(number).is_empty() {
            let what = for_nobody(&start.place, world.network());
            let remedy = "give the demand a share of those who may, or remove the entrance from it";
            return Err(Fault::new(origin.place(&["demand"]), what, remedy));
        }
    }
    check_lines(scenario, origin, world)?;
    for (row, number) in scenario.demand.od.iter().zip(0..) {
        let place = |key| place_in_row(origin, number, key);
        let (from, to) = ends(row, world.demand(), place)?;
        if row.vehicles_per_hour > 0.0 && !world.leads(from, to) {
            let what = format!(
                "no trip from {} to {} is possible: there is no route, or it is too short",
                row.from, row.to
            );
            return Err(Fault::new(place("to"), what, "remove the row, or choose another exit"));
        }
    }
    Ok(())
}

/// Why no class of the demand starts at `place`.
fn for_nobody(place: &Place, network: &Network) -> String {
    let lanes = place.chains().iter().map(|it| network.chain(*it).classes);
    let (id, classes) = (place.id(), lanes.fold(Classes::NONE, Classes::and));
    if classes == Classes::ALL {
        format!("no class of the demand may drive from the entrance {id} to any of its exits")
    } else {
        format!(
            "the lanes of the entrance {id} are for {} only, and the demand has none of these",
            classes.names()
        )
    }
}

fn place_in_row(origin: &Origin, number: usize, key: &str) -> String {
    origin.place(&["demand", "od", &number.to_string(), key])
}

/// The indices of a row's origin and destination in the lists of `demand`.
fn ends(
    row: &OdRow,
    demand: &Demand,
    place: impl Fn(&'static str) -> String,
) -> Result<(usize, usize), Fault> {
    let origins = demand.origins.iter().map(|it| &it.place);
    let from = named(origins, &row.from, "entrance", &place("from"))?;
    let to = named(demand.exits().iter(), &row.to, "exit", &place("to"))?;
    Ok((from, to))
}

/// Values over time, each from 0 to the maximum; they have the name `what` and a `unit`.
fn by_pieces(
    pieces: &[[f64; 2]],
    place: String,
    (largest, what, unit): (f64, &str, &str),
) -> Result<Rate, Fault> {
    if let Some([_, value]) = pieces.iter().find(|[_, value]| !(0.0..=largest).contains(value)) {
        let limit = if largest == f64::MAX { "0 or more".into() } else { format!("0 to {largest}{unit}") };
        return Err(Fault::new(place, format!("{what} of {value}{unit}"), format!("choose {limit}")));
    }
    let pairs: Vec<(f64, f64)> = pieces.iter().map(|[time, value]| (*time, *value)).collect();
    Rate::by_pieces(&pairs).ok_or_else(|| {
        Fault::new(
            place,
            "the times do not increase",
            "write [[time_s, value], …] with increasing times, the first 0 or later",
        )
    })
}

/// The default demand [veh/h].
fn usual_demand(network: &Network, origins: &[Place]) -> f64 {
    let of_place = |place: &Place| match place {
        Place::Gate(_) => USUAL_DEMAND * place.lanes(network) as f64,
        Place::Across(_) => 0.0,
        Place::Inside(inner) => {
            let (lanelet, _) = network.lanelet_at(Position::new(inner.chain, inner.station));
            USUAL_STARTS * lanelet.length() / METRES_PER_KM
        }
    };
    origins.iter().map(of_place).sum()
}

/// The index in `places` of the place `id`.
pub(super) fn named<'a>(
    places: impl Iterator<Item = &'a Place> + Clone,
    id: &str,
    what: &str,
    at: &str,
) -> Result<usize, Fault> {
    places.clone().position(|it| it.id() == id).ok_or_else(|| {
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
