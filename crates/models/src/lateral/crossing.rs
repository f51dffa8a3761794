//! A vehicle in a lane change.

/// A vehicle in a lane change, as far as its way sideways depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Speed [m/s].
    pub speed: f64,
    /// Length of the vehicle [m].
    pub length: f64,
    /// Time that the change takes a vehicle that is not slow [s].
    pub duration: f64,
}

impl Crossing {
    /// Shortest way on which a car can change lanes [m]; ours.
    const LEAST_WAY: f64 = 25.0;
    /// The same for a long vehicle, in its lengths; ours.
    const LENGTHS: f64 = 3.0;
    /// Share of its usual pace at which a change goes on at standstill; ours.
    const SLOWEST: f64 = 0.2;

    /// Shortest way on which the vehicle can change lanes [m].
    #[inline]
    fn least_way(self) -> f64 {
        (Crossing::LENGTHS * self.length).max(Crossing::LEAST_WAY)
    }

    /// Way that the change takes at this speed [m].
    #[inline]
    pub fn way(self) -> f64 {
        (self.speed * self.duration).max(self.least_way())
    }

    /// How fast the change goes on, 1 for a vehicle that is not slow: a slow one needs way, not time.
    #[inline]
    pub fn pace(self) -> f64 {
        (self.speed * self.duration / self.least_way()).clamp(Crossing::SLOWEST, 1.0)
    }

    /// Share of its time that the change goes on by in `dt` [s].
    #[inline]
    pub fn progress_in(self, dt: f64) -> f64 {
        self.pace() * dt / self.duration
    }
}
