//! Numbers on the command line.

use std::fmt::Display;
use std::num::NonZero;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// A number, with or without a fraction.
///
/// # Errors
/// How to write one.
pub(super) fn number(text: &str) -> Result<f64, String> {
    let parsed = text.parse();
    parsed.map_err(|_| "write a plain number, such as 600 or 0.5, without unit, % or separators".into())
}

/// A whole number that is not negative. What it stands for checks its limits.
///
/// # Errors
/// How to write one.
pub(super) fn whole<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| "write a whole number, such as 3".into())
}

/// A reader of whole numbers within `limits`.
pub(super) fn within<T>(limits: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: FromStr + PartialOrd + Display + Clone,
{
    move |text| {
        let read = text.parse().ok().filter(|it| limits.contains(it));
        read.ok_or_else(|| format!("choose a whole number, {} to {}", limits.start(), limits.end()))
    }
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
