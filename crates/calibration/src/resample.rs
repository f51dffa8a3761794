//! Observations drawn again, and parts of them held out. The same seed gives the same parts on any number of threads.

use laneweave_sim::{Purpose, Random};

use crate::observe::Observations;

/// Drivers who are first seen within this time stand or fall together [s]: their traffic is the same (ours).
const BLOCK: f64 = 10.0;

/// How many times each driver counts in draw number `draw` of a bootstrap over blocks of time: as many blocks as there
/// are, drawn with replacement.
pub fn resampled(observations: &Observations, seed: u64, draw: u32) -> Vec<f64> {
    drawn_again(&blocks(observations), seed, draw)
}

/// The same over single drivers.
pub(crate) fn resampled_drivers(count: usize, seed: u64, draw: u32) -> Vec<f64> {
    drawn_again(&(0..count).collect::<Vec<usize>>(), seed, draw)
}

/// How many times each driver counts; `blocks` has the block of each.
fn drawn_again(blocks: &[usize], seed: u64, draw: u32) -> Vec<f64> {
    let count = blocks.iter().max().map_or(0, |it| it + 1);
    let random = Random::new(seed);
    let mut times = vec![0.0; count];
    for number in 0..count as u32 {
        let drawn = random.uniform(number, Purpose::Resampling, draw);
        times[((drawn * count as f64) as usize).min(count - 1)] += 1.0;
    }
    blocks.iter().map(|it| times[*it]).collect()
}

/// The number of the block of each driver.
fn blocks(observations: &Observations) -> Vec<usize> {
    let key = |it: &crate::observe::ObservedDriver| (it.recording, (it.first_seen / BLOCK).floor() as i64);
    let mut keys: Vec<_> = observations.drivers.iter().map(key).collect();
    keys.sort_unstable();
    keys.dedup();
    let number = |it| keys.binary_search(&key(it)).unwrap_or(0);
    observations.drivers.iter().map(number).collect()
}

/// The part, from 0 on, in which each of `count` drivers is held out in repetition number `repetition`: parts of equal
/// size, by random order.
pub(crate) fn folds(count: usize, parts: usize, seed: u64, repetition: u32) -> Vec<usize> {
    let order = shuffled(count, seed, repetition);
    let mut folds = vec![0; count];
    order.into_iter().enumerate().for_each(|(place, driver)| folds[driver] = place % parts);
    folds
}

/// The numbers below `count` in a random order.
pub(crate) fn shuffled(count: usize, seed: u64, number: u32) -> Vec<usize> {
    let random = Random::new(seed);
    let key = |it: &usize| random.uniform(*it as u32, Purpose::Resampling, 0x8000_0000 | number);
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| key(a).total_cmp(&key(b)));
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observe::ObservedDriver;

    #[test]
    fn a_draw_has_as_many_blocks_and_those_of_a_block_stay_together() {
        let driver = |number: i64| ObservedDriver { first_seen: number as f64, ..ObservedDriver::default() };
        let observations =
            Observations { drivers: (0..100).map(driver).collect(), ..Observations::default() };
        let mut means = 0.0;
        for draw in 0..50 {
            let times = resampled(&observations, 1, draw);
            assert_eq!(times.iter().sum::<f64>(), 100.0);
            assert!(times.chunks(10).all(|it| it.iter().all(|other| *other == it[0])));
            means += times[0] / 50.0;
        }
        assert!((means - 1.0).abs() < 0.5);
        assert_ne!(resampled(&observations, 1, 0), resampled(&observations, 2, 0));
    }

    #[test]
    fn parts_are_of_equal_size_and_differ_between_repetitions() {
        let one = folds(300, 3, 1, 0);
        for part in 0..3 {
            assert_eq!(one.iter().filter(|it| **it == part).count(), 100);
        }
        assert_ne!(one, folds(300, 3, 1, 1));
    }
}
