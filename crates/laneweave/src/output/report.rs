//! The report `report.html`: what a run was and what came of it, on one page.

use std::path::{Path, PathBuf};

use laneweave_sim::World;

use super::boxes::Boxes;
use super::driving::Driving;
use super::reasons::Reasons;
use super::summary::Summary;
use super::traces::Traces;
use super::trip_times::{Crowd, TripTimes};
use super::{Observer, write_whole};
use crate::fault::Fault;
use crate::report::{About, RunReport};
use crate::scenario::{Prepared, Scenario};

/// Lanes of which there are time–space diagrams.
const ROADS: usize = 2;

/// Collects what the report of a run shows.
pub struct Report {
    path: PathBuf,
    about: About,
    record: Record,
    summary: Option<Summary>,
}

/// What is kept of a run for its report.
#[derive(Debug)]
pub struct Record {
    /// Density, flow, speed and lane changes in boxes.
    pub boxes: Boxes,
    /// The lanes on which most way is driven.
    pub roads: Vec<Traces>,
    /// How drivers follow.
    pub driving: Driving,
    /// Why they changed lanes.
    pub reasons: Reasons,
    /// Times of trips.
    pub trips: TripTimes,
    /// Vehicles in the course of time.
    pub crowd: Crowd,
}

impl Report {
    /// For the report in `dir`.
    pub fn new(dir: &Path, scenario: &Scenario, prepared: &Prepared) -> Report {
        let Prepared { world, origins, warmup_steps, steps, .. } = prepared;
        let [begin, duration] = [*warmup_steps, *steps].map(|it| f64::from(it) * scenario.run.step_s);
        let record = Record {
            boxes: Boxes::new(world, begin, duration),
            roads: Traces::most_driven(ROADS, world, origins, begin, duration),
            driving: Driving::of(world),
            reasons: Reasons::new(world, begin),
            trips: TripTimes::of(world),
            crowd: Crowd::default(),
        };
        let about = About::of(scenario, prepared);
        Report { path: dir.join("report.html"), about, record, summary: None }
    }
}

impl Observer for Report {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        let Record { boxes, roads, driving, reasons, trips, crowd } = &mut self.record;
        boxes.observe(world);
        roads.iter_mut().for_each(|it| it.observe(world));
        driving.observe(world);
        reasons.observe(world);
        trips.observe(world);
        crowd.observe(world);
        Ok(())
    }

    fn conclude(&mut self, summary: &Summary) {
        self.summary = Some(summary.clone());
    }

    fn finish(self: Box<Self>, world: &World) -> Result<PathBuf, Fault> {
        let Report { path, about, record, summary } = &*self;
        let end = world.clock().time();
        let report = RunReport { about, summary: summary.as_ref(), record, end };
        write_whole(path, &report.page().to_html())?;
        Ok(self.path)
    }
}
