//! Junctions: who may pass the conflict zones ahead, and in which order.
//!
//! A driver passes a zone only with a *reservation*: the right, given once, to drive through all zones up to the next
//! place where its vehicle can stand without being in anybody's way, and only if there is room for it there. Of those
//! who were granted reservations through one zone the earlier goes first: over a crossing the later waits until the
//! earlier is out of it, into a merge it follows. Reservations are granted one after the other, so the order is the
//! same in all zones and somebody can always go on: no standoff within a junction.
//!
//! Who gives way to whom before that is up to drivers: lights and signs, the lag to those who go first
//! (`laneweave_models::yielding`), then who waits longest; nobody need wait for who could not go yet anyway.

pub(crate) mod applicant;
pub(crate) mod approach;
pub(crate) mod conditions;
pub(crate) mod mergers;
pub(crate) mod oncoming;
pub(crate) mod storage_space;
pub(crate) mod survey;
pub(crate) mod turns;
