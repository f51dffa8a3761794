//! The gaps that drivers were offered, look by look, with the chance that they began to want one.

use laneweave_models::change::Safety;
use laneweave_network::Side;

use crate::observe::{Observations, ObservedDriver, ObservedSpell, SideSeen};
use crate::waiting::logit;

/// The gaps to one side at one look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offered {
    /// The logit of the chance that a free driver begins to want this side at this look.
    pub desire: f64,
    /// Logarithm of the gap to the new leader [ln m].
    pub lead: f64,
    /// Logarithm of the gap to the new follower [ln m].
    pub lag: f64,
    /// Whether the gap test accepts the gaps, but for critical gaps.
    pub is_possible: bool,
}

/// A time in which a driver could begin a change.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct GapSpell {
    /// What it was offered left and right, in the order of time.
    pub(super) looks: Vec<[Option<Offered>; 2]>,
    /// The side of the change that began at the last look.
    pub(super) changed_to: Option<usize>,
}

/// The gaps that drivers were offered.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OfferedGaps {
    /// The spells of each driver.
    pub(super) drivers: Vec<Vec<GapSpell>>,
    /// Looks in a second.
    pub(super) looks: f64,
}

/// Chances of a desire lie between this and its complement.
const LEAST: f64 = 1e-9;
/// Shorter gaps count as this long [m]: positions have errors (ours).
const SHORTEST: f64 = 0.5;

impl OfferedGaps {
    /// What the drivers of `observations` were offered, where the gap test has the limits of `safety`. `desires` are
    /// the chances per second that they begin to want a side: for each side of each sighting, in order.
    pub fn of(observations: &Observations, desires: &[f64], safety: &Safety) -> OfferedGaps {
        let looks = f64::from(observations.phases.max(1));
        let mut desires = desires.iter().copied();
        let mut next = || {
            let chance = 1.0 - libm::pow(1.0 - desires.next().unwrap_or(0.0), 1.0 / looks);
            logit(chance.clamp(LEAST, 1.0 - LEAST))
        };
        let mut of_driver = |driver: &ObservedDriver| {
            driver.spells.iter().map(|it| spell(it, looks, safety, &mut next)).collect()
        };
        OfferedGaps { drivers: observations.drivers.iter().map(&mut of_driver).collect(), looks }
    }

    /// Number of changes.
    pub fn changes(&self) -> usize {
        self.drivers.iter().flatten().filter(|it| it.changed_to.is_some()).count()
    }
}

/// The gaps of a spell. A change begins after its last sighting, with the gaps of then.
fn spell(
    observed: &ObservedSpell,
    looks: f64,
    safety: &Safety,
    desire: &mut impl FnMut() -> f64,
) -> GapSpell {
    let mut spell = GapSpell { looks: Vec::new(), changed_to: None };
    let last = observed.sightings.len().saturating_sub(1);
    for (number, seen) in observed.sightings.iter().enumerate() {
        let later = match observed.change {
            Some(_) if number == last => (observed.until - seen.tick as f64 / looks).clamp(0.0, 1.0 / looks),
            _ => 0.0,
        };
        let [left, right] = &seen.sides;
        let mut of = |it: &SideSeen| offered(it, later, safety, desire());
        spell.looks.push([left.as_ref().map(&mut of), right.as_ref().map(&mut of)]);
    }
    spell.changed_to = observed.change.map(Side::at);
    spell
}

/// The gaps of a side as they are `later` [s], with this chance of a desire.
fn offered(seen: &SideSeen, later: f64, safety: &Safety, desire: f64) -> Offered {
    let least = |[gap, closing]: [f32; 2]| {
        let (gap, closing) = (f64::from(gap), f64::from(closing));
        let then = (gap - closing * later).max(SHORTEST);
        // The critical gap grows with the closing speed: so the gap counts as shorter by as much.
        libm::log(then) - safety.closing_growth * closing.max(0.0)
    };
    Offered { desire, lead: least(seen.lead), lag: least(seen.lag), is_possible: seen.demands.suit(safety) }
}
