//! Why a driver changed lanes, waited, or stayed. Nothing is logged for it: the run is repeated, and the driver asked.

mod flip;
mod words;

pub use flip::{Flip, Knob, flips};
pub use words::{act, story};
