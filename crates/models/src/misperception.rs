//! Misperception: a driver's errors in what it sees of a gap.
//!
//! Treiber, Kesting, Helbing (2006), Delays, inaccuracies and anticipation in microscopic traffic models, Physica A
//! 360, 71–88: the Human Driver Model, its constants from memory. A gap s is seen as s e^(V_s w_s), and the speed
//! difference with an error of s r_c w_c: the relative error of a gap is constant, and so is that of the inverse time
//! to collision. w_s and w_c are standard Wiener processes with a correlation time: who is wrong now is wrong in the
//! next seconds, too, so that repeated looks do not find the most favourable error.

use crate::exponential::exp;
use crate::follow::Ahead;

/// V_s: standard deviation of the relative error of a gap.
const GAP_ERROR: f64 = 0.05;
/// r_c: standard deviation of the error of the inverse time to collision [1/s].
const CLOSING_ERROR: f64 = 0.01;

/// A driver's errors in what it sees of one gap, at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misperception {
    /// Seen gap, as a multiple of the true one.
    factor: f64,
    /// Error of the speed at which the gap closes, per metre of gap [1/s].
    closing: f64,
}

impl Misperception {
    /// Time in which the errors lose their memory: their autocorrelation is e^(−t/τ) [s].
    pub const CORRELATION_TIME: f64 = 20.0;

    /// Errors of `size` times the usual ones, where the two processes have the values `w_s` and `w_c`.
    pub fn new(size: f64, [w_s, w_c]: [f64; 2]) -> Misperception {
        Misperception { factor: exp(size * GAP_ERROR * w_s), closing: size * CLOSING_ERROR * w_c }
    }

    /// What the driver sees of a vehicle `ahead`.
    pub fn of_leader(&self, ahead: Ahead) -> Ahead {
        let speed = (ahead.speed - self.closing(ahead.gap)).max(0.0);
        Ahead { gap: ahead.gap * self.factor, speed, ..ahead }
    }

    /// What the driver sees of a vehicle that is `gap` [m] behind at this speed [m/s]: gap and speed.
    pub fn of_follower(&self, gap: f64, speed: f64) -> (f64, f64) {
        (gap * self.factor, (speed + self.closing(gap)).max(0.0))
    }

    /// By how much a gap seems to close faster than it does [m/s].
    fn closing(&self, gap: f64) -> f64 {
        self.closing * gap.max(0.0)
    }
}
