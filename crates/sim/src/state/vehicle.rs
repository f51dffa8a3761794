//! The vehicles of the demand.

use laneweave_models::Style;
use laneweave_network::RoadLaw;
pub(crate) use laneweave_network::{Class, Classes};

/// No vehicle is longer than this [m].
pub(crate) const LONGEST: f64 = 12.0;

/// Shares of the classes; the remaining vehicles are cars.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fleet {
    /// Share of trucks.
    pub trucks: f64,
    /// Share of buses.
    pub buses: f64,
    /// Share of motorcycles.
    pub motorcycles: f64,
    /// Share of taxis.
    pub taxis: f64,
    /// Share of vehicles of emergency services.
    pub emergency: f64,
}

impl Fleet {
    /// A fleet of cars with a share of trucks.
    pub fn with_trucks(trucks: f64) -> Fleet {
        Fleet { trucks, ..Fleet::default() }
    }

    /// Each class with its share.
    pub fn shares(&self) -> [(Class, f64); Class::ALL.len()] {
        /// A sum of shares that exceeds 1 by no more than this does so by rounding.
        const ROUNDING: f64 = 1e-9;
        let Fleet { trucks, buses, motorcycles, taxis, emergency } = *self;
        let cars = 1.0 - (trucks + buses + motorcycles + taxis + emergency);
        let cars = if cars.abs() < ROUNDING { 0.0 } else { cars };
        Class::ALL.map(|class| {
            let share = match class {
                Class::Car => cars,
                Class::Truck => trucks,
                Class::Bus => buses,
                Class::Motorcycle => motorcycles,
                Class::Taxi => taxis,
                Class::Emergency => emergency,
            };
            (class, share)
        })
    }

    /// The classes that it has.
    pub(crate) fn classes(&self) -> Classes {
        self.shares().into_iter().filter(|it| it.1 > 0.0).map(|it| it.0).collect()
    }

    /// The class for a uniform random number, drawn among those of `possible` in proportion to their shares; a car
    /// where it has none of these.
    pub(crate) fn class(&self, uniform: f64, possible: Classes) -> Class {
        let shares = self.shares();
        let impossible: f64 = shares.iter().filter(|it| !possible.has(it.0)).map(|it| it.1).sum();
        let mut at = uniform * (1.0 - impossible);
        let others = shares[1..].iter().filter(|it| possible.has(it.0) && it.1 > 0.0);
        let drawn = others.clone().find(|(_, share)| {
            at -= share;
            at < 0.0
        });
        let last = || if possible.has(Class::Car) { None } else { others.clone().next_back() };
        drawn.or_else(last).map_or(Class::Car, |(class, _)| *class)
    }
}

/// Desired speed [m/s] of a driver of `style` in a vehicle of `class` under this `law` where the limit of the road is
/// `limit` [m/s].
#[inline]
pub fn desired_speed(class: Class, style: &Style, limit: f64, law: &RoadLaw) -> f64 {
    class.allowed(limit, law) * style.speed_factor
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_is_drawn_among_the_possible_ones_in_proportion_to_their_shares() {
        let fleet = Fleet { trucks: 0.2, buses: 0.1, ..Fleet::default() };
        let [buses_and_trucks, cars] = [Classes::from_iter([Class::Truck, Class::Bus]), Classes::ALL];
        let drawn = |possible| (0..300).map(move |it| fleet.class((f64::from(it) + 0.5) / 300.0, possible));
        let count = |possible, class| drawn(possible).filter(|it| *it == class).count();
        assert_eq!([Class::Truck, Class::Bus, Class::Car].map(|it| count(cars, it)), [60, 30, 210]);
        assert_eq!(
            [Class::Truck, Class::Bus, Class::Car].map(|it| count(buses_and_trucks, it)),
            [200, 100, 0]
        );
    }
}
