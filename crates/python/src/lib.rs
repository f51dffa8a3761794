//! The Python package `laneweave`: thin bindings of the library, in files by topic.
//!
//! * `errors.rs` faults become exceptions, and so do panics
//! * `keys.rs` keyword arguments become a scenario
//! * `simulation.rs`, `template.rs` and `fleet.rs` the classes
//! * `control.rs` how vehicles are driven
//! * `run.rs` a run with all its result files
//! * `values.rs` values between the two languages

mod control;
mod errors;
mod fleet;
mod keys;
mod run;
mod simulation;
mod template;
mod values;

use pyo3::prelude::*;

/// The compiled part of the package.
#[pymodule]
fn _laneweave(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("SIGHT_COLUMNS", laneweave::SIGHT_COLUMNS)?;
    module.add_class::<simulation::Simulation>()?;
    module.add_class::<template::Template>()?;
    module.add_class::<fleet::Fleet>()?;
    module.add_function(wrap_pyfunction!(run::run, module)?)?;
    Ok(())
}
