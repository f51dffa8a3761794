//! Lines of buses in a scenario.

use laneweave_network::{Id, Network, Position};
use laneweave_sim::{Class, Demand, Departures, InnerPlace, LineStop, Place, World};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::WrittenId;
use super::demand::named;
use super::{LONGEST, Origin, Scenario};
use crate::fault::Fault;

/// A line: buses that leave at fixed times, and rest at stops on their way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Its name; default: its number, from 1 on.
    pub name: Option<String>,
    /// The class of its vehicles.
    #[serde(default = "bus")]
    #[schemars(with = "String", extend("enum" = ["car", "truck", "bus", "motorcycle", "taxi", "emergency"]))]
    pub class: Class,
    /// The smallest lanelet id of the entrance at which its vehicles start.
    pub from: String,
    /// The smallest lanelet id of the exit at which they leave.
    pub to: String,
    /// Time of the first departure [s], counted from the start of the simulation (with the warm-up).
    #[serde(default)]
    pub first_s: f64,
    /// Time between two departures [s].
    pub every_s: f64,
    /// No departure is later than this [s]; default: they go on.
    pub until_s: Option<f64>,
    /// Its stops, in order.
    #[serde(default)]
    pub stops: Vec<Stop>,
}

/// A stop of a line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// The id of its lanelet.
    #[schemars(with = "WrittenId")]
    pub lanelet: Id,
    /// Where the front bumper stands along the lanelet [m].
    pub position_m: f64,
    /// Time for which a vehicle rests there [s].
    #[serde(default = "usual_rest")]
    pub rest_s: f64,
}

fn bus() -> Class {
    Class::Bus
}

fn usual_rest() -> f64 {
    20.0
}

/// Greatest time at a stop [s]; ours.
const LONGEST_REST: f64 = 3600.0;

/// Adds the lines of a scenario to `demand`, with their stops as its last destinations.
///
/// # Errors
/// If a line has a place that does not exist, or at which its vehicles cannot rest, or an invalid number.
pub(super) fn add_lines(
    scenario: &Scenario,
    origin: &Origin,
    network: &Network,
    demand: &mut Demand,
) -> Result<(), Fault> {
    let exits = demand.destinations.len();
    for (line, number) in scenario.demand.line.iter().zip(0..) {
        let place = |key: &str| place_in_line(origin, number, key);
        check_times(line, place)?;
        let origins = demand.origins.iter().map(|it| &it.place);
        let from = named(origins, &line.from, "entrance", &place("from"))?;
        let to = named(demand.destinations[..exits].iter(), &line.to, "exit", &place("to"))?;
        let mut stops = Vec::with_capacity(line.stops.len());
        for (stop, at) in line.stops.iter().zip(0..) {
            let inner = inner_place(stop, line.class, network).map_err(|(key, what, remedy)| {
                Fault::new(place(&format!("stops.{at}.{key}")), what, remedy)
            })?;
            stops.push(LineStop {
                destination: demand.destinations.len(),
                rest_s: stop.rest_s,
                until_s: None,
            });
            demand.destinations.push(Place::Inside(inner));
        }
        let departures = Departures {
            first_s: line.first_s,
            every_s: line.every_s,
            until_s: line.until_s.unwrap_or(f64::INFINITY),
        };
        demand.lines.push(laneweave_sim::Line {
            name: line.name.clone().unwrap_or_else(|| (number + 1).to_string()),
            class: line.class,
            origin: from,
            stops,
            destination: to,
            departures,
        });
    }
    demand.stops = demand.destinations.len() - exits;
    let destinations = demand.destinations.len();
    demand.origins.iter_mut().for_each(|it| it.weights.resize(destinations, 0.0));
    Ok(())
}

