//! Fits to the same recordings that know more and more of the drivers: what each thing costs that no recording shows.

use laneweave::Fault;
use laneweave::recordings::Matched;
use laneweave::study::mean;

use crate::in_parallel;
use laneweave_calibration::observe::{Known, Observations};

use super::HALF;
use super::drone::{Driven, NOISE};
use super::settings::Setting;
use super::weights::{Process, Seen, WEIGHTS, WeightFit};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Row, markdown, quoted, text_of};

/// What a fit knows, and what it supposes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    speeds: Speeds,
    begins: Begins,
    turns: Turns,
    sides: Sides,
    process: Process,
    errors: Errors,
    /// What the prototype found, in the order of [`WEIGHTS`], of drivers with choice noise.
    prototype: Option<&'static str>,
}

/// Where desired speeds come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Speeds {
    /// They are estimated: each driver has several possible ones.
    Estimated,
    /// Everybody wants to drive as fast as is allowed.
    Allowed,
    /// They are true.
    True,
}

/// What ends the time in which a driver decides whether to change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Begins {
    /// The begin of a recorded change.
    Changes,
    /// The true begin of a desire, whether a change follows or not.
    Desires,
}

/// When drivers decide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Turns {
    /// At whole seconds, or half a second later: each is as likely.
    Either,
    /// At whole seconds.
    WholeSeconds,
    /// At their true turns.
    True,
}

/// Which sides a driver could change to in a second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sides {
    /// All that are permitted.
    Permitted,
    /// Those where the gap test of the style accepts the gap.
    WithSafeGap,
}

/// Errors of the recorded positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Errors {
    /// Those of a drone.
    OfADrone,
    None,
}

/// A plain logit of what is recorded: every second without the begin of a change is one without a desire.
pub(crate) const PLAIN: Variant = Variant {
    name: "plain logit, assumed desired speed",
    speeds: Speeds::Allowed,
    begins: Begins::Changes,
    turns: Turns::WholeSeconds,
    sides: Sides::Permitted,
    process: Process::PlainLogit,
    errors: Errors::OfADrone,
    prototype: Some(".38, .36, .10"),
};

/// The full estimator.
pub(crate) const OURS: Variant = Variant {
    name: "ours",
    speeds: Speeds::Estimated,
    turns: Turns::Either,
    process: Process::Waits,
    prototype: None,
    ..PLAIN
};

/// All variants: one knows more than the other, then the full estimator, then that one with single things known. Those
/// to which drivers look alike stand one after the other.
pub(crate) const VARIANTS: [Variant; 14] = [
    PLAIN,
    Variant {
        name: "background rate, assumed desired speed",
        process: Process::AtOnce,
        prototype: Some(".50, .23, .38"),
        ..PLAIN
    },
    TRUE_SPEED,
    Variant {
        name: "background rate, true desired speed, only seconds with a safe gap",
        sides: Sides::WithSafeGap,
        prototype: Some(".84, 1.05, .70"),
        ..TRUE_SPEED
    },
    Variant {
        name: "background rate, true desired speed, true begin of desires",
        begins: Begins::Desires,
        prototype: Some(".90, .85, .80"),
        ..TRUE_SPEED
    },
    EXACT,
    Variant {
        name: "plain logit, true desired speed, true moment of decisions",
        process: Process::PlainLogit,
        prototype: Some(".66, −.02, .58"),
        ..EXACT
    },
    OURS,
    Variant { name: "ours, with true desired speed", speeds: Speeds::True, ..OURS },
    Variant { name: "ours, with true moment of decisions", turns: Turns::True, ..OURS },
    Variant {
        name: "ours, with true desired speed and moment of decisions",
        speeds: Speeds::True,
        turns: Turns::True,
        ..OURS
    },
    Variant {
        name: "ours, with true begin of desires",
        begins: Begins::Desires,
        process: Process::AtOnce,
        ..OURS
    },
    Variant { name: "ours, without errors of positions", errors: Errors::None, ..OURS },
    Variant {
        name: "background rate, true desired speed, true moment of decisions, without errors of positions",
        errors: Errors::None,
        prototype: None,
        ..EXACT
    },
];

const TRUE_SPEED: Variant = Variant {
    name: "background rate, true desired speed",
    speeds: Speeds::True,
    process: Process::AtOnce,
    prototype: Some(".74, 1.09, .49"),
    ..PLAIN
};

pub(crate) const EXACT: Variant = Variant {
    name: "background rate, true desired speed, true moment of decisions",
    begins: Begins::Desires,
    turns: Turns::True,
    prototype: Some("1.09, 1.01, 1.01"),
    ..TRUE_SPEED
};

/// Fits by these variants to the recordings of so many seeds.
pub(crate) fn fits(
    setting: &Setting,
    effort: &Effort,
    count: u64,
    variants: &[Variant],
) -> Result<Vec<Vec<Seen>>, Fault> {
    let seeds: Vec<u64> = (1..=count).collect();
    in_parallel(&seeds, effort.threads, |seed| fits_of(variants, &Driven::of(setting, *seed, effort.length)?))
}

