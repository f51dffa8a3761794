//! What recordings can tell of their drivers, before anything is fitted.

use std::collections::BTreeMap;
use std::fmt::Write;

use laneweave_calibration::observe::{ObservedChange, Unused};
use laneweave_calibration::{DesireModel, expected};
use serde::Serialize;

use super::Observed;

/// What recordings can tell. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// Seconds in which drivers could change to at least one side.
    pub observations: usize,
    /// Vehicles with such seconds.
    pub drivers: usize,
    /// Number of recordings, and of sites.
    pub recordings: usize,
    /// Number of different maps.
    pub sites: usize,
    /// Of several files, what was joined, what was not and why, and what is left out.
    pub windows: Vec<String>,
    /// Distance that vehicles drove [veh·km].
    pub veh_km: f64,
    /// Time for which they were seen [veh·h].
    pub veh_h: f64,
    /// All lane changes.
    pub events: usize,
    /// Those that can be used.
    pub events_used: usize,
    /// All lane changes by kind.
    pub events_by_kind: BTreeMap<&'static str, usize>,
    /// Those that cannot be used, by reason.
    pub unused: BTreeMap<&'static str, usize>,
    /// What is cut off: vehicles that were first seen in a change, and changes after which the vehicle was seen for too
    /// short a time to see it return.
    pub censored: BTreeMap<&'static str, usize>,
    /// Share of the drivers who were seen driving freely, so that their desired speed is known.
    pub drivers_with_known_desired_speed: f64,
    /// The weights, with what is expected of them.
    pub expected: Vec<ExpectedWeight>,
    /// What the recordings do not tell, whatever is fitted.
    pub not_identified: Vec<&'static str>,
}

/// What is expected of a weight.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ExpectedWeight {
    /// Its name.
    pub name: &'static str,
    /// Its prior value.
    pub prior: f64,
    /// The standard error that a plain logit would have; none if its yield never differs.
    pub standard_error: Option<f64>,
    /// Lane changes that would be needed for the prior weight ± 25 %.
    pub events_for_a_quarter: Option<f64>,
    /// The same as a distance, at the rate of these recordings [veh·km].
    pub veh_km_for_a_quarter: Option<f64>,
}

/// How often each of `names` occurs.
fn counts<'a>(names: impl Iterator<Item = &'a str>) -> BTreeMap<&'a str, usize> {
    let mut counts = BTreeMap::new();
    names.for_each(|it| *counts.entry(it).or_default() += 1);
    counts
}

impl Plan {
    /// What was observed can tell.
    pub(super) fn of(observed: &Observed) -> Plan {
        let observations = &observed.observations;
        let changes = &observations.changes;
        let used = observations.used().count();
        let prior = observed.weights();
        let model = DesireModel::Mcdm { beta: prior.beta };
        let design = observations.design(&model);
        let expected = expected(&design, &model.terms(), &prior.terms(), used);
        let per_change = observations.veh_km / used.max(1) as f64;
        let expected: Vec<ExpectedWeight> = expected
            .into_iter()
            .zip(prior.terms())
            .map(|(it, prior)| {
                let finite = |value: f64| value.is_finite().then_some(value);
                ExpectedWeight {
                    name: it.name,
                    prior,
                    standard_error: finite(it.standard_error),
                    events_for_a_quarter: finite(it.changes_for_a_quarter),
                    veh_km_for_a_quarter: finite((it.changes_for_a_quarter * per_change).round()),
                }
            })
            .collect();
        let is_known = observations.drivers.iter().filter(|it| it.desired.is_shown).count();
        let drivers = observations.drivers.len();
        Plan {
            observations: observations.seconds(),
            drivers,
            recordings: observations.recordings.len(),
            sites: observations.sites as usize,
            windows: observed.sources.windows.clone(),
            veh_km: thousandths(observations.veh_km),
            veh_h: thousandths(observations.veh_h),
            events: changes.len(),
            events_used: used,
            events_by_kind: counts(changes.iter().map(|it| it.kind.name())),
            unused: counts(changes.iter().filter_map(|it| it.unused.map(Unused::name))),
            censored: censored(changes),
            drivers_with_known_desired_speed: thousandths(is_known as f64 / drivers.max(1) as f64),
            not_identified: unknowable(&expected),
            expected,
        }
    }

    /// The plan in words.
    pub fn to_text(&self) -> String {
        let mut out = String::new();
        // Writing to a string never fails.
        let _ = self.write_to(&mut out);
        out
    }

    pub(super) fn write_counts(&self, out: &mut String) -> std::fmt::Result {
        writeln!(
            out,
            "{} of {}: {:.1} veh-km, {:.2} veh-h",
            counted(self.recordings, "recording"),
            counted(self.sites, "site"),
            self.veh_km,
            self.veh_h
        )?;
        for it in &self.windows {
            writeln!(out, "{it}")?;
        }
        writeln!(
            out,
            "{} drivers could change lanes in {} seconds; {:.0} % of them show their desired speed",
            self.drivers,
            self.observations,
            100.0 * self.drivers_with_known_desired_speed
        )?;
        let list = |counts: &BTreeMap<&'static str, usize>| {
            let each = counts.iter().map(|(name, count)| format!("{count} {}", name.replace('_', " ")));
            each.collect::<Vec<String>>().join(", ")
        };
        writeln!(out, "{} lane changes: {}", self.events, list(&self.events_by_kind))?;
        let unused = if self.unused.is_empty() {
            String::new()
        } else {
            format!("; not used: {}", list(&self.unused))
        };
        writeln!(out, "{} of them are used{unused}", self.events_used)?;
        writeln!(out, "cut off: {}", list(&self.censored))
    }

    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        self.write_counts(out)?;
        writeln!(out, "\n  weight      prior   expected error   for ± 25 %: lane changes     veh-km")?;
        for it in &self.expected {
            let cell = |value: Option<f64>, digits: usize| {
                value.map_or("unknown".to_owned(), |it| format!("{it:.digits$}"))
            };
            writeln!(
                out,
                "  {:9} {:>7.2} {:>16} {:>26} {:>10}",
                it.name,
                it.prior,
                cell(it.standard_error, 2),
                cell(it.events_for_a_quarter, 0),
                cell(it.veh_km_for_a_quarter, 0)
            )?;
        }
        writeln!(out, "\nWhatever is fitted, this does not tell: {}.", self.not_identified.join(", "))?;
        writeln!(
            out,
            "Expected errors are those of a plain logit; waiting, unknown desired speeds and routes cost more."
        )
    }
}

/// A number of things, in words.
fn counted(count: usize, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

fn thousandths(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}

fn censored(changes: &[ObservedChange]) -> BTreeMap<&'static str, usize> {
    let begun = changes.iter().filter(|it| it.unused == Some(Unused::BegunBefore)).count();
    let shortly = changes.iter().filter(|it| !it.shows_return).count();
    let short = changes.iter().filter(|it| it.duration.is_none()).count();
    BTreeMap::from([
        ("first_seen_in_a_change", begun),
        ("seen_too_shortly_to_show_a_return", shortly),
        ("duration_not_seen", short),
    ])
}

/// What no fit to such recordings can tell: the route, whose yield is one with that of speed or hidden by the unknown
/// destinations, and weights whose yields never differ.
fn unknowable(expected: &[ExpectedWeight]) -> Vec<&'static str> {
    let constant = expected.iter().filter(|it| it.standard_error.is_none() && it.name != "keeping");
    let alpha_and_route = ["route", "alpha"];
    alpha_and_route.into_iter().chain(constant.map(|it| it.name)).collect()
}
