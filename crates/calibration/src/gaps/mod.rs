//! Which gaps drivers accept: the critical gaps to the new leader and to the new follower.
//!
//! A driver has one critical gap of each kind, and accepts what is not shorter. Over the drivers both are lognormal
//! (Toledo 2003). A driver who changes shows that its critical gap is at most the gap that it took. How long it had
//! wanted the change before is not seen; so of the gaps that it let pass only that is known which the process free →
//! wants → changes says: with the chance that it wanted it then, they were shorter than its critical gap. With a known
//! begin of the wish this is the likelihood of Troutbeck (1992): the critical gap lies between the largest refused and
//! the accepted gap. Drivers who never change count, too: those with large critical gaps change less often.
//!
//! `offered.rs` has what gaps drivers were offered, look by look; `table.rs` has the likelihood of each driver for
//! critical gaps on a grid; `problem.rs` and `fit.rs` find the distribution of the critical gaps, and `score.rs` says
//! how well it predicts drivers who were not seen.

mod fit;
mod offered;
mod problem;
mod score;
mod table;
#[cfg(test)]
mod tests;

pub use fit::{CriticalGap, GapFit, GapsNotFitted, SpreadOfGaps, Wishes};
pub use offered::{Offered, OfferedGaps};
pub use score::GapScore;
