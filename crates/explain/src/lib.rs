//! Why a driver changed lanes, waited, or stayed. Nothing is logged for it: the run is repeated, and the driver asked.

mod commonest;
mod flip;
mod standing;
mod trip;
mod words;

pub use commonest::Commonest;
pub use flip::{Flip, Knob, flips};
pub use trip::{Moment, moment, trip};
pub use words::{act, reason, story};
