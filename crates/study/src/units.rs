//! Units of displayed values.

/// Metres in a kilometre.
pub const METRES_PER_KM: f64 = 1000.0;
/// Kilometres an hour in a metre a second.
pub const KMH_PER_MPS: f64 = 3.6;
/// Seconds in an hour.
pub const SECONDS_PER_HOUR: f64 = 3600.0;
