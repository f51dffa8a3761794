//! Units of what is shown to people, against those of the simulation.

/// Metres in a kilometre.
pub(crate) const METRES_PER_KM: f64 = 1000.0;
/// Kilometres an hour in a metre a second.
pub(crate) const KMH_PER_MPS: f64 = 3.6;
/// Seconds in an hour.
pub(crate) const SECONDS_PER_HOUR: f64 = 3600.0;
