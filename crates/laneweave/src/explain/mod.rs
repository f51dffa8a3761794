//! Explanations: why a driver changed lanes, waited, or stayed. They need no log: the run is repeated, and the driver
//! is asked.

mod commonest;
mod flip;
mod standing;
mod trip;
mod words;

pub use commonest::Commonest;
pub use flip::{Flip, Knob, flips};
pub(crate) use trip::now;
pub use trip::{Moment, moment, trip};
pub use words::{act, reason, story};
