//! A description of a run.

use laneweave_maps::Problem;
use laneweave_network::Network;
use laneweave_scenario::Remark;
use laneweave_scenario::scenario::{Law, Prepared, Scenario};
use laneweave_study::units::{KMH_PER_MPS, METRES_PER_KM};

use crate::numbers::{number, percent};

/// A description of a run: plain data, stored at its begin for its report.
#[derive(Clone, Debug, PartialEq)]
pub struct About {
    /// The name of the map's file.
    pub map: String,
    /// Number of lanelets, length of all lanes [km], least and greatest speed limit [km/h].
    pub roads: (usize, f64, [f64; 2]),
    /// The law whose speed limits apply where the map gives none.
    pub law: Law,
    /// Names and weights of the styles.
    pub styles: Vec<(String, f64)>,
    /// Names and shares of the classes of vehicles.
    pub classes: Vec<(&'static str, f64)>,
    /// Demand over all origins [veh/h], and their number.
    pub demand: (f64, usize),
    /// The estimated capacity of the map [veh/h], and its bottleneck.
    pub capacity: (f64, Option<String>),
    /// Length of a step, of the warm-up, of the time to be measured [s].
    pub times: [f64; 3],
    /// Elements of the map that could not be used unchanged.
    pub problems: Vec<Problem>,
    /// Properties of the map with which traffic looks odd.
    pub remarks: Vec<Remark>,
}

impl About {
    /// The description of a run before it begins.
    pub fn of(scenario: &Scenario, prepared: &Prepared) -> About {
        let shares = prepared.world.demand().fleet.shares();
        let classes = shares.into_iter().filter(|(_, share)| *share > 0.0);
        About {
            map: scenario.map.file_name().map_or(String::new(), |it| it.to_string_lossy().into_owned()),
            roads: roads(prepared.world.network()),
            law: scenario.map_options.law,
            styles: prepared.conditions.styles.clone(),
            classes: classes.map(|(class, share)| (class.body().name, share)).collect(),
            demand: (prepared.conditions.demand_veh_h, prepared.conditions.origins.len()),
            capacity: (
                prepared.conditions.capacity.veh_h,
                prepared.conditions.capacity.bottleneck.map(|it| it.to_string()),
            ),
            times: [scenario.run.step_s, scenario.run.warmup_s, scenario.run.duration_s],
            problems: prepared.conditions.problems.clone(),
            remarks: prepared.conditions.remarks.clone(),
        }
    }
}

fn roads(network: &Network) -> (usize, f64, [f64; 2]) {
    let lanelets = &network.lanelets;
    let limits = || lanelets.iter().map(|it| it.speed_limit * KMH_PER_MPS);
    let range = [limits().fold(f64::INFINITY, f64::min), limits().fold(0.0, f64::max)];
    (lanelets.len(), lanelets.iter().map(|it| it.length()).sum::<f64>() / METRES_PER_KM, range)
}

impl About {
    /// The description in words: names and their values.
    pub fn facts(&self) -> Vec<(String, String)> {
        let About { map, roads, law, styles, classes, demand, capacity, times, .. } = self;
        let (lanelets, lane_km, [slowest, fastest]) = roads;
        let law = match law {
            Law::Germany => "Germany",
            Law::Usa => "the USA",
        };
        let limits = if slowest.round() == fastest.round() {
            format!("speed limit {slowest:.0} km/h")
        } else {
            format!("speed limits {slowest:.0} to {fastest:.0} km/h")
        };
        let total: f64 = styles.iter().map(|(_, weight)| weight).sum();
        let drivers: Vec<String> =
            styles.iter().map(|(name, weight)| format!("{name} {}", percent(weight / total))).collect();
        let vehicles: Vec<String> =
            classes.iter().map(|(name, share)| format!("{name} {}", percent(*share))).collect();
        let (rate, origins) = demand;
        let places = if *origins == 1 { "place" } else { "places" };
        let (capacity, bottleneck) = capacity;
        let first = bottleneck.as_ref().map_or(String::new(), |it| format!(" (bottleneck: {it})"));
        let [step, warmup, duration] = times;
        let km = number(*lane_km, 3);
        [
            ("Map", format!("{map}: {lanelets} lanelets, {km} km of lanes, {limits} (where the map gives none: the law of {law})")),
            ("Drivers", drivers.join(", ")),
            ("Vehicles", vehicles.join(", ")),
            ("Demand", format!("{rate:.0} veh/h at {origins} {places}; estimated capacity {capacity:.0} veh/h{first}")),
            ("Time", format!("{duration} s measured after {warmup} s of warm-up, in steps of {step} s")),
        ]
        .map(|(name, value)| (name.into(), value))
        .into()
    }
}
