//! What drivers believe about travel times, how much they mind turns and lights, and for what gain they leave their
//! route.

use laneweave_models::Guidance;
use laneweave_network::{ChainIndex, Network};

use crate::route::disutility::Disutility;
use crate::route::navigate::Navigator;
use crate::state::goal::Destination;
use crate::state::lane::VehicleId;
use crate::state::normal::quantile;
use crate::state::random::{Purpose, Random};

/// A driver's beliefs since the last measurement of travel times.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beliefs<'a> {
    guidance: &'a Guidance,
    /// Believed time of its own route, as a multiple of the measured one.
    pub(crate) own: f64,
    /// The same for other routes.
    pub(crate) other: f64,
    /// Gain for which it leaves its route [s].
    pub(crate) band: f64,
}

impl<'a> Beliefs<'a> {
    /// The beliefs of a driver without a recommended route: it knows the times, and keeps its route.
    #[inline]
    pub(crate) fn settled(guidance: &'a Guidance) -> Beliefs<'a> {
        Beliefs { guidance, own: 1.0, other: 1.0, band: f64::INFINITY }
    }

    /// The beliefs of the driver of `id`, who drives to `destination`.
    #[inline]
    pub(crate) fn of(
        guidance: &'a Guidance,
        navigator: &Navigator,
        random: Random,
        id: VehicleId,
        destination: Destination,
    ) -> Beliefs<'a> {
        match navigator.recommended(destination) {
            None => Beliefs::settled(guidance),
            Some(_) => Beliefs::drawn(guidance, random, id, navigator.measurements()),
        }
    }

    #[inline(never)]
    fn drawn(guidance: &'a Guidance, random: Random, id: VehicleId, measurement: u32) -> Beliefs<'a> {
        let keeps = random.uniform(id, Purpose::Habit, 0) < guidance.habit
            || random.uniform(id, Purpose::Compliance, measurement) >= guidance.compliance;
        let band = if keeps { f64::INFINITY } else { guidance.indifference };
        if guidance.route_error == 0.0 {
            return Beliefs { band, ..Beliefs::settled(guidance) };
        }
        let belief = |of: u32| {
            let count = measurement.wrapping_mul(2) + of;
            guidance.belief(quantile(random.uniform(id, Purpose::Belief, count)))
        };
        Beliefs { guidance, own: belief(0), other: belief(1), band }
    }

    /// Route disutility [s] that the driver adds to the times of its own route and of another one, for the turns and
    /// lights from `x` on `chain` on.
    #[inline]
    pub(crate) fn added(
        &self,
        network: &Network,
        chain: ChainIndex,
        x: f64,
        ways: [Disutility; 2],
    ) -> [f64; 2] {
        if self.guidance.minds_time_only() {
            return [0.0; 2];
        }
        let passed = Disutility::until(network, chain, x);
        ways.map(|it| it.beyond(passed)).map(|it| self.guidance.added(it.turns, it.lights))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRIVERS: u32 = 20_000;

    fn beliefs(guidance: &Guidance, measurement: u32) -> Vec<Beliefs<'_>> {
        (0..DRIVERS).map(|id| Beliefs::drawn(guidance, Random::new(1), id, measurement)).collect()
    }

    /// Share of the drivers who keep their route.
    fn keeping(guidance: Guidance) -> f64 {
        let kept = beliefs(&guidance, 3).iter().filter(|it| it.band.is_infinite()).count();
        kept as f64 / f64::from(DRIVERS)
    }

    #[test]
    fn errors_are_lognormal_with_median_1_anew_for_each_measurement_and_way() {
        let guidance = Guidance { route_error: 0.2, ..Guidance::default() };
        let logarithms = |measurement, of: fn(&Beliefs) -> f64| -> Vec<f64> {
            beliefs(&guidance, measurement).iter().map(|it| libm::log(of(it))).collect()
        };
        let sets = [logarithms(1, |it| it.own), logarithms(1, |it| it.other), logarithms(2, |it| it.own)];
        let n = f64::from(DRIVERS);
        for (number, set) in sets.iter().enumerate() {
            let mean = set.iter().sum::<f64>() / n;
            let sd = (set.iter().map(|it| it * it).sum::<f64>() / n).sqrt();
            // Three standard errors.
            assert!(mean.abs() < 3.0 * 0.2 / n.sqrt() && (sd / 0.2 - 1.0).abs() < 3.0 / (2.0 * n).sqrt());
            let together: f64 = set.iter().zip(&sets[(number + 1) % 3]).map(|(a, b)| a * b).sum();
            assert!((together / (n * 0.04)).abs() < 3.0 / n.sqrt(), "{together}");
        }
        let usual = Guidance::default();
        let known = beliefs(&usual, 1);
        assert!(known.iter().all(|it| (it.own, it.other, it.band) == (1.0, 1.0, 30.0)));
    }

    #[test]
    fn so_many_keep_their_route_as_have_the_habit_or_do_not_mind() {
        let three_errors = 3.0 * (0.25 / f64::from(DRIVERS)).sqrt();
        let usual = Guidance::default();
        assert_eq!(keeping(usual), 0.0);
        assert_eq!(keeping(Guidance { habit: 1.0, ..usual }), 1.0);
        assert_eq!(keeping(Guidance { compliance: 0.0, ..usual }), 1.0);
        for guidance in [Guidance { habit: 0.3, ..usual }, Guidance { compliance: 0.7, ..usual }] {
            assert!((keeping(guidance) - 0.3).abs() < three_errors, "{guidance:?}");
        }
    }
}
