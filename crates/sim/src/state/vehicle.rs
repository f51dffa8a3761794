//! Classes of vehicles.

use laneweave_models::Style;
use laneweave_network::RoadLaw;
use serde::{Deserialize, Serialize};

/// No vehicle is longer than this [m].
pub(crate) const LONGEST: f64 = 12.0;

/// A class of vehicles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[repr(u8)]
pub enum Class {
    /// A passenger car.
    Car,
    /// A heavy truck.
    Truck,
    /// A city bus.
    Bus,
    /// A motorcycle.
    Motorcycle,
}

/// Shares of the classes; the remaining vehicles are cars.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fleet {
    /// Share of trucks.
    pub trucks: f64,
    /// Share of buses.
    pub buses: f64,
    /// Share of motorcycles.
    pub motorcycles: f64,
}

impl Fleet {
    /// A fleet of cars with a share of trucks.
    pub fn with_trucks(trucks: f64) -> Fleet {
        Fleet { trucks, ..Fleet::default() }
    }

    /// Each class with its share.
    pub fn shares(&self) -> [(Class, f64); 4] {
        /// A sum of shares that exceeds 1 by no more than this does so by rounding.
        const ROUNDING: f64 = 1e-9;
        let Fleet { trucks, buses, motorcycles } = *self;
        let cars = 1.0 - (trucks + buses + motorcycles);
        let cars = if cars.abs() < ROUNDING { 0.0 } else { cars };
        let others = [(Class::Truck, trucks), (Class::Bus, buses), (Class::Motorcycle, motorcycles)];
        [(Class::Car, cars), others[0], others[1], others[2]]
    }

    /// The class for a uniform random number.
    pub(crate) fn class(&self, uniform: f64) -> Class {
        let mut at = uniform;
        let others = &self.shares()[1..];
        let drawn = others.iter().find(|(_, share)| {
            at -= share;
            at < 0.0
        });
        drawn.map_or(Class::Car, |(class, _)| *class)
    }
}

/// What the vehicles of a class have in common. The numbers are ours, for usual European vehicles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Its name in tables.
    pub name: &'static str,
    /// Length [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
    /// Maximum acceleration [m/s²].
    pub strength: f64,
}

impl Class {
    /// All of them, in their order.
    pub const ALL: [Class; 4] = [Class::Car, Class::Truck, Class::Bus, Class::Motorcycle];

    /// What the vehicles of this class have in common.
    #[inline]
    pub fn body(self) -> &'static Body {
        match self {
            Class::Car => &Body { name: "car", length: 4.5, width: 1.8, strength: 3.0 },
            Class::Truck => &Body { name: "truck", length: 12.0, width: 2.5, strength: 1.0 },
            Class::Bus => &Body { name: "bus", length: 12.0, width: 2.55, strength: 1.2 },
            Class::Motorcycle => &Body { name: "motorcycle", length: 2.2, width: 0.8, strength: 5.0 },
        }
    }

    /// Whether its vehicles are long: they keep to the slow side, and avoid tight turns.
    #[inline]
    pub fn is_long(self) -> bool {
        matches!(self, Class::Truck | Class::Bus)
    }

    /// Maximum acceleration [m/s²].
    #[inline]
    pub fn strength(self) -> f64 {
        self.body().strength
    }

    /// Desired speed [m/s] of a driver of `style` under this `law` where the limit of the road is `limit` [m/s].
    #[inline]
    pub fn desired_speed(self, style: &Style, limit: f64, law: &RoadLaw) -> f64 {
        self.allowed(limit, law) * style.speed_factor
    }

    /// The speed [m/s] that `law` allows it where the limit of the road is `limit` [m/s].
    #[inline]
    pub fn allowed(self, limit: f64, law: &RoadLaw) -> f64 {
        if self.is_long() { limit.min(law.limit_of_long) } else { limit }
    }
}
