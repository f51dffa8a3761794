//! A scenario that was prepared once, for many worlds with different seeds.

use std::sync::Arc;

use laneweave_sim::{Template as Worlds, WorldError};

use super::{Conditions, Prepared};
use crate::script::Script;

/// A scenario that was prepared once. What it prepares from now on shares its map, routes, drivers, demand and
/// conditions; only the random numbers differ.
pub struct Template {
    worlds: Worlds,
    script: Script,
    conditions: Arc<Conditions>,
}

impl From<Prepared> for Template {
    /// A template of what is `prepared`.
    fn from(prepared: Prepared) -> Template {
        let Prepared { world, script, conditions, threads: _ } = prepared;
        Template { worlds: world.into(), script, conditions }
    }
}

impl Template {
    /// The same scenario with this `seed`, on so many `threads`. It goes on from where the template is.
    ///
    /// # Errors
    /// If the system does not start so many threads.
    pub fn spawn(&self, seed: u64, threads: usize) -> Result<Prepared, WorldError> {
        let world = self.worlds.spawn(seed, threads)?;
        let (script, conditions) = (self.script(seed), Arc::clone(&self.conditions));
        Ok(Prepared { world, script, conditions, threads })
    }

    /// Makes `prepared`, which this template has spawned, what it spawns with this `seed`.
    pub fn reset(&self, prepared: &mut Prepared, seed: u64) {
        prepared.world.reset(&self.worlds, seed);
        prepared.script = self.script(seed);
    }

    fn script(&self, seed: u64) -> Script {
        let is_at_start = self.worlds.start().clock().step == 0;
        if is_at_start { self.script.restarted(seed) } else { self.script.clone() }
    }
}
