//! Refused commands, as faults with a place and a remedy.

use std::fmt::Display;

use laneweave_sim::CommandError;

use crate::fault::{Fault, FaultKind};

/// The fault of a command that was refused at `place`.
pub fn refused(place: impl Display, error: &CommandError) -> Fault {
    let text = error.to_string();
    let parts = text.rsplit_once("; ").or_else(|| text.rsplit_once(": "));
    let (what, remedy) = parts.unwrap_or((&text, "simulate a step, and ask which vehicles there are"));
    let fault = match remedy.strip_prefix("this world has no") {
        Some(rest) => Fault::new(place, what, format!("leave this command out: the map has no{rest}")),
        None => Fault::new(place, what, remedy),
    };
    let is_missing = matches!(error, CommandError::Unknown { .. } | CommandError::NoVehicle(_));
    fault.of_kind(if is_missing { FaultKind::NotFound } else { FaultKind::Command })
}
