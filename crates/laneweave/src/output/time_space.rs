//! The figure `time_space.svg`: the vehicles of one lane, from the slow side of the busiest entrance on.

use std::path::{Path, PathBuf};

use laneweave_sim::{Place, World};
use laneweave_study::{Sample, Sheet, time_space};

use super::traces::Traces;
use super::{Observer, write_whole};
use crate::fault::Fault;

/// Collects the vehicles of one lane.
pub struct TimeSpace {
    path: PathBuf,
    /// None where nobody comes from anywhere.
    traces: Option<Traces>,
}

impl TimeSpace {
    /// For the figure in `dir`, over at most `duration` [s] from the time `begin` [s] on; `origins`, each with its
    /// demand [veh/h], tell the busiest entrance.
    pub fn new(dir: &Path, world: &World, origins: &[(Place, f64)], begin: f64, duration: f64) -> TimeSpace {
        let traces = Traces::busiest(world, origins, begin, duration);
        TimeSpace { path: dir.join("time_space.svg"), traces }
    }
}

impl Observer for TimeSpace {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        if let Some(traces) = &mut self.traces {
            traces.observe(world);
        }
        Ok(())
    }

    fn finish(self: Box<Self>, _world: &World) -> Result<PathBuf, Fault> {
        let all: Vec<Vec<Sample>> = self.traces.iter().flat_map(|it| it.trajectories().cloned()).collect();
        let changes = self.traces.as_ref().map_or(&[][..], |it| &it.changes);
        let lanelet = self.traces.as_ref().map_or(0, |it| it.lanelet);
        let title = format!("The lane from lanelet {lanelet} on");
        write_whole(&self.path, &time_space(Sheet::Page, &title, &all, changes))?;
        Ok(self.path)
    }
}
