//! Limits of standstill, and the distance to a place where a driver stops.

/// A vehicle below this speed is at standstill [m/s].
pub(crate) const STANDSTILL: f64 = 0.1;
/// A vehicle below this speed stands before a junction [m/s] (ours).
pub(crate) const STANDS: f64 = 0.3;
/// Distance that a driver keeps from a place where it stops at a junction [m].
pub(crate) const ROOM_AT_A_STOP: f64 = 0.7;
