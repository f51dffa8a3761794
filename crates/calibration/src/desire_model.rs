//! Models of desire that are fitted to the same observations: which terms stand in G.

use std::collections::BTreeMap;

use laneweave_models::change::{IncentiveName, discomfort};
use laneweave_network::Side;

use crate::observe::{ByDesired, NODES, Observations, PLAIN, Place, SideSeen, Sighting, gap_terms};
use crate::place_spread::PlaceSpread;
use crate::prior::Prior;
use crate::waiting::{Assumptions, Design, Driver, Layout, NO_STRATUM, Spell, logit};

/// Which terms the utility G has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DesireModel {
    /// A constant chance everywhere.
    Constant,
    /// A constant chance for each place: lane, side and distance before the next fork.
    Places,
    /// Multi-criteria decision-making with this β.
    Mcdm {
        /// β of comfort.
        beta: f64,
    },
    /// MOBIL's criterion, with one scale.
    Mobil,
    /// The desire of LMRS, with one scale.
    Lmrs,
    /// Gaps and speeds as they are.
    Raw,
}

impl DesireModel {
    /// Its name in results.
    pub fn name(&self) -> &'static str {
        match self {
            DesireModel::Constant => "constant",
            DesireModel::Places => "places",
            DesireModel::Mcdm { .. } => "mcdm",
            DesireModel::Mobil => "mobil",
            DesireModel::Lmrs => "lmrs",
            DesireModel::Raw => "raw",
        }
    }

    /// The names of its terms.
    pub fn terms(&self) -> Vec<&'static str> {
        match self {
            DesireModel::Constant | DesireModel::Places => Vec::new(),
            DesireModel::Mcdm { .. } => {
                let plain = PLAIN.map(IncentiveName::name);
                ["speed", "comfort", "courtesy"].into_iter().chain(plain).collect()
            }
            DesireModel::Mobil => vec!["gain"],
            DesireModel::Lmrs => vec!["desire"],
            DesireModel::Raw => {
                vec!["own gap", "own closing", "lead gap", "lead closing", "lag gap", "lag closing", "speed"]
            }
        }
    }

    /// Whether places have intercepts of their own.
    fn has_places(&self) -> bool {
        !matches!(self, DesireModel::Constant)
    }

    /// Whether its terms depend on the desired speed.
    fn knows_desired(&self) -> bool {
        matches!(self, DesireModel::Mcdm { .. } | DesireModel::Mobil | DesireModel::Lmrs)
    }

    pub(crate) fn add_terms(&self, seen: &SideSeen, by_desired: &ByDesired, values: &mut Vec<f64>) {
        match self {
            DesireModel::Constant | DesireModel::Places => {}
            DesireModel::Mcdm { beta } => {
                values.extend([
                    f64::from(by_desired.speed),
                    discomfort(f64::from(seen.headway), *beta),
                    f64::from(seen.courtesy),
                ]);
                values.extend(by_desired.plain.map(f64::from));
            }
            DesireModel::Mobil => values.push(f64::from(by_desired.mobil)),
            DesireModel::Lmrs => values.push(f64::from(by_desired.lmrs)),
            DesireModel::Raw => {
                let length = |[gap, _]: [f32; 2]| libm::log(f64::from(gap).max(0.5) / 10.0);
                for pair in [seen.own, seen.lead, seen.lag] {
                    values.extend([length(pair), f64::from(pair[1])]);
                }
                values.push(f64::from(seen.speed));
            }
        }
    }
}

/// Places are told apart if drivers considered them for so long [s], and at most so many of them (ours).
const SHORTEST_EXPOSURE: usize = 30;
const MOST_PLACES: usize = 120;

/// The places of observations that have intercepts of their own, with their numbers.
fn places(observations: &Observations) -> BTreeMap<Place, u32> {
    let mut exposure: BTreeMap<Place, usize> = BTreeMap::new();
    let sightings = observations.drivers.iter().flat_map(|it| &it.spells).flat_map(|it| &it.sightings);
    for seen in sightings.flat_map(|it| it.sides.iter().flatten()) {
        *exposure.entry(seen.place).or_default() += 1;
        *exposure.entry(seen.place.lane()).or_default() += 1;
    }
    let least = SHORTEST_EXPOSURE * observations.phases as usize;
    let mut kept: Vec<(usize, Place)> = exposure
        .into_iter()
        .filter(|(_, count)| *count >= least)
        .map(|(place, count)| (count, place))
        .collect();
    kept.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
    kept.truncate(MOST_PLACES);
    kept.into_iter().map(|it| it.1).zip(0..).collect()
}

