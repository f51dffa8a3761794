//! Counter-based random numbers: a number depends on (seed, subject, purpose, count), never on earlier numbers.
//!
//! Philox 4×32 with ten rounds (Salmon, Moraes, Dror, Shaw, 2011).

/// The purpose of a random number. Numbers for different purposes are independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Purpose {
    /// Whether the desire to change lanes comes.
    Desire,
    /// When the next vehicle arrives.
    Arrival,
    /// Class of a vehicle.
    Class,
    /// Style of a driver.
    Style,
    /// Driver parameters of a driver within its style.
    Character,
    /// Destination of a driver.
    Destination,
    /// A parameter of a driver.
    Parameter,
    /// Whether a driver is concentrated.
    Attention,
    /// A driver's belief about travel times.
    Belief,
    /// Whether a driver keeps its route out of habit.
    Habit,
    /// Whether a driver considers new travel times.
    Compliance,
    /// Whether a driver leaves its route.
    Route,
    /// Errors of an observer.
    Observation,
    /// When an observer loses a vehicle.
    Interruption,
    /// Whether a recorded vehicle becomes a driver who reacts.
    Reaction,
    /// Which observations are drawn again, or left out.
    Resampling,
    /// A driver's errors in what it sees of a vehicle ahead.
    MisperceptionAhead,
    /// A driver's errors in what it sees of a vehicle behind.
    MisperceptionBehind,
    /// How an episode begins, in which a program learns to drive.
    Episode,
}

/// The source of all random numbers of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Random {
    seed: u64,
}

impl Random {
    /// The source for `seed`.
    pub fn new(seed: u64) -> Random {
        Random { seed }
    }

    /// A uniform number in the open interval (0, 1): number `count` of `subject` for `purpose`.
    #[inline]
    pub fn uniform(&self, subject: u32, purpose: Purpose, count: u32) -> f64 {
        let [low, high, ..] = self.draw(subject, purpose, count);
        in_unit_interval(low, high)
    }

    /// Two such numbers, independent of each other; the first one is [`Random::uniform`].
    #[inline]
    pub(crate) fn uniform_pair(&self, subject: u32, purpose: Purpose, count: u32) -> [f64; 2] {
        let [low, high, other_low, other_high] = self.draw(subject, purpose, count);
        [in_unit_interval(low, high), in_unit_interval(other_low, other_high)]
    }

    #[inline]
    fn draw(&self, subject: u32, purpose: Purpose, count: u32) -> [u32; 4] {
        philox([subject, purpose as u32, count, 0], [self.seed as u32, (self.seed >> 32) as u32])
    }
}

/// The 53 highest of 64 random bits as a number in the open interval (0, 1).
#[inline]
fn in_unit_interval(low: u32, high: u32) -> f64 {
    const STEP: f64 = 1.0 / (1u64 << 53) as f64;
    let bits = (u64::from(high) << 32 | u64::from(low)) >> 11;
    (bits as f64 + 0.5) * STEP
}

const ROUNDS: u32 = 10;
const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];

#[inline(always)]
fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..ROUNDS {
        let first = u64::from(MULTIPLIERS[0]) * u64::from(counter[0]);
        let second = u64::from(MULTIPLIERS[1]) * u64::from(counter[2]);
        counter = [
            (second >> 32) as u32 ^ counter[1] ^ key[0],
            second as u32,
            (first >> 32) as u32 ^ counter[3] ^ key[1],
            first as u32,
        ];
        key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
    }
    counter
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn philox_gives_its_published_test_vectors() {
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        let ones = u32::MAX;
        assert_eq!(philox([ones; 4], [ones; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(
            philox([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    #[test]
    fn draws_are_uniform_and_do_not_depend_on_each_other() {
        let random = Random::new(7);
        let n = 100_000;
        let draws: Vec<f64> = (0..n).map(|i| random.uniform(i, Purpose::Desire, 3)).collect();
        let mean = draws.iter().sum::<f64>() / f64::from(n);
        assert!((mean - 0.5).abs() < 0.003, "{mean}");
        assert_eq!(random.uniform(5, Purpose::Desire, 3), draws[5]);
        assert_ne!(random.uniform(5, Purpose::Style, 3), draws[5]);
        assert_ne!(Random::new(8).uniform(5, Purpose::Desire, 3), draws[5]);
    }
}
