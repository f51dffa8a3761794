//! When a vehicle counts as standing, and how far it keeps from where it has to stop.

/// Standstill below this speed [m/s].
pub(crate) const STANDSTILL: f64 = 0.1;
/// Slower than this [m/s] a vehicle stands before a junction (ours).
pub(crate) const STANDS: f64 = 0.3;
/// Road that a driver keeps before a place where it stops at a junction [m].
pub(crate) const ROOM_AT_A_STOP: f64 = 0.7;
