//! Classes of vehicles, and sets of them: who may use a lane.

use serde::{Deserialize, Serialize};

use crate::law::RoadLaw;

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
    /// A taxi.
    Taxi,
    /// A vehicle of police, fire brigade or ambulance, on a usual trip.
    Emergency,
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
    pub const ALL: [Class; 6] =
        [Class::Car, Class::Truck, Class::Bus, Class::Motorcycle, Class::Taxi, Class::Emergency];

    /// What the vehicles of this class have in common.
    #[inline]
    pub const fn body(self) -> &'static Body {
        match self {
            Class::Car => &Body { name: "car", length: 4.5, width: 1.8, strength: 3.0 },
            Class::Truck => &Body { name: "truck", length: 12.0, width: 2.5, strength: 1.0 },
            Class::Bus => &Body { name: "bus", length: 12.0, width: 2.55, strength: 1.2 },
            Class::Motorcycle => &Body { name: "motorcycle", length: 2.2, width: 0.8, strength: 5.0 },
            Class::Taxi => &Body { name: "taxi", length: 4.5, width: 1.8, strength: 3.0 },
            Class::Emergency => &Body { name: "emergency", length: 5.0, width: 1.8, strength: 3.0 },
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

    /// The speed [m/s] that `law` allows it where the limit of the road is `limit` [m/s].
    #[inline]
    pub fn allowed(self, limit: f64, law: &RoadLaw) -> f64 {
        if self.is_long() { limit.min(law.limit_of_long) } else { limit }
    }
}

/// A set of classes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Classes(u8);

impl Classes {
    /// No class.
    pub const NONE: Classes = Classes(0);
    /// All classes.
    pub const ALL: Classes = Classes((1 << Class::ALL.len()) - 1);

    /// Those that may use a lane for buses: after Lanelet2's and CommonRoad's guides; from memory.
    pub const BUS_LANE: Classes =
        Classes(1 << Class::Bus as u8 | 1 << Class::Taxi as u8 | 1 << Class::Emergency as u8);

    /// Whether `class` is in it.
    #[inline]
    pub fn has(self, class: Class) -> bool {
        self.0 & (1 << class as u8) != 0
    }

    /// Whether all of `others` are in it.
    pub fn include(self, others: Classes) -> bool {
        others.0 & !self.0 == 0
    }

    /// Whether no class is in it.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Both sets together.
    #[must_use]
    pub fn and(self, others: Classes) -> Classes {
        Classes(self.0 | others.0)
    }

    /// What both sets have in common.
    #[must_use]
    pub fn shared(self, others: Classes) -> Classes {
        Classes(self.0 & others.0)
    }

    /// This set without `others`.
    #[must_use]
    pub fn without(self, others: Classes) -> Classes {
        Classes(self.0 & !others.0)
    }

    /// Its classes, in their order.
    pub fn iter(self) -> impl Iterator<Item = Class> {
        Class::ALL.into_iter().filter(move |it| self.has(*it))
    }

    /// The names of its classes, for messages: `bus, taxi`.
    pub fn names(self) -> String {
        self.iter().map(|it| it.body().name).collect::<Vec<_>>().join(", ")
    }
}

impl FromIterator<Class> for Classes {
    fn from_iter<I: IntoIterator<Item = Class>>(classes: I) -> Classes {
        Classes(classes.into_iter().fold(0, |set, it| set | 1 << it as u8))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_holds_what_was_put_into_it() {
        let set = Classes::from_iter([Class::Taxi, Class::Bus]);
        assert_eq!(set.iter().collect::<Vec<_>>(), [Class::Bus, Class::Taxi]);
        assert_eq!(set.names(), "bus, taxi");
        assert!(!set.has(Class::Car) && Classes::ALL.include(set) && !set.include(Classes::ALL));
        assert_eq!(Classes::ALL.without(set).and(set), Classes::ALL);
        assert_eq!((Classes::ALL.iter().count(), Classes::NONE.is_empty()), (6, true));
    }
}
