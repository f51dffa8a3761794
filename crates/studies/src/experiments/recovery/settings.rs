//! Whom a drone sees: drivers on a road, of whom the conservative ones are fitted.

use super::exact;
use crate::experiments::traffic::{Arriving, Change, Road, Traffic};

/// Drivers on a road.
#[derive(Clone, Debug)]
pub(crate) struct Setting {
    pub(crate) name: &'static str,
    /// The road with all of its drivers.
    pub(crate) traffic: Traffic,
    /// Whether rates of changes differ between its places, beyond what drivers gain there.
    pub(crate) has_places: bool,
}

/// The choice noise of the prototype's drivers (σ = .014) over that of ours, and so of θ = 8 σ.
const PROTOTYPE: f64 = 0.014 / 0.000875;
/// One aggressive driver for so many conservative ones.
const CONSERVATIVE: f64 = 7.4;

impl Setting {
    /// Conservative drivers on a motorway.
    pub(crate) fn motorway() -> Setting {
        Setting { name: "motorway", traffic: exact::traffic(), has_places: false }
    }

    /// The same with the choice noise of the prototype's drivers.
    pub(crate) fn noisy() -> Setting {
        let mut setting = Setting { name: "motorway, drivers with choice noise", ..Setting::motorway() };
        setting.traffic.changes.extend(noise());
        setting
    }

    /// The same with aggressive drivers among them.
    pub(crate) fn mixed() -> Setting {
        let mut setting = Setting { name: "motorway, two styles with choice noise", ..Setting::noisy() };
        setting.traffic.styles = two_styles();
        setting
    }

    /// Both styles with that noise in a town.
    pub(crate) fn town() -> Setting {
        let mut traffic = Setting::mixed().traffic;
        traffic.road = Road::Town(SIZE);
        traffic.demand = Arriving::Total(TOWN_DEMAND);
        Setting { name: "town, two styles with choice noise", traffic, has_places: true }
    }

    /// Both styles with that noise on a motorway so long that drivers are seen for 500 s.
    pub(crate) fn long() -> Setting {
        let mut setting = Setting::mixed();
        if let Road::Motorway(road) = &mut setting.traffic.road {
            road.length_m = LONG;
        }
        setting.traffic.times = LONG_TIMES;
        Setting { name: "long motorway, two styles with choice noise", ..setting }
    }
}

/// Streets of the town in each direction, and its vehicles per hour.
const SIZE: usize = 4;
const TOWN_DEMAND: f64 = 4000.0;
/// Length of the long motorway [m], and its times [s].
const LONG: f64 = 14_500.0;
const LONG_TIMES: [f64; 2] = [60.0, 1300.0];

fn noise() -> Vec<Change> {
    ["change.theta", "change.sigma"].map(|it| Change::Times(it, PROTOTYPE)).to_vec()
}

fn two_styles() -> Vec<(&'static str, f64)> {
    vec![("conservative", CONSERVATIVE), ("aggressive", 1.0)]
}
