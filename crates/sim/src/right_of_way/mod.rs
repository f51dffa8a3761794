//! Right of way: which drivers may pass the conflict zones ahead, and in which order.
//!
//! A vehicle passes a zone only with a *reservation*. A reservation is the right to drive through all zones up to the
//! next place where the vehicle can stand without blocking others. It is granted only if there is storage space at
//! that place. Reservations through one zone are ordered as they were granted. At a crossing the later vehicle waits
//! until the earlier one has left the zone; into a merge it follows the earlier one. Reservations are granted one
//! after the other, so the order is the same in all zones. Therefore some vehicle can always go on, and there is no
//! deadlock within a junction.
//!
//! Drivers decide who goes first before that (`may_pass.rs`; which movement has priority at all is settled once for a
//! network, in `junction/precedence.rs` of `laneweave_network`): by lights and signs, by the lag to vehicles with
//! priority (`laneweave_models::yielding`), then by waiting time. No driver has to wait for a driver who could not go
//! yet.
//!
//! * `survey.rs` what lies ahead; `applicant.rs` who asks; `may_pass.rs` whether it may pass
//! * `oncoming.rs`, `mergers.rs`, `turns.rs` and `storage_space.rs` the conditions, one by one
//! * `approach.rs` what a driver reacts to while it drives on

pub(crate) mod applicant;
pub(crate) mod approach;
pub(crate) mod may_pass;
pub(crate) mod mergers;
pub(crate) mod oncoming;
pub(crate) mod storage_space;
pub(crate) mod survey;
pub(crate) mod turns;
