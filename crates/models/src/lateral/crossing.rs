//! A vehicle in a lane change.

/// A vehicle in a lane change: what its lateral motion depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Speed [m/s].
    pub speed: f64,
    /// Length of the vehicle [m].
    pub length: f64,
    /// Time of the change for a vehicle that is not slow [s].
    pub duration: f64,
}

impl Crossing {
    /// Shortest distance over which a car can change lanes [m]; ours.
    const LEAST_WAY: f64 = 25.0;
    /// The same for a long vehicle, in vehicle lengths; ours.
    const LENGTHS: f64 = 3.0;
    /// Rate of the change at standstill, as a share of the usual rate; ours.
    const SLOWEST: f64 = 0.2;

    /// Shortest distance over which the vehicle can change lanes [m].
    #[inline]
    fn least_way(self) -> f64 {
        (Crossing::LENGTHS * self.length).max(Crossing::LEAST_WAY)
    }

    /// Distance that the change takes at this speed [m].
    #[inline]
    pub fn way(self) -> f64 {
        (self.speed * self.duration).max(self.least_way())
    }

    /// Rate of the change, 1 for a vehicle that is not slow: for a slow vehicle the distance counts, not the time.
    #[inline]
    pub fn pace(self) -> f64 {
        (self.speed * self.duration / self.least_way()).clamp(Crossing::SLOWEST, 1.0)
    }

    /// Share of its time by which the change progresses in `dt` [s].
    #[inline]
    pub fn progress_in(self, dt: f64) -> f64 {
        self.pace() * dt / self.duration
    }
}
