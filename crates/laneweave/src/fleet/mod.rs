//! Many simulations of one template, stepped together: for programs that learn, or that try many seeds.

use std::io;

use laneweave_pool::Pool;
use laneweave_scenario::{Fault, FaultKind};
use laneweave_sim::{Control, Rows, VehicleId};

use crate::simulation::{Simulation, Template};

mod sight;

pub use sight::SIGHT_COLUMNS;

/// Many simulations of one template, each with a seed of its own. One pool of threads steps them all; what they do does
/// not depend on its number of threads.
pub struct Fleet {
    simulations: Vec<Simulation>,
    /// The numbers of all simulations.
    all: Vec<u32>,
    pool: Pool,
}

impl Fleet {
    /// The largest number of threads, as of a simulation.
    pub const MOST_THREADS: usize = 256;

    /// A simulation of `template` for each of these seeds, on `threads` threads in all.
    ///
    /// # Errors
    /// If there are no seeds or no threads, or the system does not start so many threads.
    pub fn new(
        template: &Template,
        seeds: impl IntoIterator<Item = u64>,
        threads: usize,
    ) -> Result<Fleet, Fault> {
        let simulations: Vec<Simulation> =
            seeds.into_iter().map(|it| template.spawn_on(it, 1)).collect::<Result<_, _>>()?;
        if simulations.is_empty() {
            return Err(Fault::new("fleet", "no seeds", "give one for each simulation"));
        }
        if !(1..=Fleet::MOST_THREADS).contains(&threads) {
            return Err(Fault::new("fleet", format!("{threads} threads"), "choose 1 to 256"));
        }
        let unstarted = |error: io::Error| {
            let what = format!("the system does not start {threads} threads: {error}");
            Fault::new("fleet", what, "choose fewer, or close other programs")
        };
        let pool = Pool::new(threads).map_err(unstarted)?;
        Ok(Fleet { all: (0..simulations.len() as u32).collect(), simulations, pool })
    }

    /// Number of simulations.
    pub fn len(&self) -> usize {
        self.simulations.len()
    }

    /// Whether there is no simulation: there always is one.
    pub fn is_empty(&self) -> bool {
        self.simulations.is_empty()
    }

    /// All simulations, in the order of their seeds.
    pub fn simulations(&self) -> &[Simulation] {
        &self.simulations
    }

    /// One of the simulations.
    ///
    /// # Errors
    /// If there are not so many.
    pub fn simulation(&mut self, number: usize) -> Result<&mut Simulation, Fault> {
        let count = self.len();
        self.simulations.get_mut(number).ok_or_else(|| unknown(number, count))
    }

    /// Simulates so many steps of each.
    pub fn step(&mut self, steps: u32) {
        let Fleet { simulations, all, pool } = self;
        let mut nothing = vec![(); simulations.len().max(pool.threads())];
        let mut plans = vec![(); simulations.len()];
        let advance =
            |it: &mut Simulation, (): &mut (), _, (): &mut ()| (0..steps).for_each(|_| it.advance());
        pool.look_then_act(&mut nothing, simulations, &mut plans, all, |_, (), _, ()| (), advance);
    }

    /// Lets one of the simulations begin anew with this seed.
    ///
    /// # Errors
    /// If there are not so many simulations.
    pub fn reset(&mut self, number: usize, seed: u64) -> Result<(), Fault> {
        self.simulation(number)?.reset(seed)
    }

    /// Drives vehicles, each in the simulation of this number, until their next controls.
    ///
    /// # Errors
    /// If there is no such simulation, or a vehicle cannot be driven so; those before it in the list are driven.
    pub fn control(&mut self, controls: &[(usize, VehicleId, Control)]) -> Result<(), Fault> {
        controls.iter().try_for_each(|&(number, id, control)| {
            let simulation = self.simulation(number)?;
            simulation
                .control(id, control)
                .map_err(|it| Fault { place: format!("simulation {number}: {}", it.place), ..it })
        })
    }

    /// Fills `rows` with the vehicles of all simulations, one simulation after the other, and `counts` with how many
    /// each has. Returns how many there are.
    ///
    /// # Errors
    /// If `counts` has not one place for each simulation, or there are more vehicles than rows in a column. Columns of
    /// poses may be empty.
    pub fn columns(&self, mut rows: Rows, counts: &mut [u32]) -> Result<usize, Fault> {
        check_length("counts", counts.len(), self.len())?;
        let total: usize = self.simulations.iter().map(Simulation::on_road).sum();
        check_rows(&rows, total)?;
        for (simulation, count) in self.simulations.iter().zip(counts) {
            *count = simulation.on_road() as u32;
            simulation.fill(&mut rows);
        }
        Ok(total)
    }
}

fn unknown(number: usize, count: usize) -> Fault {
    let what = format!("there is no simulation {number}");
    Fault::new("fleet", what, format!("choose 0 to {}", count - 1)).of_kind(FaultKind::State)
}

/// Checks that a slice of the caller has the length that is needed.
fn check_length(name: &str, found: usize, needed: usize) -> Result<(), Fault> {
    if found == needed {
        return Ok(());
    }
    Err(Fault::new("fleet", format!("{name} has {found} places"), format!("give it {needed}")))
}

/// Checks that each column that is wanted has a row for each vehicle.
fn check_rows(rows: &Rows, needed: usize) -> Result<(), Fault> {
    let Rows { id, lanelet, position_m, speed_mps, acceleration_mps2, x_m, y_m, z_m, heading_rad } = rows;
    let basic = [id.len(), lanelet.len(), position_m.len(), speed_mps.len(), acceleration_mps2.len()];
    let poses = [x_m.len(), y_m.len(), z_m.len(), heading_rad.len()];
    let wanted = if poses == [0; 4] { &[][..] } else { &poses };
    match basic.iter().chain(wanted).min() {
        Some(&least) if least < needed => {
            let what = format!("{needed} vehicles, and {least} rows in a column");
            Err(Fault::new("fleet", what, format!("give each column {needed} rows or more")))
        }
        _ => Ok(()),
    }
}
