//! Numbers on the command line.

use std::num::NonZero;

/// A number, with or without a fraction.
///
/// # Errors
/// How to write one.
pub(super) fn number(text: &str) -> Result<f64, String> {
    let parsed = text.parse();
    parsed.map_err(|_| "write a plain number, such as 600 or 0.5, without unit, % or separators".into())
}

/// The id of a lanelet.
///
/// # Errors
/// How to find one.
pub(super) fn id(text: &str) -> Result<i64, String> {
    text.parse().map_err(|_| "an id is a whole number; laneweave check MAP --svg FILE shows them".into())
}

/// A seed.
///
/// # Errors
/// How to write one.
pub(super) fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("choose a whole number, 0 to {}", u64::MAX))
}

/// A number of threads.
///
/// # Errors
/// How to write one.
pub(super) fn threads(text: &str) -> Result<NonZero<usize>, String> {
    text.parse().map_err(|_| "choose 1 to 256, or leave it out".into())
}
