//! From the vehicles of SUMO's files to the departures of a demand.

use std::collections::BTreeMap;

use laneweave_maps::Unused;
use laneweave_network::Class;
use laneweave_sim::{Demand, Departure, Fleet, Headways, Line, Origin, Place, Purpose, Random, Rate, Share};

use super::edges::Edges;
use super::elements::{Elements, Rhythm, RouteElement, StopElement, TypeElement, VehicleElement, Way, When};
use super::growing::{Growing, Rest};
use crate::style::StyleTemplate;

const SECONDS_PER_HOUR: f64 = 3600.0;
/// The type of vehicles that name none.
pub(super) const USUAL_TYPE: &str = "DEFAULT_VEHTYPE";
/// Departures of one flow, and of all vehicles, at most.
const MOST_OF_A_FLOW: usize = 1_000_000;
const MOST_IN_ALL: usize = 2_000_000;

/// Departures with the places between which they lead.
#[derive(Clone, Debug, Default)]
pub(crate) struct Schedule {
    pub(crate) origins: Vec<Origin>,
    pub(crate) destinations: Vec<Place>,
    /// The stops of lines, which are destinations after all others.
    pub(super) stops: Vec<Place>,
    /// The stops of vehicles: lines without departures of their own. Their stops are numbered among `stops`.
    pub(super) lines: Vec<Line>,
    /// In the order of their times, which count from the begin of the simulation.
    pub(crate) departures: Vec<Departure>,
}

impl Schedule {
    /// Gives each style the number of departures that have it as its weight.
    pub(crate) fn weigh(&self, mixture: &mut [(StyleTemplate, f64)]) {
        if self.departures.iter().all(|it| it.style.is_some()) {
            mixture.iter_mut().for_each(|it| it.1 = 0.0);
            self.departures.iter().filter_map(|it| it.style).for_each(|it| mixture[it].1 += 1.0);
        }
    }

    /// The demand of these departures.
    pub(crate) fn demand(&self, fleet: Fleet, population: Vec<Share>) -> Demand {
        let Schedule { mut origins, mut destinations, stops, mut lines, departures } = self.clone();
        let exits = destinations.len();
        lines.iter_mut().flat_map(|it| &mut it.stops).for_each(|it| it.destination += exits);
        let count = stops.len();
        destinations.extend(stops);
        origins.iter_mut().for_each(|it| it.weights.resize(destinations.len(), 0.0));
        let headways = Headways::default();
        Demand { origins, destinations, headways, fleet, population, lines, departures, stops: count }
    }
}

/// What is wrong with a vehicle, in the plural, and the remedy.
pub(super) type Wrong = (String, &'static str);

/// Makes departures.
pub(super) struct Scheduler<'a> {
    pub(super) elements: &'a Elements,
    pub(super) edges: Edges<'a>,
    /// The index of the style of each type; none if the drivers have other styles.
    pub(super) styles: Option<BTreeMap<String, usize>>,
    pub(super) random: Random,
    /// The times of departures count from this one [s], and those before it are left out.
    pub(super) begin_s: f64,
    /// None is later than this [s].
    pub(super) end_s: f64,
}

