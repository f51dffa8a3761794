//! The `laneweave` command as a user meets it. Marked as tests, modules and all, so that their helpers may unwrap.

#[cfg(test)]
mod check;
#[cfg(test)]
mod generate;
#[cfg(test)]
mod golden;
#[cfg(test)]
mod mistakes;
#[cfg(test)]
mod program;
#[cfg(test)]
mod report;
mod run;
#[cfg(test)]
mod schema;
mod signals;
#[cfg(test)]
mod styles;
