//! The report `report.html`: what a run was and what came of it, on one page; and two of its figures as files of their
//! own, `lane_change_rate.svg` and `time_space.svg`.

use std::path::PathBuf;

use laneweave_scenario::Fault;
use laneweave_scenario::scenario::{Prepared, Scenario};
use laneweave_sim::{Event, Incident, Kind, World};
use laneweave_study::{Mark, Sample, Sheet, rate_density, time_space};
use serde::{Deserialize, Serialize};

use super::boxes::Boxes;
use super::driving::Driving;
use super::reasons::Reasons;
use super::summary::Summary;
use super::traces::Traces;
use super::trip_times::{Crowd, TripTimes};
use super::{Folder, Observer, Provenance, write_whole};
use crate::checkpoint::{pack, unpack};
use crate::report::{About, RunReport};

/// Lanes of which there are time–space diagrams.
const ROADS: usize = 2;
/// Incidents that are listed.
const INCIDENTS: usize = 10;

/// Collects what the report of a run shows.
pub(super) struct Report {
    path: PathBuf,
    rate: PathBuf,
    time_space: PathBuf,
    about: About,
    provenance: Provenance,
    record: Record,
}

/// What is kept of a run for its report.
#[derive(Debug, Serialize, Deserialize)]
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
    /// The first incidents.
    pub incidents: Vec<Incident>,
}

impl Report {
    /// For the report in `folder`.
    pub(super) fn new(folder: &Folder, scenario: &Scenario, prepared: &Prepared) -> Report {
        let Prepared { world, origins, warmup_steps, steps, .. } = prepared;
        let [begin, duration] = [*warmup_steps, *steps].map(|it| f64::from(it) * scenario.run.step_s);
        let record = Record {
            boxes: Boxes::new(world, begin, duration),
            roads: Traces::most_driven(ROADS, world, origins, begin, duration),
            driving: Driving::of(world),
            reasons: Reasons::new(world, begin),
            trips: TripTimes::of(world),
            crowd: Crowd::default(),
            incidents: Vec::new(),
        };
        Report {
            path: folder.file("report.html"),
            rate: folder.file("lane_change_rate.svg"),
            time_space: folder.file("time_space.svg"),
            about: About::of(scenario, prepared),
            provenance: folder.provenance.clone(),
            record,
        }
    }
}

impl Observer for Report {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        let Record { boxes, roads, driving, reasons, trips, crowd, incidents } = &mut self.record;
        boxes.observe(world);
        roads.iter_mut().for_each(|it| it.observe(world));
        driving.observe(world);
        reasons.observe(world);
        trips.observe(world);
        crowd.observe(world);
        let seen = world.events().iter().filter_map(|it| match it {
            Event::Incident(incident) => Some(*incident),
            _ => None,
        });
        incidents.extend(seen.take(INCIDENTS - incidents.len()));
        Ok(())
    }

    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        pack(&self.record)
    }

    fn restore(&mut self, saved: &[u8]) -> Result<(), Fault> {
        self.record = unpack(saved)?;
        Ok(())
    }

    fn finish(self: Box<Self>, world: &World, summary: &Summary) -> Result<Vec<PathBuf>, Fault> {
        let Report { path, rate, time_space, about, provenance, record } = *self;
        let end = world.clock().time();
        let (about, provenance, record, network) = (&about, &provenance, &record, world.network());
        let report = RunReport { about, provenance, summary, record, network, end };
        write_whole(&path, &report.page().to_html())?;
        write_whole(&rate, &record.rate_figure(end))?;
        write_whole(&time_space, &record.time_space_figure())?;
        Ok(vec![path, rate, time_space])
    }
}

impl Record {
    /// Lane changes against density, of the boxes that were over by `end` [s].
    fn rate_figure(&self, end: f64) -> String {
        let all = self.boxes.series("all", end, |_| true);
        let discretionary = self.boxes.series("discretionary", end, |kind| kind == Kind::Discretionary);
        rate_density(Sheet::Page, "Lane changes against density", &[all, discretionary])
    }

    /// Time and space on the lane on which most way is driven.
    fn time_space_figure(&self) -> String {
        let traces = self.roads.first();
        let all: Vec<&[Sample]> = traces.iter().flat_map(|it| it.trajectories()).collect();
        let changes: &[Mark] = traces.map_or(&[], |it| &it.changes);
        let title = match traces {
            Some(it) => format!("The lane from lanelet {} on", it.lanelet),
            None => "Nobody comes from anywhere".into(),
        };
        time_space(Sheet::Page, &title, &all, changes)
    }
}