impl Scheduler<'_> {
    /// The departures of all vehicles, and what was left out.
    pub(super) fn schedule(&self) -> (Schedule, Unused) {
        let mut growing = Growing::default();
        for (vehicle, number) in self.elements.vehicles.iter().zip(0..) {
            let times = match self.times(vehicle, number) {
                Ok(times) => times,
                Err(wrong) => {
                    growing.leave_out(self.elements, vehicle, wrong);
                    continue;
                }
            };
            for (time, place) in times.into_iter().zip(0..) {
                if growing.schedule.departures.len() == MOST_IN_ALL {
                    let what = "vehicles beyond the first two million departures".to_owned();
                    growing.leave_out(self.elements, vehicle, (what, "simulate a shorter time"));
                    break;
                }
                let id = match vehicle.when {
                    When::Flow(..) => format!("{}.{place}", vehicle.id),
                    _ => vehicle.id.clone(),
                };
                if let Err(wrong) = self.add(vehicle, (number, place), (time, id), &mut growing) {
                    growing.leave_out(self.elements, vehicle, wrong);
                }
            }
        }
        let Growing { mut schedule, left_out, .. } = growing;
        schedule.departures.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        self.note_flows(&mut schedule);
        (schedule, left_out)
    }

    /// Gives the origins the rates and the weights that the departures have in the mean.
    fn note_flows(&self, schedule: &mut Schedule) {
        let last = schedule.departures.last().map_or(0.0, |it| it.time_s);
        let until = (self.end_s - self.begin_s).min(last).max(1.0);
        for origin in &mut schedule.origins {
            origin.weights = vec![0.0; schedule.destinations.len()];
        }
        for departure in &schedule.departures {
            schedule.origins[departure.origin].weights[departure.destination] += 1.0;
        }
        for origin in &mut schedule.origins {
            origin.rate = Rate::constant(origin.weights.iter().sum::<f64>() * SECONDS_PER_HOUR / until);
        }
    }

    /// The times at which a vehicle departs, or those of a flow [s].
    fn times(&self, vehicle: &VehicleElement, number: u32) -> Result<Vec<f64>, Wrong> {
        let is_in_time = |it: &f64| (self.begin_s..=self.end_s).contains(it);
        match &vehicle.when {
            When::At(time) => Ok([*time].into_iter().filter(is_in_time).collect()),
            When::Unclear(what) => Err((
                format!("vehicles whose {what} is not understood"),
                "give depart in seconds, or begin, end and a number, period, vehsPerHour or probability",
            )),
            When::Flow([begin, end], rhythm) => {
                let end = end.min(self.end_s);
                if !(end.is_finite() && end >= *begin) {
                    return Err(("flows without an end".into(), "give the flow, or the simulation, an end"));
                }
                let times = self.of_flow([*begin, end], *rhythm, number);
                Ok(times?.into_iter().filter(is_in_time).collect())
            }
        }
    }

    fn of_flow(&self, [begin, end]: [f64; 2], rhythm: Rhythm, number: u32) -> Result<Vec<f64>, Wrong> {
        let draw = |count: usize| self.random.uniform(number, Purpose::Arrival, count as u32);
        let evenly = |every: f64, most: usize| -> Vec<f64> {
            (0..most).map(|it| begin + every * it as f64).take_while(|it| *it < end).collect()
        };
        Ok(match rhythm {
            Rhythm::Number(count) if count >= 1.0 => {
                evenly((end - begin) / count, (count as usize).min(MOST_OF_A_FLOW))
            }
            Rhythm::Period(every) if every > 0.0 => evenly(every, MOST_OF_A_FLOW),
            Rhythm::Probability(chance) if (0.0..=1.0).contains(&chance) => {
                let seconds = evenly(1.0, MOST_OF_A_FLOW).into_iter().enumerate();
                seconds.filter(|(count, _)| draw(*count) < chance).map(|it| it.1).collect()
            }
            Rhythm::Exponential(rate) if rate > 0.0 => {
                let mut time = begin;
                let next = |count: usize| {
                    time -= (1.0 - draw(count)).ln() / rate;
                    time
                };
                (0..MOST_OF_A_FLOW).map(next).take_while(|it| *it < end).collect()
            }
            _ => return Err(("flows whose rhythm is no number".into(), "give a number above 0")),
        })
    }

    /// Adds the departure of a vehicle, whose element and departure have numbers, at a time under a name.
    fn add(
        &self,
        vehicle: &VehicleElement,
        (number, place): (u32, u32),
        (time, name): (f64, String),
        growing: &mut Growing,
    ) -> Result<(), Wrong> {
        let subject = number.wrapping_mul(65_537).wrapping_add(place);
        let usual = TypeElement::usual();
        let kind = self.kind(vehicle, subject);
        let of_kind = match self.elements.types.get(&kind) {
            Some(it) => it,
            None if kind == USUAL_TYPE => &usual,
            None => {
                return Err((format!("vehicles of the type {kind:?}, which there is not"), "add a vType"));
            }
        };
        let class = of_kind.class().ok_or_else(|| {
            (
                format!("vehicles of the class {:?}, which do not drive here", of_kind.class_name()),
                "leave it so",
            )
        })?;
        let Found { edges, is_fixed, stops } = self.way(vehicle, subject, class)?;
        let [_, _, speed, arrival] = &vehicle.ends;
        let is_passed = speed.as_deref().is_some_and(|it| laneweave_maps::xml::number(it) != 0.0);
        let at = arrival.as_deref().map(laneweave_maps::xml::number).filter(|it| it.is_finite());
        let origin = growing.origin(&self.edges, &edges[0], (class, is_passed))?;
        let destination = growing.destination(&self.edges, edges, class, (is_fixed, at))?;
        let style = self.styles.as_ref().map(|it| it.get(&kind).copied().unwrap_or(0));
        // The times of stops count from the departure in a route, and from that of the first vehicle in a flow.
        let first = if let When::Flow([begin, _], _) = vehicle.when { begin } else { time };
        let shifted =
            stops.iter().map(|it| (it, time)).chain(vehicle.stops.iter().map(|it| (it, time - first)));
        let stops = self.stops(vehicle, shifted, class, growing);
        let line = growing.line(&vehicle.id, (origin, destination, class), stops);
        self.name_unused(vehicle, growing);
        let time_s = time - self.begin_s;
        let length_m = of_kind.length_m();
        let departure = Departure { name, time_s, origin, destination, line, class, length_m, style };
        growing.schedule.departures.push(departure);
        Ok(())
    }

    /// Names what a vehicle says that is not used.
    fn name_unused(&self, vehicle: &VehicleElement, growing: &mut Growing) {
        let [lane, position, ..] = &vehicle.ends;
        let is_number = |it: &String| it.trim().parse::<u32>().is_ok();
        let is_elsewhere = |it: &String| !matches!(it.as_str(), "base" | "0" | "0.0" | "0.00");
        let unused = [
            (
                lane.as_ref().is_some_and(is_number),
                "departLane that is a number",
                "they take the lane of their way",
            ),
            (
                position.as_ref().is_some_and(is_elsewhere),
                "departPos",
                "they start at the begin of their edge",
            ),
        ];
        for (_, what, instead) in unused.into_iter().filter(|it| it.0) {
            let id = self.elements.in_file(&vehicle.id, vehicle.file);
            let place = ("vehicle", id, vehicle.line);
            growing.left_out.add(&format!("vehicles with a {what}"), place, (instead, "leave it so"));
        }
    }

    /// Where a vehicle of a class stops, for how long, and until when [s]. Each of its `stops` has the time from which
    /// it counts [s].
    fn stops<'a>(
        &self,
        vehicle: &VehicleElement,
        stops: impl Iterator<Item = (&'a StopElement, f64)>,
        class: Class,
        growing: &mut Growing,
    ) -> Vec<Rest> {
        let place = |stop: &StopElement| {
            let place = match &stop.at {
                Ok(id) => self.elements.bus_stops.get(id)?,
                Err(place) => place,
            };
            self.edges.stop(&place.lane, place.end_m, class)
        };
        let mut found = Vec::new();
        for (stop, from) in stops {
            match place(stop) {
                Some(inner) => {
                    let until = stop.until_s.map(|it| (it + from - self.begin_s).max(0.0));
                    found.push((inner, stop.duration_s, until));
                }
                None => {
                    let what = format!("stops at which a {} cannot rest", class.body().name);
                    let meaning = ("they are not served", "place them in a lane, outside of junctions");
                    let id = self.elements.in_file(&vehicle.id, vehicle.file);
                    growing.left_out.add(&what, ("stop of", id, stop.line), meaning);
                }
            }
        }
        found
    }

    /// The type of a vehicle, drawn if it names a distribution.
    fn kind(&self, vehicle: &VehicleElement, subject: u32) -> String {
        let named = vehicle.kind.as_deref().unwrap_or(USUAL_TYPE);
        let drawn = self.elements.type_distributions.get(named);
        let drawn = drawn.and_then(|it| drawn_of(it, self.random.uniform(subject, Purpose::Class, 0)));
        drawn.unwrap_or(named).to_owned()
    }

    /// The way of a vehicle of a class.
    fn way<'a>(
        &'a self,
        vehicle: &'a VehicleElement,
        subject: u32,
        class: Class,
    ) -> Result<Found<'a>, Wrong> {
        let (edges, is_fixed, stops) = match &vehicle.way {
            Way::Along(route) => (&route.edges, true, &route.stops[..]),
            Way::Named(name) => {
                let route = self.route(name, subject)?;
                (&route.edges, true, &route.stops[..])
            }
            Way::Between(edges) => (edges, edges.len() > 2, &[][..]),
        };
        if edges.is_empty() {
            return Err(("vehicles without a way".into(), "give them a route, or from and to"));
        }
        if edges.iter().any(|it| !self.edges.has(it)) {
            return Err(("vehicles whose edges are not in the net".into(), "correct their routes"));
        }
        if !(is_fixed && matches!(vehicle.way, Way::Between(_))) {
            return Ok(Found { edges: edges.clone(), is_fixed, stops });
        }
        let over = self.edges.fastest_over(edges, class);
        let wrong =
            || ("vehicles that cannot get from one edge of their via to the next".into(), "correct it");
        Ok(Found { edges: over.ok_or_else(wrong)?, is_fixed, stops })
    }

    fn route(&self, name: &str, subject: u32) -> Result<&RouteElement, Wrong> {
        let drawn = self.elements.route_distributions.get(name);
        let drawn = drawn.and_then(|it| drawn_of(it, self.random.uniform(subject, Purpose::Destination, 0)));
        let found = self.elements.routes.get(drawn.unwrap_or(name));
        found.ok_or_else(|| ("vehicles whose route there is not".into(), "add the route"))
    }
}

