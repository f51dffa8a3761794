//! The data of a run for its report.

mod brakings;
mod driving;
mod places;
mod reasons;
mod trip_times;

use laneweave_network::{Network, Position};
use laneweave_scenario::scenario::{Conditions, Prepared, Scenario};
use laneweave_sim::{Event, Incident, LaneChangeKind, World};
use laneweave_study::{LaneInTime, Sheet, rate_density, time_space};
use serde::{Deserialize, Serialize};

use crate::seen::{Boxes, Traces};

pub(crate) use brakings::HardBrakings;
pub use driving::{Driving, StyleDriving};
pub(crate) use places::{Places, Sparse, Spotted, in_plan};
pub use reasons::Reasons;
pub use trip_times::{Crowd, TripTimes};

/// Number of lanes with time–space diagrams.
const ROADS: usize = 2;
/// Maximum of incidents in the list.
const INCIDENTS: usize = 10;

/// The data of a run for its report.
#[derive(Debug, Serialize, Deserialize)]
pub struct Record {
    /// Density, flow, speed and lane changes in boxes.
    pub boxes: Boxes,
    /// The lanes with the largest distance driven.
    pub roads: Vec<Traces>,
    /// Driving behaviour.
    pub driving: Driving,
    /// Reasons of lane changes.
    pub reasons: Reasons,
    /// Times of trips.
    pub trips: TripTimes,
    /// Numbers of vehicles over time.
    pub crowd: Crowd,
    /// Hard brakings.
    pub(crate) brakings: HardBrakings,
    /// The first incidents.
    pub incidents: Vec<Incident>,
    /// Where lane changes and incidents happened, and vehicles waited to enter.
    pub(crate) places: Places,
}

impl Record {
    /// Empty data for a run before it begins.
    pub(crate) fn of(scenario: &Scenario, prepared: &Prepared) -> Record {
        let (world, Conditions { origins, warmup_steps, steps, .. }) =
            (&prepared.world, &*prepared.conditions);
        let [begin, duration] = [*warmup_steps, *steps].map(|it| f64::from(it) * scenario.run.step_s);
        Record {
            boxes: Boxes::new(world, begin, duration),
            roads: Traces::most_driven(ROADS, world, origins, begin, duration),
            driving: Driving::of(world),
            reasons: Reasons::new(world, begin),
            trips: TripTimes::of(world),
            crowd: Crowd::default(),
            brakings: HardBrakings::default(),
            incidents: Vec::new(),
            places: Places::new(world, begin),
        }
    }

    /// Whether it goes on from `new`, which has seen nothing of a run on `network`: what a checkpoint holds may be
    /// of another run, or changed.
    pub(crate) fn fits(&self, new: &Record, network: &Network) -> bool {
        let Record { boxes, roads, driving, reasons, trips, crowd, brakings: _, incidents, places } = self;
        let is_there = |it: &Position| it.chain.at() < network.chains.len() && it.x.is_finite();
        boxes.fits(&new.boxes)
            && roads.len() == new.roads.len()
            && roads.iter().zip(&new.roads).all(|(it, new)| it.fits(new))
            && driving.fits(&new.driving)
            && reasons.fits(&new.reasons)
            && trips.fits(&new.trips)
            && crowd.is_sound()
            && incidents.len() <= INCIDENTS
            && incidents.iter().flat_map(|it| &it.places).all(is_there)
            && places.fits(&new.places)
    }

    /// Observes the world after a step.
    pub(crate) fn observe(&mut self, world: &World) {
        let Record { boxes, roads, driving, reasons, trips, crowd, brakings, incidents, places } = self;
        boxes.observe(world);
        roads.iter_mut().for_each(|it| it.observe(world));
        driving.observe(world);
        reasons.observe(world);
        trips.observe(world);
        crowd.observe(world);
        brakings.observe(world);
        places.observe(world);
        let seen = world.events().iter().filter_map(|it| match it {
            Event::Incident(incident) => Some(*incident),
            _ => None,
        });
        incidents.extend(seen.take(INCIDENTS - incidents.len()));
    }

    /// Lane changes against density, of the boxes that were complete at `end` [s].
    pub(crate) fn rate_figure(&self, end: f64) -> String {
        let all = self.boxes.series("all", end, |_| true);
        let discretionary =
            self.boxes.series("discretionary", end, |kind| kind == LaneChangeKind::Discretionary);
        rate_density(Sheet::Page, "Lane changes against density", &[all, discretionary]).svg
    }

    /// The time–space data of the lane with the largest distance driven.
    pub(crate) fn time_space_figure(&self) -> String {
        let traces = self.roads.first();
        let title = match traces {
            Some(it) => format!("The lane from lanelet {} on", it.lanelet),
            None => "No vehicle enters".into(),
        };
        let lane = LaneInTime {
            name: title.clone(),
            trajectories: traces.iter().flat_map(|it| it.trajectories()).collect(),
            changes: traces.map_or(Vec::new(), |it| it.changes.clone()),
        };
        time_space(Sheet::Page, &title, &[lane]).svg
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use laneweave_scenario::scenario::{Origin, prepare};

    use super::*;

    #[test]
    fn what_is_kept_goes_on_only_from_a_run_of_the_same_lanes_and_styles() {
        let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps/on_ramp.osm");
        let scenario = Scenario::of_map(map);
        let mut prepared = prepare(&scenario, &Origin::default()).expect("the map is sound");
        let new = Record::of(&scenario, &prepared);
        let network = prepared.world.shared_network();
        let mut seen = Record::of(&scenario, &prepared);
        for _ in 0..300 {
            prepared.step();
            seen.observe(&prepared.world);
        }
        assert!(seen.fits(&new, &network));
        let changed = |change: &dyn Fn(&mut Record)| {
            let bytes = crate::pack::pack(&seen).expect("it can be packed");
            let mut record = crate::pack::unpack(&bytes).expect("it was packed");
            change(&mut record);
            !record.fits(&new, &network)
        };
        assert!(!changed(&|_| {}));
        assert!(changed(&|it| it.driving.styles.truncate(1)));
        assert!(changed(&|it| it.reasons.styles.swap(0, 1)));
        assert!(changed(&|it| it.roads.clear()));
        assert!(changed(&|it| it.places.entrances.clear()));
        assert!(changed(&|it| it.driving.styles[0].speeds = laneweave_study::Histogram::new(0.0, 0.0, 60)));
    }
}
