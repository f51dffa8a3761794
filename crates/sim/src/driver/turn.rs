//! Turns: drivers consider lanes once in an epoch, each in its own step, so that all steps have about the same load.

use crate::state::lane::VehicleId;

/// The first turn of the driver of `id` from step `from` on. It has one turn in every `period` steps.
///
/// The turns are multiples of the golden ratio, which spread evenly over any number of successive vehicles.
#[inline]
pub(crate) fn next_turn(id: VehicleId, from: u32, period: u32) -> u32 {
    /// 2³² divided by the golden ratio.
    const GOLDEN: u32 = 0x9E37_79B9;
    let share = u64::from(id.wrapping_mul(GOLDEN));
    let turn = ((share * u64::from(period)) >> 32) as u32;
    from + (period + turn - from % period) % period
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_driver_has_one_turn_in_every_period() {
        for period in [1, 2, 10, 25] {
            for id in 0..100 {
                let turns: Vec<u32> = (0..200).filter(|step| next_turn(id, *step, period) == *step).collect();
                assert!(turns.windows(2).all(|it| it[1] - it[0] == period), "{id} {period}");
                assert_eq!(turns.len(), 200 / period as usize);
            }
        }
    }

    #[test]
    fn turns_are_spread_evenly_over_successive_vehicles() {
        let mut drivers = [0; 10];
        for id in 1000..2000 {
            drivers[next_turn(id, 10, 10) as usize - 10] += 1;
        }
        assert!(drivers.iter().all(|it| (98..=102).contains(it)), "{drivers:?}");
    }
}