/// Checks that a route leads from each place of a line to the next one.
///
/// # Errors
/// The first one to which none leads.
pub(super) fn check_lines(scenario: &Scenario, origin: &Origin, world: &World) -> Result<(), Fault> {
    let Some((number, stop)) = world.line_without_a_route() else { return Ok(()) };
    let line = &scenario.demand.line[number];
    let class = line.class.body().name;
    let (key, there) = match line.stops.get(stop) {
        Some(it) => (format!("stops.{stop}"), format!("the stop on lanelet {}", it.lanelet)),
        None => ("to".into(), format!("the exit {}", line.to)),
    };
    let before = match stop.checked_sub(1) {
        Some(it) => format!("the stop on lanelet {}", line.stops[it].lanelet),
        None => format!("the entrance {}", line.from),
    };
    let what = format!("no route for a {class} leads from {before} to {there}");
    Err(Fault::new(
        place_in_line(origin, number, &key),
        what,
        "choose another place, or another order of the stops",
    ))
}

/// The place of a key in a line.
fn place_in_line(origin: &Origin, number: usize, key: &str) -> String {
    let number = number.to_string();
    let path: Vec<&str> = ["demand", "line", &number].into_iter().chain(key.split('.')).collect();
    origin.place(&path)
}

fn check_times(line: &Line, place: impl Fn(&str) -> String) -> Result<(), Fault> {
    let until = line.until_s.unwrap_or(LONGEST);
    let times = [
        ("first_s", "a first departure at", line.first_s, [0.0, LONGEST]),
        ("every_s", "an interval of", line.every_s, [Departures::SHORTEST, LONGEST]),
        ("until_s", "a last departure at", until, [line.first_s, LONGEST]),
    ];
    for (key, what, value, [from, to]) in times {
        if !(from..=to).contains(&value) {
            return Err(Fault::new(
                place(key),
                format!("{what} {value} s"),
                format!("choose {from} to {to} s"),
            ));
        }
    }
    Ok(())
}

/// The key of a stop that is wrong, what is wrong with it, and the remedy.
pub(crate) type Wrong = (&'static str, String, String);

/// The place at which trips to a stop would end.
pub(crate) fn inner_place(stop: &Stop, class: Class, network: &Network) -> Result<InnerPlace, Wrong> {
    let Stop { lanelet: id, position_m, rest_s } = *stop;
    if !(0.0..=LONGEST_REST).contains(&rest_s) {
        return Err(("rest_s", format!("a rest of {rest_s} s"), format!("choose 0 to {LONGEST_REST} s")));
    }
    let Some(index) = network.lanelet_with(id) else {
        return Err(("lanelet", format!("there is no lanelet {id}"), "choose a lanelet of the map".into()));
    };
    let lanelet = &network.lanelets[index.at()];
    if !lanelet.classes.has(class) {
        let what = format!("lanelet {id} is for {} only", lanelet.classes.names());
        return Err(("lanelet", what, "choose another lanelet, or another class".into()));
    }
    let Position { chain, x: start } = network.start_of(index);
    let body = class.body().length;
    // The vehicle stands in its lane, and its trip would end beyond it.
    let lane = network.chain(chain);
    let end = if lane.ends_for.has(class) {
        lane.driven_until(class.is_long()) - LineStop::BEFORE_A_LANE_END
    } else {
        lane.length - LineStop::MARGIN
    };
    let latest = lanelet.length().min(end - start);
    let earliest = (body - start).max(0.0);
    if !(earliest..=latest).contains(&position_m) {
        let what = format!("a position of {position_m} m on lanelet {id}");
        let remedy = if earliest <= latest {
            format!("choose {earliest:.1} to {latest:.1} m")
        } else {
            "choose another lanelet: this one is too short".into()
        };
        return Err(("position_m", what, remedy));
    }
    let (junctions, x) = (&network.junctions, start + position_m);
    if !lane.takes(x, class) {
        let what = format!("lanelet {id} is too narrow for a {} there", class.body().name);
        return Err(("position_m", what, "choose another place".into()));
    }
    let mut zones = junctions.on(chain).crossings.iter().map(|it| junctions.reach(*it));
    if let Some(zone) = zones.find(|it| it.start < x && x - body < it.end) {
        let what = format!("a {} would rest in a conflict area", class.body().name);
        let [from, to] = [zone.start, zone.end + body].map(|it| it - start);
        return Err(("position_m", what, format!("choose a place before {from:.1} m or beyond {to:.1} m")));
    }
    Ok(InnerPlace { id, chain, station: x + LineStop::MARGIN })
}
