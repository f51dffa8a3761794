//! Drivers of a test, whose process is known.

use laneweave_calibration::Prior;
use laneweave_calibration::waiting::{
    Assumptions, Design, Driver, Layout, NO_STRATUM, Spell, logistic, logit,
};

/// Random numbers, uniform in 0…1 (SplitMix64, Steele, Lea, Flood 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() - 6.0
    }
}

/// What drivers of a test do.
pub(crate) struct Truth {
    pub(crate) intercept: f64,
    pub(crate) slopes: [f64; 2],
    pub(crate) background: f64,
    pub(crate) giving_up: f64,
    pub(crate) spread: f64,
    pub(crate) acceptance: [f64; 2],
}

/// `drivers` drivers, each seen for at most `seconds` seconds in which it changes at most once.
pub(crate) fn simulated(truth: &Truth, drivers: usize, seconds: usize, random: &mut Random) -> Design {
    let mut design = Design { terms: 2, nodes: 1, strata: 0, ..Design::default() };
    for _ in 0..drivers {
        let first = design.gaps.len();
        let own = truth.spread * random.normal();
        let (mut spell, mut wants) = (Spell::default(), None);
        // Terms change slowly, as those of traffic do.
        let mut terms = [[random.normal(), random.normal()], [random.normal(), random.normal()]];
        for _ in 0..seconds {
            let mut rows = [None; 2];
            let mut accepted = [0.0; 2];
            for side in 0..2 {
                terms[side] = terms[side].map(|it| 0.8 * it + 0.6 * random.normal());
                let gap = random.normal();
                rows[side] = Some(design.gaps.len() as u32);
                design.values.extend(terms[side]);
                design.gaps.push([gap, 0.0, 0.0, 0.0]);
                design.places.push([NO_STRATUM; 2]);
                accepted[side] = logistic(truth.acceptance[0] + truth.acceptance[1] * gap);
            }
            spell.seconds.push(rows);
            if wants.is_none() {
                let odds = terms.map(|it| {
                    (truth.intercept + own + truth.slopes[0] * it[0] + truth.slopes[1] * it[1]).exp()
                });
                let chance = |side: usize| {
                    truth.background + (1.0 - 2.0 * truth.background) * odds[side] / (1.0 + odds[0] + odds[1])
                };
                let draw = random.next();
                wants = (draw < chance(0) + chance(1)).then_some(usize::from(draw >= chance(0)));
            }
            if let Some(side) = wants {
                if random.next() < accepted[side] {
                    spell.changed_to = Some(side);
                    break;
                }
                if random.next() < truth.giving_up {
                    wants = None;
                }
            }
        }
        let rows = first..design.gaps.len();
        design.drivers.push(Driver { chances: vec![1.0], rows, phases: vec![vec![spell]] });
    }
    design
}

pub(crate) const TRUTH: Truth = Truth {
    intercept: -4.0,
    slopes: [1.2, -0.6],
    background: 0.002,
    giving_up: 0.1,
    spread: 0.5,
    acceptance: [0.5, 1.5],
};

pub(crate) fn assumptions(layout: Layout) -> Assumptions {
    let mut prior = Prior::none(layout.count());
    let mut assume = |at: usize, mean: f64, deviation: f64| {
        prior.means[at] = mean;
        prior.precisions[at] = 1.0 / (deviation * deviation);
    };
    assume(layout.intercept(), -3.0, 10.0);
    layout.slopes().for_each(|it| assume(it, 0.0, 10.0));
    assume(layout.background(), logit(0.001), 2.0);
    assume(layout.giving_up(), logit(0.07), 1.0);
    assume(layout.waiting(), logit(0.01), 1.0);
    assume(layout.spread(), 0.3_f64.ln(), 1.0);
    layout.acceptance().for_each(|it| assume(it, 0.0, 2.0));
    layout.places().for_each(|it| assume(it, 0.0, 1.0));
    Assumptions { prior, is_fixed: vec![false; layout.count()], has_spread: true }
}
