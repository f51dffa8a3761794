//! How vehicles are driven.

use laneweave::{Control, Fault, FaultKind, Lateral, Longitudinal, Side};

use crate::errors::Failure;

/// A control from what a program gives: at most one of the three, and a word for the lateral part.
///
/// # Errors
/// If more than one of the three is given, or the word is unknown.
pub(crate) fn control(
    speed_mps: Option<f64>,
    acceleration_mps2: Option<f64>,
    most_mps: Option<f64>,
    lateral: &str,
) -> Result<Control, Failure> {
    let refused =
        |what: String, remedy: &str| Fault::new("control", what, remedy).of_kind(FaultKind::Command);
    let longitudinal = match (speed_mps, acceleration_mps2, most_mps) {
        (None, None, None) => Longitudinal::Driver,
        (Some(speed), None, None) => Longitudinal::Speed(speed),
        (None, Some(acceleration), None) => Longitudinal::Acceleration(acceleration),
        (None, None, Some(most)) => Longitudinal::AtMost(most),
        _ => {
            let what = "more than one of speed_mps, acceleration_mps2 and most_mps".to_owned();
            return Err(refused(what, "give one of them, or none: then its driver decides").into());
        }
    };
    let lateral = match lateral {
        "driver" => Lateral::Driver,
        "keep" => Lateral::Keep,
        "left" => Lateral::Change(Side::Left),
        "right" => Lateral::Change(Side::Right),
        other => {
            let what = format!("lateral={other:?}");
            return Err(refused(what, "choose \"driver\", \"keep\", \"left\" or \"right\"").into());
        }
    };
    Ok(Control::Drive { longitudinal, lateral })
}
