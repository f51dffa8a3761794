//! What is stored for each trip until it ends: its time on a free road, and the number of halts. It is rarely in the
//! cache, and is found by the vehicle's id.

use std::collections::VecDeque;

use laneweave_network::{Bend, Chain, ChainIndex, Position, Side};
use serde::{Deserialize, Serialize};

use crate::record::numbering::Both;
use crate::route::fitting_speed::Outlook;
use crate::route::waypoint::Waypoint;
use crate::state::lane::VehicleId;

/// A trip in one number. The low bits are the time that its route takes at the speeds that the driver desires, in
/// tenths of a second up to 29 hours. Above them are the number of halts, and whether it has ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Trip(u32);

impl Trip {
    const TENTHS: u32 = (1 << 20) - 1;
    const STOP: u32 = 1 << 20;
    const STOPS: u32 = (1 << 11) - 1;
    const OVER: u32 = 1 << 31;
    /// Not begun, or without a destination.
    const AHEAD: Trip = Trip(Trip::TENTHS);

    fn begin(&mut self, free_time: Option<f64>) {
        let tenths =
            free_time.map_or(Trip::TENTHS, |it| (10.0 * it).round().min(f64::from(Trip::TENTHS)) as u32);
        self.0 = (self.0 & !Trip::TENTHS) | tenths;
    }

    fn stop(&mut self) {
        if self.stops() < Trip::STOPS {
            self.0 += Trip::STOP;
        }
    }

    fn is_over(self) -> bool {
        self.0 & Trip::OVER != 0
    }

    /// Times that the vehicle came to a halt, 2047 at most.
    pub(crate) fn stops(self) -> u32 {
        (self.0 / Trip::STOP) & Trip::STOPS
    }

    /// Delay of a trip of `duration` [s] against the time on a free road [s]; none without a destination.
    pub(crate) fn delay(self, duration: f64) -> Option<f64> {
        let tenths = self.0 & Trip::TENTHS;
        (tenths < Trip::TENTHS).then(|| duration - 0.1 * f64::from(tenths))
    }
}

/// The trips of all vehicles.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Trips(Both<Numbered>);

/// The trips of vehicles by their number, from the oldest one that has not ended.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Numbered {
    oldest: u32,
    trips: VecDeque<Trip>,
}

impl Trips {
    /// Whether a vehicle has a trip that has begun.
    pub(crate) fn has(&self, id: VehicleId) -> bool {
        let (numbered, number) = self.0.of(id);
        number.checked_sub(numbered.oldest).is_some_and(|it| (it as usize) < numbered.trips.len())
    }

    /// Whether a vehicle can still begin a trip.
    pub(crate) fn can_begin(&self, id: VehicleId) -> bool {
        let (numbered, number) = self.0.of(id);
        number >= numbered.oldest
    }

    /// Whether all vehicles before the vehicles `next`, of the demand and of users, have a trip, except at most
    /// `but_for` of the demand.
    pub(crate) fn reach(&self, next: [VehicleId; 2], but_for: usize) -> bool {
        next.into_iter().zip([but_for, 0]).all(|(next, but_for)| {
            let (Numbered { oldest, trips }, next) = self.0.of(next);
            is_reached(next, *oldest, trips.len(), but_for)
        })
    }

    /// Begins a trip.
    pub(crate) fn begin(&mut self, id: VehicleId, free_time: Option<f64>) {
        let (Numbered { oldest, trips }, number) = self.0.of_mut(id);
        let place = (number - *oldest) as usize;
        if place >= trips.len() {
            // Doubling would leave half of the memory unused.
            let more = place + 1 - trips.len();
            if trips.capacity() <= place {
                trips.reserve_exact(more + trips.len() / 16);
            }
            trips.resize(place + 1, Trip::AHEAD);
        }
        trips[place].begin(free_time);
    }

    /// Counts a halt of the vehicle.
    pub(crate) fn stop(&mut self, id: VehicleId) {
        let (Numbered { oldest, trips }, number) = self.0.of_mut(id);
        trips[(number - *oldest) as usize].stop();
    }

    /// Ends a trip, and returns it.
    pub(crate) fn end(&mut self, id: VehicleId) -> Trip {
        let (Numbered { oldest, trips }, number) = self.0.of_mut(id);
        let trip = &mut trips[(number - *oldest) as usize];
        trip.0 |= Trip::OVER;
        let ended = *trip;
        while trips.front().is_some_and(|it| it.is_over()) {
            trips.pop_front();
            *oldest += 1;
        }
        ended
    }
}

/// Whether `count` vehicles from the number `oldest` on are all before the number `next`, except at most `but_for`.
pub(crate) fn is_reached(next: u32, oldest: u32, count: usize, but_for: usize) -> bool {
    let left = next.checked_sub(oldest).and_then(|it| (it as usize).checked_sub(count));
    left.is_some_and(|it| it <= but_for)
}

/// Time that a driver takes `from` a position to its destination on a free road [s]. It desires the speed of each limit
/// and of each bend, and changes lanes at the last place. None without a destination, or without a route to it.
pub(crate) fn free_time(driver: &Outlook, from: Position) -> Option<f64> {
    let Outlook { network, navigator, destination, .. } = *driver;
    navigator.number(destination)?;
    let Position { mut chain, mut x } = from;
    let mut time = 0.0;
    // No route passes a chain twice, except for a detour at its beginning.
    for _ in 0..=2 * network.chains.len() {
        let here = network.chain(chain);
        let waypoint = navigator.waypoint_from(network, destination, chain, x);
        let Waypoint { changes, last_place, next, end, .. } = *waypoint;
        if changes >= Waypoint::NO_WAY {
            return None;
        }
        let until = end.min(last_place).min(here.length).max(x);
        time += time_between(here, [x, until], driver);
        if end <= here.length {
            return Some(time);
        }
        (chain, x) = if last_place <= here.length {
            let beside = Side::BOTH.into_iter().filter_map(|side| here.beside(side, until));
            let changes_from = |it: ChainIndex| navigator.waypoint(destination, it).changes;
            let best = beside
                .min_by_key(|it| changes_from(it.chain))
                .filter(|it| changes_from(it.chain) < changes)?;
            (best.chain, best.across(until))
        } else {
            match next {
                Some(next) => (next, 0.0),
                None => return Some(time),
            }
        };
    }
    None
}

/// Time from one station of `chain` to another [s].
fn time_between(chain: &Chain, [from, to]: [f64; 2], driver: &Outlook) -> f64 {
    let speed =
        |limit| crate::state::vehicle::desired_speed(driver.class, driver.style, limit, &driver.network.law);
    let within = |start: f64, end: f64| (end.min(to) - start.max(from)).max(0.0);
    let lost = |it: &Bend| {
        let [slow, fast] = [driver.bend_speed(it), speed(chain.limit(it.start))];
        within(it.start, it.end) * (1.0 / slow - 1.0 / fast).max(0.0)
    };
    let in_bends: f64 = chain.bends.iter().map(lost).sum();
    let ends = chain.limits.iter().skip(1).map(|it| it.start).chain([chain.length]);
    let pieces = chain.limits.iter().zip(ends);
    in_bends + pieces.map(|(limit, end)| within(limit.start, end) / speed(limit.speed)).sum::<f64>()
}
