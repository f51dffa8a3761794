//! The paper as code: pure functions on plain data. No clock, no random numbers, no world, no files.
//!
//! Li, Sun, Zhan and Tomizuka, *Multiple criteria decision-making for lane-change model*. Its Table I is
//! [`change`]: the columns are [`change::Outcomes`], the rows one file each. Where the paper's formula misses
//! its own intent, both readings exist: [`Reading::Literal`] and [`Reading::Repaired`], chosen by a style.

mod attention;
pub mod bends;
pub mod braking;
pub mod change;
pub mod comfortable;
mod exponential;
pub mod follow;
mod guidance;
pub mod lateral;
mod misperception;
mod parameter;
mod style;
pub mod yielding;

pub use attention::{Alertness, Attention, Concentration};
pub use exponential::exp;
pub use guidance::Guidance;
pub use misperception::Misperception;
pub use parameter::{Parameter, Range};
pub use style::{Manner, Style};

use serde::{Deserialize, Serialize};

/// Which of two readings of a formula of the paper a style uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Reading {
    /// As printed, with the smallest guard that keeps it finite.
    Literal,
    /// The same form, corrected where the paper's own text says that the formula misses its intent.
    #[default]
    Repaired,
}
