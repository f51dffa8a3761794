//! Traffic in boxes of about 500 m of road and a minute, by Edie's definitions, with the lane changes in them.

use laneweave_network::ChainIndex;
use laneweave_sim::{Event, LaneChangeKind, World};
use laneweave_study::{EdieGrid, EdieRow, RatePoint, RateSeries, Window, rate_by_density};
use serde::{Deserialize, Serialize};

use super::road::Sections;

/// Duration of a box [s].
const INTERVAL: f64 = 60.0;
/// Time between two samples of the traffic [s].
const SAMPLING: f64 = 1.0;
/// Width of a class of density [veh/km].
const BIN: f64 = 2.0;

/// Collects densities, flows and lane changes.
#[derive(Debug, Serialize, Deserialize)]
pub struct Boxes {
    sections: Sections,
    window: Window,
    grid: Option<EdieGrid>,
    /// Section, time and kind of each change.
    changes: Vec<(usize, f64, LaneChangeKind)>,
}

impl Boxes {
    /// Collects over `duration` [s] from the time `begin` [s] on.
    pub fn new(world: &World, begin: f64, duration: f64) -> Boxes {
        let sections = Sections::of(world.network());
        let intervals = ((duration / INTERVAL) as usize).max(1);
        let window = Window { from_s: begin, interval_s: INTERVAL.min(duration), intervals };
        // Without a section, or with a duration of zero, the figure has no points.
        let grid = EdieGrid::new(sections.lane_lengths.clone(), window).ok();
        Boxes { sections, window, grid, changes: Vec::new() }
    }

    /// Whether it goes on from `new`, which has seen nothing: the same boxes.
    pub fn fits(&self, new: &Boxes) -> bool {
        let has_grid = match (&self.grid, &new.grid) {
            (Some(grid), Some(new)) => grid.fits(new),
            (None, None) => true,
            _ => false,
        };
        let sections = self.sections.lane_lengths.len();
        has_grid
            && (&self.sections, self.window) == (&new.sections, new.window)
            && self.changes.iter().all(|(section, ..)| *section < sections)
    }

    /// Observes the world after a step.
    pub fn observe(&mut self, world: &World) {
        for event in world.events() {
            if let Event::LaneChange(change) = event
                && change.is_completed
                && let Some(section) = self.sections.at(change.from.chain, change.from.x)
            {
                self.changes.push((section, change.time, change.kind));
            }
        }
        let clock = world.clock();
        if let Some(grid) = &mut self.grid
            && clock.step.is_multiple_of(clock.steps(SAMPLING))
        {
            let duration = f64::from(clock.steps(SAMPLING)) * clock.dt;
            let before = clock.time() - duration;
            let scene = world.scene();
            for (chain, lane) in (0..).map(ChainIndex).zip(scene.lanes) {
                let entries = lane.motions().iter().zip(lane.drivers());
                let mut vehicles = entries.filter(|(_, car)| !car.is_shadow).map(|(it, _)| it).peekable();
                // Vehicles are in driving order: those in one section follow each other.
                while let Some(first) = vehicles.peek() {
                    let (section, end) = self.sections.span(chain, first.x);
                    let (mut number, mut speeds) = (0, 0.0);
                    while let Some(vehicle) = vehicles.next_if(|it| it.x < end) {
                        number += 1;
                        speeds += vehicle.speed;
                    }
                    if let Some(section) = section {
                        grid.add_all(section, before, duration, number, speeds * duration);
                    }
                }
            }
        }
    }

    /// The boxes that were complete at `end` [s].
    pub fn rows(&self, end: f64) -> impl Iterator<Item = EdieRow> + '_ {
        self.grid.iter().flat_map(move |it| complete(it, self.window, end))
    }

    /// Mean speed limit in a section [m/s].
    pub fn limit(&self, section: usize) -> f64 {
        self.sections.limits[section]
    }

    /// The boxes that were complete at `end` [s], with the changes that are `chosen`.
    pub fn with_changes(&self, end: f64, chosen: impl Fn(LaneChangeKind) -> bool) -> Vec<EdieRow> {
        let Some(mut grid) = self.grid.clone() else { return Vec::new() };
        for (section, time, _) in self.changes.iter().filter(|(_, _, kind)| chosen(*kind)) {
            grid.change(*section, *time);
        }
        complete(&grid, self.window, end).collect()
    }

    /// A curve of the changes that are `chosen`, from the boxes that were complete at `end` [s].
    pub fn series(&self, name: &str, end: f64, chosen: impl Fn(LaneChangeKind) -> bool) -> RateSeries {
        RateSeries { name: name.into(), points: Boxes::pooled(self.with_changes(end, chosen)) }
    }

    /// Boxes of similar density, pooled.
    pub fn pooled(rows: impl IntoIterator<Item = EdieRow>) -> Vec<RatePoint> {
        rate_by_density(rows, BIN)
    }
}

fn complete(grid: &EdieGrid, window: Window, end: f64) -> impl Iterator<Item = EdieRow> + '_ {
    grid.rows().filter(move |row| row.from_s + window.interval_s <= end + 1e-6)
}
