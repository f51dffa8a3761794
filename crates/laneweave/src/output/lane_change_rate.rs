//! The figure `lane_change_rate.svg`: lane changes per kilometre of lane and hour against density, over boxes of about
//! 500 m of road and a minute.

use std::path::{Path, PathBuf};

use laneweave_sim::{Event, Kind, World};
use laneweave_study::{EdieGrid, EdieRow, RateSeries, Window, rate_by_density, rate_density};

use super::road::Sections;
use super::{Observer, write_whole};
use crate::checkpoint::{pack, unpack};
use crate::fault::Fault;

/// Duration of a box [s].
const INTERVAL: f64 = 60.0;
/// Time between two looks at the traffic [s].
const SAMPLING: f64 = 1.0;
/// Width of a class of density [veh/km].
const BIN: f64 = 2.0;

/// Collects densities and lane changes.
pub(super) struct LaneChangeRate {
    path: PathBuf,
    sections: Sections,
    window: Window,
    grid: Option<EdieGrid>,
    /// Section, time and kind of each change.
    changes: Vec<(usize, f64, Kind)>,
}

impl LaneChangeRate {
    /// For the figure in `dir`, over `duration` [s] from the time `begin` [s] on.
    pub(super) fn new(dir: &Path, world: &World, begin: f64, duration: f64) -> LaneChangeRate {
        let sections = Sections::of(world.network());
        let intervals = ((duration / INTERVAL) as usize).max(1);
        let window = Window { from_s: begin, interval_s: INTERVAL.min(duration), intervals };
        // No section at all, or a duration of nothing, is a figure without points.
        let grid = EdieGrid::new(sections.lane_lengths.clone(), window).ok();
        let path = dir.join("lane_change_rate.svg");
        LaneChangeRate { path, sections, window, grid, changes: Vec::new() }
    }

    /// A curve of the changes that are `chosen`, from the boxes that were over by `end` [s].
    fn series(&self, name: &str, end: f64, chosen: impl Fn(Kind) -> bool) -> RateSeries {
        let mut grid = self.grid.clone();
        let complete = |row: &EdieRow| row.from_s + self.window.interval_s <= end + 1e-6;
        for (section, time, _) in self.changes.iter().filter(|(_, _, kind)| chosen(*kind)) {
            if let Some(grid) = &mut grid {
                grid.change(*section, *time);
            }
        }
        let points = grid.map_or(Vec::new(), |it| rate_by_density(it.rows().filter(complete), BIN));
        RateSeries { name: name.into(), points }
    }
}

impl Observer for LaneChangeRate {
    fn save(&mut self, _world: &World) -> Result<Vec<u8>, Fault> {
        pack(&(&self.grid, &self.changes))
    }

    fn restore(&mut self, saved: &[u8]) -> Result<(), Fault> {
        (self.grid, self.changes) = unpack(saved)?;
        Ok(())
    }

    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        for event in world.events() {
            if let Event::LaneChange(change) = event
                && change.is_completed
                && let Some(section) = self.sections.at(change.from.0, change.from.1)
            {
                self.changes.push((section, change.time, change.kind));
            }
        }
        let clock = world.clock();
        if let Some(grid) = &mut self.grid
            && clock.step.is_multiple_of(clock.steps(SAMPLING))
        {
            let duration = f64::from(clock.steps(SAMPLING)) * clock.dt;
            for vehicle in world.vehicles() {
                if let Some(section) = self.sections.at(vehicle.spot.chain, vehicle.x()) {
                    grid.add(section, clock.time() - duration, duration, vehicle.speed() * duration);
                }
            }
        }
        Ok(())
    }

    fn finish(self: Box<Self>, world: &World) -> Result<Vec<PathBuf>, Fault> {
        let end = world.clock().time();
        let all = self.series("all", end, |_| true);
        let discretionary = self.series("discretionary", end, |kind| kind == Kind::Discretionary);
        let svg = rate_density("Lane changes against density", &[all, discretionary]);
        write_whole(&self.path, &svg)?;
        Ok(vec![self.path])
    }
}
