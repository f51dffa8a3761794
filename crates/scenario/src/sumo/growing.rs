//! A schedule under construction: places, stops and lines are numbered as vehicles need them.

use std::collections::HashMap;

use laneweave_maps::Unused;
use laneweave_network::{ChainIndex, Class, Position};
use laneweave_sim::{CrossSection, Departures, InnerPlace, Line, LineStop, Origin, Place, Rate, Trips};

use super::edges::Edges;
use super::elements::{Elements, VehicleElement};
use super::schedule::{Schedule, Wrong};

/// An end of trips: its way, the name of a class, and the place along the last edge in millimetres.
type End = (Vec<String>, &'static str, Option<i64>);

/// An origin, a destination, and stops, each with its times in milliseconds.
type Served = (usize, usize, Vec<(usize, [Option<i64>; 2])>);

/// A place where a vehicle rests, how long, and until when at least [s].
pub(super) type Rest = (InnerPlace, f64, Option<f64>);

/// A schedule that grows.
#[derive(Default)]
pub(super) struct Growing {
    pub(super) schedule: Schedule,
    starts: HashMap<(String, bool), usize>,
    ends: HashMap<End, usize>,
    /// The chains of the fixed way to a destination.
    ways: HashMap<usize, Vec<ChainIndex>>,
    /// Lines by origin, destination and stops.
    served: HashMap<Served, usize>,
    pub(super) left_out: Unused,
}

impl Growing {
    /// Names a vehicle of `elements` that is left out.
    pub(super) fn leave_out(&mut self, elements: &Elements, vehicle: &VehicleElement, (what, remedy): Wrong) {
        let id = elements.in_file(&vehicle.id, vehicle.file);
        self.left_out.add(&what, ("vehicle", id, vehicle.line), ("they are left out", remedy));
    }

    /// The number of the origin at the beginning of an edge, which a class may use.
    pub(super) fn origin(
        &mut self,
        edges: &Edges,
        edge: &str,
        (class, is_passed): (Class, bool),
    ) -> Result<usize, Wrong> {
        let Some(start) = edges.start(edge).filter(|_| !edges.lanes(edge, class).is_empty()) else {
            let what = format!("vehicles that start on an edge that is not for a {}", class.body().name);
            return Err((what, "let them start elsewhere"));
        };
        let Growing { schedule, starts, .. } = self;
        Ok(*starts.entry((edge.to_owned(), is_passed)).or_insert_with(|| {
            let place = Place::Across(if is_passed { start.passed() } else { start });
            let (rate, weights, trips) = (Rate::constant(0.0), Vec::new(), Trips::Scheduled);
            schedule.origins.push(Origin { place, rate, weights, trips });
            schedule.origins.len() - 1
        }))
    }

    /// The number of the destination at the end of a way, so far along its last edge [m], to which trips lead along the
    /// way if it is fixed.
    pub(super) fn destination(
        &mut self,
        edges: &Edges,
        way: Vec<String>,
        class: Class,
        (is_fixed, at): (bool, Option<f64>),
    ) -> Result<usize, Wrong> {
        let last = way[way.len() - 1].clone();
        let millimetres = at.map(|it| (it * 1000.0).round() as i64);
        let there =
            edges.end(&last, at).ok_or_else(|| ("vehicles that end nowhere".into(), "correct them"))?;
        let free = self.end((vec![last], "", millimetres), || there.clone());
        if !is_fixed || way.len() == 1 {
            return Ok(free);
        }
        let key = (way, class.body().name, millimetres);
        if let Some(known) = self.ends.get(&key) {
            return Ok(*known);
        }
        let Some(chains) = edges.chains_along(&key.0, class) else {
            let what = format!("vehicles whose route is not connected for a {}", class.body().name);
            return Err((what, "correct their routes, or the classes of the lanes"));
        };
        let number = self.end(key, || there.reached_over(chains.iter().copied()));
        self.ways.insert(number, chains);
        Ok(number)
    }

    fn end(&mut self, key: End, section: impl FnOnce() -> CrossSection) -> usize {
        let Growing { schedule, ends, .. } = self;
        *ends.entry(key).or_insert_with(|| {
            schedule.destinations.push(Place::Across(section()));
            schedule.destinations.len() - 1
        })
    }

    /// The number of the line with these stops [s], without departures of its own; `None` if there are too many lines.
    pub(super) fn line(
        &mut self,
        name: &str,
        (origin, destination, class): (usize, usize, Class),
        stops: Vec<Rest>,
    ) -> Option<usize> {
        const NEVER: Departures = Departures { first_s: 0.0, every_s: Departures::SHORTEST, until_s: -1.0 };
        if stops.is_empty() {
            return None;
        }
        let stop = |(inner, rest_s, until_s)| LineStop {
            destination: self.stop(inner, destination),
            rest_s,
            until_s,
        };
        let stops: Vec<LineStop> = stops.into_iter().map(stop).collect();
        let milliseconds = |it: f64| (it * 1000.0).round() as i64;
        let named =
            |it: &LineStop| (it.destination, [Some(it.rest_s), it.until_s].map(|it| it.map(milliseconds)));
        let key = (origin, destination, stops.iter().map(named).collect());
        let number = self.schedule.lines.len();
        if let Some(known) = self.served.get(&key) {
            return Some(*known);
        }
        if number == usize::from(u16::MAX) {
            return None;
        }
        let name = name.to_owned();
        self.schedule.lines.push(Line { name, class, origin, stops, destination, departures: NEVER });
        self.served.insert(key, number);
        Some(number)
    }

    /// The number of a stop on the way to a destination.
    fn stop(&mut self, inner: InnerPlace, destination: usize) -> usize {
        let place = match self.ways.get(&destination) {
            Some(way) => {
                let there = Position::new(inner.chain, inner.station);
                Place::Across(CrossSection::new(inner.id, &[there]).reached_over(way.iter().copied()))
            }
            None => Place::Inside(inner),
        };
        let stops = &mut self.schedule.stops;
        let known = stops.iter().position(|it| *it == place);
        known.unwrap_or_else(|| {
            stops.push(place);
            stops.len() - 1
        })
    }
}