impl Observations {
    /// Most possible desired speeds of a driver.
    fn nodes(&self) -> usize {
        self.drivers.iter().map(|it| it.desired.nodes.len()).max().unwrap_or(NODES)
    }

    /// What drivers could choose, with the terms of `model`.
    pub fn design(&self, model: &DesireModel) -> Design {
        let numbers = if model.has_places() { places(self) } else { BTreeMap::new() };
        let mut design = Design {
            terms: model.terms().len(),
            nodes: if model.knows_desired() { self.nodes() } else { 1 },
            strata: numbers.len(),
            ..Design::default()
        };
        let number = |place: Place| numbers.get(&place).copied().unwrap_or(NO_STRATUM);
        for observed in &self.drivers {
            let first = design.gaps.len();
            let phases = self.phases.max(1) as usize;
            let mut driver = Driver {
                chances: match model.knows_desired() {
                    true => observed.desired.nodes.iter().map(|it| it.1).collect(),
                    false => vec![1.0],
                },
                rows: first..first,
                phases: vec![Vec::new(); phases],
            };
            for spell in &observed.spells {
                let mut parts = vec![Spell::default(); phases];
                for Sighting { tick, sides } in &spell.sightings {
                    let rows = sides.each_ref().map(|it| {
                        it.as_ref().map(|seen| {
                            let nodes = seen.by_desired.iter().take(design.nodes);
                            nodes.for_each(|it| model.add_terms(seen, it, &mut design.values));
                            design.gaps.push(gap_terms(seen));
                            design.places.push([number(seen.place.lane()), number(seen.place)]);
                            design.gaps.len() as u32 - 1
                        })
                    });
                    parts[tick.rem_euclid(phases as i64) as usize].seconds.push(rows);
                }
                for (phase, mut part) in driver.phases.iter_mut().zip(parts) {
                    part.changed_to = spell.change.map(Side::at);
                    phase.push(part);
                }
            }
            driver.rows = first..design.gaps.len();
            design.drivers.push(driver);
        }
        design
    }
}

/// So many drivers have to change twice before their own intercepts are told from chance (ours).
const REPEATED: usize = 10;

/// The usual assumptions for `design`. Its terms have the prior `means`; one standard deviation of a yield multiplies
/// the odds of a change by e to a power whose standard deviation is `effect`. Its places differ by `spread`.
pub fn assumptions(design: &Design, means: &[f64], effect: f64, spread: &PlaceSpread) -> Assumptions {
    let layout = Layout::of(design);
    let mut prior = Prior::none(layout.count());
    let mut assume = |at: usize, mean: f64, deviation: f64| {
        prior.means[at] = mean;
        prior.precisions[at] = 1.0 / (deviation * deviation);
    };
    let rate = (design.changes() as f64 + 0.5) / (design.seconds() as f64 + 1.0);
    assume(layout.intercept(), logit(rate.min(0.5)), 4.0);
    for ((at, mean), scale) in layout.slopes().zip(means).zip(design.scales()) {
        assume(at, *mean, effect / scale);
    }
    assume(layout.background(), logit(0.1 * rate.min(0.5)), 1.5);
    assume(layout.giving_up(), logit(1.0 / 15.0), 0.7);
    assume(layout.waiting(), logit(0.02), 1.0);
    assume(layout.spread(), libm::log(0.3), 0.7);
    let acceptance = layout.acceptance();
    assume(acceptance.start, 0.0, 1.5);
    for (at, mean) in (acceptance.start + 1..acceptance.end).zip([0.5, 0.5, -0.5, -0.5]) {
        assume(at, mean, 1.0);
    }
    layout.places().zip(spread.of(design)).for_each(|(at, deviation)| assume(at, 0.0, deviation));
    let has_spread = design.drivers.iter().filter(|it| changes_of(it) >= 2).count() >= REPEATED;
    let mut is_fixed = vec![false; layout.count()];
    is_fixed[layout.spread()] = !has_spread;
    Assumptions { prior, is_fixed, has_spread }
}

/// Number of changes of a driver.
fn changes_of(driver: &Driver) -> usize {
    let spells = driver.phases.first().map_or(&[][..], Vec::as_slice);
    spells.iter().filter(|it| it.changed_to.is_some()).count()
}
