//! Giving way at junctions: which lag to the next vehicle with priority a driver accepts.
//!
//! Gap acceptance as in Harders (1968) and Siegloch (1973): a driver goes if the next vehicle on the other path
//! arrives no sooner than its critical gap t_c. A driver who has waited accepts less, down to a floor. After its
//! patience it takes its turn (both ours). It never goes before it can be out of the way; into a
//! roundabout, others may have to brake a little for it.

use serde::{Deserialize, Serialize};

/// How a driver gives way.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Yielding {
    /// t_c: shortest lag to the next vehicle with priority that is accepted at once [s].
    pub critical_gap: f64,
    /// Time of waiting after which the driver takes its turn [s].
    pub patience: f64,
}

impl Default for Yielding {
    fn default() -> Yielding {
        Yielding { critical_gap: 5.0, patience: 45.0 }
    }
}

/// Share of the critical gap that is accepted when patience ends (ours).
const LEAST_SHARE: f64 = 0.6;
/// The same at a roundabout, where it is accepted after this share of the patience (ours). Critical gaps there fall
/// like this with the waiting time in Polus, Lazar, Livneh (2003), from memory.
const LEAST_AT_A_ROUNDABOUT: f64 = 0.5;
const IMPATIENT_AFTER: f64 = 1.0 / 3.0;
/// Time that is left between two vehicles in one place [s] (ours).
pub const MARGIN: f64 = 0.5;

impl Yielding {
    /// Whether a driver who has `waited` [s], and needs `needed` [s] to be out of the way, goes before a vehicle that
    /// arrives in `lag` [s].
    pub fn accepts(&self, lag: f64, needed: f64, waited: f64) -> bool {
        lag >= self.critical(waited / self.patience, LEAST_SHARE).max(needed + MARGIN)
    }

    /// The same for a driver who enters a roundabout.
    pub fn accepts_at_roundabout(&self, lag: f64, needed: f64, waited: f64) -> bool {
        let impatience = waited / (IMPATIENT_AFTER * self.patience);
        lag >= self.critical(impatience, LEAST_AT_A_ROUNDABOUT).max(needed + MARGIN)
    }

    /// The critical gap of a driver with this impatience, of which the share `least` remains where it is 1 [s].
    fn critical(&self, impatience: f64, least: f64) -> f64 {
        self.critical_gap * (1.0 - impatience.clamp(0.0, 1.0) * (1.0 - least))
    }
}

/// Acceleration of a vehicle without a leader [m/s²] (ours).
const GAINS: f64 = 1.5;

/// Time [s] in which a vehicle at `speed` that accelerates evenly up to `desired` [m/s] covers `distance` [m].
pub fn time_to_cover(distance: f64, speed: f64, desired: f64) -> f64 {
    if distance <= 0.0 {
        return 0.0;
    }
    let top = desired.max(speed).max(1.0);
    let to_top = (top * top - speed * speed) / (2.0 * GAINS);
    if distance <= to_top {
        ((speed * speed + 2.0 * GAINS * distance).sqrt() - speed) / GAINS
    } else {
        (top - speed) / GAINS + (distance - to_top) / top
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lag_is_accepted_from_the_critical_gap_on() {
        let driver = Yielding::default();
        assert!(driver.accepts(5.0, 3.0, 0.0));
        assert!(!driver.accepts(4.99, 3.0, 0.0));
        // A driver who has waited for all of its patience accepts 3 s, but not before it can be out of the way.
        assert!(driver.accepts(3.0, 2.5, 45.0));
        assert!(!driver.accepts(3.0, 2.6, 45.0));
        // At a roundabout it accepts 2.5 s after a third of that time.
        assert!(driver.accepts_at_roundabout(2.5, 2.0, 15.0));
        assert!(!driver.accepts_at_roundabout(2.5, 2.1, 45.0));
        assert!(
            driver.accepts_at_roundabout(3.75, 2.0, 7.5) && !driver.accepts_at_roundabout(3.74, 2.0, 7.5)
        );
    }

    #[test]
    fn distances_take_the_time_of_an_even_acceleration_up_to_the_desired_speed() {
        assert_eq!(time_to_cover(12.0, 0.0, 20.0), 4.0);
        assert_eq!(time_to_cover(100.0, 10.0, 10.0), 10.0);
        // 6 s and 27 m to 9 m/s, then 73 m.
        assert!((time_to_cover(100.0, 0.0, 9.0) - 6.0 - 73.0 / 9.0).abs() < 1e-12);
        assert_eq!(time_to_cover(-1.0, 0.0, 9.0), 0.0);
    }
}
