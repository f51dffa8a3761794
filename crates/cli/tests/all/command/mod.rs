//! The `laneweave` command as a user meets it. Marked as tests, modules and all, so that their helpers may unwrap.

#[cfg(test)]
mod book;
#[cfg(test)]
mod branch;
#[cfg(test)]
mod check;
#[cfg(test)]
mod compare;
#[cfg(test)]
mod demand;
#[cfg(test)]
mod explain;
#[cfg(test)]
mod far_away;
mod fit;
#[cfg(test)]
mod gates;
#[cfg(test)]
mod generate;
#[cfg(test)]
mod golden;
#[cfg(test)]
mod help;
#[cfg(test)]
#[cfg(target_os = "linux")]
mod limits;
#[cfg(test)]
mod mistakes;
#[cfg(test)]
mod numbers;
#[cfg(test)]
mod program;
#[cfg(test)]
mod recordings;
#[cfg(test)]
mod remarks;
#[cfg(test)]
mod replay;
#[cfg(test)]
mod report;
mod reproduce;
#[cfg(test)]
mod results;
#[cfg(test)]
mod resume;
#[cfg(test)]
mod run;
#[cfg(test)]
mod scenario;
#[cfg(test)]
mod schema;
#[cfg(test)]
mod settings;
#[cfg(test)]
mod shell;
#[cfg(test)]
mod signals;
#[cfg(test)]
mod standard_output;
#[cfg(test)]
#[cfg(unix)]
mod stop;
#[cfg(test)]
mod styles;
#[cfg(test)]
mod sumo;
#[cfg(test)]
mod sweep;
mod view;