/// The way of a vehicle.
struct Found<'a> {
    edges: Vec<String>,
    /// It keeps to them.
    is_fixed: bool,
    /// The stops of its route.
    stops: &'a [StopElement],
}

/// The member of a distribution that `chance` draws.
fn drawn_of(members: &[(String, f64)], chance: f64) -> Option<&str> {
    let weights = || members.iter().map(|it| it.1.max(0.0));
    let mut left = chance * weights().sum::<f64>();
    let place = weights().position(|weight| {
        left -= weight;
        left < 0.0
    });
    let member = place.map(|it| &members[it]).or(members.last());
    member.map(|it| it.0.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The times of a flow from 100 s to 1,100 s.
    fn times(rhythm: Rhythm) -> Vec<f64> {
        let elements = Elements::default();
        let network = laneweave_generate::town(laneweave_network::DrivingSide::Right)
            .build()
            .expect("a town has roads")
            .network;
        let scheduler = Scheduler {
            elements: &elements,
            edges: Edges::of(&network, &[]),
            styles: None,
            random: Random::new(1),
            begin_s: 0.0,
            end_s: 2000.0,
        };
        scheduler.of_flow([100.0, 1100.0], rhythm, 7).expect("it is sound")
    }

    #[test]
    fn flows_depart_in_their_rhythm() {
        assert_eq!(times(Rhythm::Number(4.0)), [100.0, 350.0, 600.0, 850.0]);
        assert_eq!(times(Rhythm::Period(400.0)), [100.0, 500.0, 900.0]);
        // A thousand draws: five standard deviations are 0.07 of the seconds.
        let drawn = times(Rhythm::Probability(0.3));
        assert!(
            (230..370).contains(&drawn.len()) && drawn.iter().all(|it| it.fract() == 0.0),
            "{}",
            drawn.len()
        );
        // So are some 200 intervals of 5 s in the mean.
        let drawn = times(Rhythm::Exponential(0.2));
        assert!((130..270).contains(&drawn.len()) && drawn.is_sorted(), "{}", drawn.len());
        assert!(drawn.iter().all(|it| (100.0..1100.0).contains(it)));
    }

    #[test]
    fn members_of_a_distribution_are_drawn_by_their_weights() {
        let members = [("a".to_owned(), 1.0), ("b".to_owned(), 3.0), ("c".to_owned(), 0.0)];
        let drawn = [0.0, 0.24, 0.26, 0.99].map(|it| drawn_of(&members, it));
        assert_eq!(drawn, [Some("a"), Some("a"), Some("b"), Some("b")]);
        assert_eq!(drawn_of(&[], 0.5), None);
    }
}