/// Fits by these variants to the same drivers.
pub(crate) fn fits_of(variants: &[Variant], driven: &Driven) -> Result<Vec<Seen>, Fault> {
    let mut fits = Vec::with_capacity(variants.len());
    for alike in variants.chunk_by(|a, b| a.errors == b.errors) {
        let recording = driven.recorded(alike[0].errors.deviation());
        let matched = driven.matched(&recording);
        for alike in alike.chunk_by(Variant::sees_as) {
            let seen = alike[0].observations(driven, &matched)?;
            for variant in alike {
                let safe = (variant.sides == Sides::WithSafeGap).then(|| with_safe_gaps(seen.clone()));
                let seen = safe.as_ref().unwrap_or(&seen);
                fits.push(WeightFit::of(driven, seen, variant.process)?.whole());
            }
        }
    }
    Ok(fits)
}

impl Errors {
    /// Their standard deviation [m].
    fn deviation(self) -> f64 {
        match self {
            Errors::OfADrone => NOISE,
            Errors::None => 0.0,
        }
    }
}

impl Variant {
    /// Whether drivers are seen alike in both.
    fn sees_as(&self, other: &Variant) -> bool {
        (self.speeds, self.begins, self.turns) == (other.speeds, other.begins, other.turns)
    }

    fn observations(&self, driven: &Driven, matched: &Matched) -> Result<Observations, Fault> {
        let Known { desired, turns, free } = driven.truth.clone();
        let desired = match self.speeds {
            Speeds::Estimated => Default::default(),
            Speeds::Allowed => desired.into_keys().map(|vehicle| (vehicle, 1.0)).collect(),
            Speeds::True => desired,
        };
        let (turns, phases) = match self.turns {
            Turns::Either => (Default::default(), 2),
            Turns::WholeSeconds => (Default::default(), 1),
            Turns::True => (turns, 1),
        };
        let free = free.filter(|_| self.begins == Begins::Desires);
        driven.observations(matched, Known { desired, turns, free }, phases)
    }
}

/// The same without the sides where the gap test of the style does not accept the gap. Changes for which it did not in
/// the last second are not used.
fn with_safe_gaps(mut observations: Observations) -> Observations {
    for spell in observations.drivers.iter_mut().flat_map(|it| &mut it.spells) {
        for side in spell.sightings.iter_mut().flat_map(|it| &mut it.sides) {
            *side = side.filter(|it| it.has_safe_gap);
        }
        let last = spell.sightings.last();
        spell.change = spell.change.filter(|it| last.is_some_and(|seen| seen.sides[it.at()].is_some()));
    }
    observations
}

/// What each variant finds: rows of a finding.
pub(crate) fn rows(setting: &str, fits: &[Vec<Seen>]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (number, variant) in VARIANTS.iter().enumerate() {
        for (at, name) in WEIGHTS.iter().enumerate() {
            rows.push(Row {
                what: format!("Seen by a drone, {setting}, {}: weight of {name}", variant.name),
                unit: "",
                value: mean(&fits.iter().map(|it| it[number].shares[at]).collect::<Vec<f64>>()),
                range: [f64::NEG_INFINITY, f64::INFINITY],
                source: "for information",
            });
        }
    }
    rows
}

/// What each variant finds, beside what the prototype found: a Markdown table.
pub(crate) fn table(fits: &[Vec<Seen>]) -> String {
    let cell = |number: usize, at: usize| {
        let shares: Vec<f64> = fits.iter().map(|it| it[number].shares[at]).collect();
        let held = fits.iter().filter(|it| it[number].off(at).abs() < HALF).count();
        format!("{} ({:.0} %)", text_of(mean(&shares).as_ref()), 100.0 * held as f64 / fits.len() as f64)
    };
    let row = |(number, variant): (usize, &Variant)| {
        let cells = (0..WEIGHTS.len()).map(|at| cell(number, at));
        let ends = [variant.prototype.unwrap_or_default().to_owned()];
        [variant.name.to_owned()].into_iter().chain(cells).chain(ends).collect()
    };
    let rows: Vec<Vec<String>> = VARIANTS.iter().enumerate().map(row).collect();
    markdown(&["fit", WEIGHTS[0], WEIGHTS[1], WEIGHTS[2], "prototype"], &rows)
}

/// The estimates of all fits as CSV.
pub(crate) fn csv(fits: &[Vec<Seen>]) -> String {
    let mut text = String::from("seed,fit,weight,share,standard_error\n");
    for (fits, seed) in fits.iter().zip(1..) {
        for (variant, seen) in VARIANTS.iter().zip(fits) {
            for ((weight, share), error) in WEIGHTS.iter().zip(seen.shares).zip(seen.errors) {
                text += &format!("{seed},{},{weight},{share},{error}\n", quoted(variant.name));
            }
        }
    }
    text
}
