//! The figure `lane_change_rate.svg`: lane changes per kilometre of lane and hour against density, over boxes of about
//! 500 m of road and a minute.

use std::path::{Path, PathBuf};

use laneweave_sim::{Kind, World};
use laneweave_study::{Sheet, rate_density};

use super::boxes::Boxes;
use super::{Observer, write_whole};
use crate::fault::Fault;

/// Collects densities and lane changes.
pub struct LaneChangeRate {
    path: PathBuf,
    boxes: Boxes,
}

impl LaneChangeRate {
    /// For the figure in `dir`, over `duration` [s] from the time `begin` [s] on.
    pub fn new(dir: &Path, world: &World, begin: f64, duration: f64) -> LaneChangeRate {
        LaneChangeRate { path: dir.join("lane_change_rate.svg"), boxes: Boxes::new(world, begin, duration) }
    }
}

impl Observer for LaneChangeRate {
    fn observe(&mut self, world: &World) -> Result<(), Fault> {
        self.boxes.observe(world);
        Ok(())
    }

    fn finish(self: Box<Self>, world: &World) -> Result<PathBuf, Fault> {
        let end = world.clock().time();
        let all = self.boxes.series("all", end, |_| true);
        let discretionary = self.boxes.series("discretionary", end, |kind| kind == Kind::Discretionary);
        let svg = rate_density(Sheet::Page, "Lane changes against density", &[all, discretionary]);
        write_whole(&self.path, &svg)?;
        Ok(self.path)
    }
}
