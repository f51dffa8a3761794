//! Classes of vehicles.

use laneweave_models::Style;

/// A class of vehicles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Class {
    /// A passenger car.
    Car,
    /// A heavy truck.
    Truck,
}

/// What a class of vehicles has in common; the numbers are ours, of usual European vehicles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Its name in tables.
    pub name: &'static str,
    /// Length [m].
    pub length: f64,
    /// Width [m].
    pub width: f64,
    /// Hardest acceleration [m/s²].
    pub strength: f64,
    /// Speed that its drivers take for the limit where the road allows more [m/s].
    pub top_speed: f64,
}

impl Class {
    /// What its vehicles have in common.
    #[inline]
    pub fn body(self) -> &'static Body {
        match self {
            Class::Car => {
                &Body { name: "car", length: 4.5, width: 1.8, strength: 3.0, top_speed: f64::INFINITY }
            }
            Class::Truck => {
                &Body { name: "truck", length: 12.0, width: 2.5, strength: 1.0, top_speed: 80.0 / 3.6 }
            }
        }
    }

    /// Hardest acceleration [m/s²].
    #[inline]
    pub fn strength(self) -> f64 {
        self.body().strength
    }

    /// Speed [m/s] that a driver of `style` desires under `limit` [m/s].
    #[inline]
    pub fn desired_speed(self, style: &Style, limit: f64) -> f64 {
        limit.min(self.body().top_speed) * style.speed_factor
    }
}
