//! Junctions: who may pass the conflict zones ahead, and in which order.
//!
//! A driver passes a zone only with a *passage*: the right, given once, to drive through all zones up to the next place
//! where its vehicle can stand without being in anybody's way, and only if there is room for it there. Of those who were
//! given passages through one zone the earlier goes first: over a crossing the later waits until the earlier is out of
//! it, into a merge it follows. Passages are given one after the other, so the order is the same in all zones and
//! somebody can always go on: no standoff within a junction.
//!
//! Who gives way to whom before that is up to drivers: lights and signs, the lag to those who go first
//! (`laneweave_models::yielding`), then who waits longest; nobody need wait for who could not go yet anyway.

mod applicant;
mod conditions;
mod heed;
mod mergers;
mod oncoming;
mod passages;
mod refuge;
mod rings;
mod room;
mod survey;
mod turns;

pub(crate) use applicant::Applicant;
pub(crate) use conditions::{Asking, Hindrance, leader_of, may_pass};
pub use heed::STOPS_AT_YELLOW;
pub(crate) use heed::{Junction, earlier, is_nothing_near, lets_go, look, sight};
pub(crate) use mergers::are_led_on;
pub use passages::Passages;
pub(crate) use passages::{Claim, Hold, NO_PASSAGE, Passage};
pub(crate) use refuge::Refuge;
pub(crate) use survey::{SPARE_ROOM, Survey, is_place_ahead, refuges, stands_beyond, stop_ahead, survey};
pub use survey::{STANDS_BEFORE_A_LINE, STANDS_BEFORE_A_ZONE};
pub(crate) use turns::{Turn, turns};
