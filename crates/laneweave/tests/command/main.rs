//! The `laneweave` command as a user meets it.

mod generate;
mod golden;
mod mistakes;
mod program;
mod run;
mod schema;
mod styles;
