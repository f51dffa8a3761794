//! The Python package `laneweave`: thin bindings of the library, in files by topic.
//!
//! * `errors.rs` faults become exceptions, and so do panics
//! * `keys.rs` keyword arguments become a scenario
//! * `simulation.rs`, `template.rs` and `fleet.rs` the classes
//! * `columns.rs` vehicles as arrays, `control.rs` how vehicles are driven
//! * `map.rs`, `style.rs` and `view.rs` maps, styles, and the page in the browser
//! * `task.rs` long work, which shows its progress and can be interrupted
//! * `run.rs` and `studies.rs` runs, comparisons, fits and replays, with all their files
//! * `sweep.rs` many variants of a scenario, on any executor
//! * `learning.rs` many worlds in which a program learns
//! * `command.rs` the command `laneweave`
//! * `values.rs` values between the two languages

mod columns;
mod command;
mod control;
mod errors;
mod fleet;
mod id;
mod keys;
mod learning;
mod map;
mod run;
mod simulation;
mod studies;
mod style;
mod sweep;
mod task;
mod template;
mod values;
mod view;

use pyo3::prelude::*;

/// The compiled part of the package.
#[pymodule]
fn _laneweave(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("SIGHT_COLUMNS", laneweave::SIGHT_COLUMNS)?;
    module.add_class::<simulation::Simulation>()?;
    module.add_class::<template::Template>()?;
    module.add_class::<fleet::Fleet>()?;
    module.add_class::<learning::Batch>()?;
    module.add_class::<sweep::SweepFolder>()?;
    module.add_class::<sweep::SweepWorker>()?;
    module.add_class::<map::Map>()?;
    module.add_class::<view::View>()?;
    module.add_function(wrap_pyfunction!(run::run, module)?)?;
    module.add_function(wrap_pyfunction!(studies::compare_models, module)?)?;
    module.add_function(wrap_pyfunction!(studies::fit_styles, module)?)?;
    module.add_function(wrap_pyfunction!(studies::replay_recordings, module)?)?;
    module.add_function(wrap_pyfunction!(style::style_text, module)?)?;
    module.add_function(wrap_pyfunction!(style::new_style, module)?)?;
    module.add_function(wrap_pyfunction!(style::style_of, module)?)?;
    module.add_function(wrap_pyfunction!(view::view_files, module)?)?;
    module.add_function(wrap_pyfunction!(command::command, module)?)?;
    Ok(())
}
