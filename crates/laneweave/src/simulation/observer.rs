//! Observers of a simulation.

use laneweave_scenario::Fault;

use super::{Event, Simulation};

/// An observer of a simulation. A closure with these two arguments is one, too.
///
/// What writes result files is an [`Output`](crate::output::Output).
pub trait Observer<E = Fault> {
    /// Sees the simulation after a step, and what happened in the step.
    ///
    /// # Errors
    /// If it cannot go on. The run then ends with this error.
    fn observe(&mut self, simulation: &Simulation, events: &[Event]) -> Result<(), E>;
}

impl<E, F: FnMut(&Simulation, &[Event]) -> Result<(), E>> Observer<E> for F {
    fn observe(&mut self, simulation: &Simulation, events: &[Event]) -> Result<(), E> {
        self(simulation, events)
    }
}
