//! The valid ranges of the numbers of a style.

/// The values that a number may have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) unit: &'static str,
}

/// Ranges by key; a number that is not listed, such as a weight or a threshold, may be any finite number. The limits
/// are ours: wide enough for every driver, too narrow for a wrong unit.
const RANGES: &[(&str, Range)] = &[
    ("speed_factor", range(0.1, 3.0, "")),
    ("follow.acceleration", range(0.1, 10.0, "m/s²")),
    ("follow.deceleration", range(0.1, 10.0, "m/s²")),
    ("follow.time_gap", range(0.1, 10.0, "s")),
    ("follow.jam_gap", range(0.0, 20.0, "m")),
    ("follow.exponent", range(1.0, 20.0, "")),
    ("follow.sensitivity", range(0.01, 10.0, "1/s")),
    ("follow.relative_sensitivity", range(0.0, 10.0, "1/s")),
    ("follow.range", range(1.0, 1000.0, "m")),
    ("follow.coolness", range(0.0, 1.0, "")),
    ("follow.adjustment_time", range(0.1, 100.0, "s")),
    ("follow.acceleration_range", range(0.5, 1000.0, "m")),
    ("follow.braking_time", range(0.1, 100.0, "s")),
    ("follow.braking_range", range(1.0, 10_000.0, "m")),
    ("follow.reaction_time", range(0.1, 10.0, "s")),
    ("follow.leader_deceleration", range(0.1, 10.0, "m/s²")),
    ("change.sigma", range(0.0, f64::INFINITY, "")),
    ("change.hazard", range(0.0, 1.0, "")),
    ("change.politeness", range(0.0, 10.0, "")),
    ("change.threshold", range(-10.0, 10.0, "m/s²")),
    ("change.bias", range(-10.0, 10.0, "m/s²")),
    ("change.safe_deceleration", range(0.1, 8.0, "m/s²")),
    ("change.critical_speed", range(0.0, 100.0, "m/s")),
    ("change.urgency", range(0.0, 100.0, "m/s²")),
    ("change.free", range(0.01, 1.0, "")),
    ("change.synchronize", range(0.01, 1.0, "")),
    ("change.cooperate", range(0.01, 1.0, "")),
    ("change.speed_gain", range(0.1, 100.0, "m/s")),
    ("change.congested_speed", range(0.0, 100.0, "m/s")),
    ("change.acceleration", range(0.1, 10.0, "m/s²")),
    ("change.route.penalty", range(0.0, 1e6, "s")),
    ("change.route.reference", range(1.0, 1e6, "s")),
    ("change.comfort.beta", range(0.0, 20.0, "")),
    ("change.returning.alpha", range(0.0, 100.0, "1/(s m)")),
    ("change.returning.needed_gap", range(0.0, 60.0, "s")),
    ("change.returning.change_time", range(0.0, 60.0, "s")),
    ("change.returning.trial_time", range(0.1, 60.0, "s")),
    ("safety.min_gap", range(0.1, 50.0, "m")),
    ("safety.closing_growth", range(0.0, 1.0, "s/m")),
    ("safety.min_time_to_collision", range(0.0, 60.0, "s")),
    ("safety.max_deceleration", range(0.1, 8.0, "m/s²")),
    ("attention.epoch", range(0.1, 60.0, "s")),
    ("attention.concentrated_for", range(0.0, 1e5, "s")),
    ("attention.inattentive_for", range(0.0, 1e5, "s")),
    ("attention.inattentive.epoch", range(0.1, 60.0, "s")),
    ("attention.inattentive.sight", range(10.0, 295.0, "m")),
    ("attention.inattentive.comfort", range(0.0, 100.0, "")),
    ("manner.change_duration", range(1.0, 20.0, "s")),
    ("manner.pressed_duration", range(1.0, 20.0, "s")),
    ("manner.patience", range(0.1, 3600.0, "s")),
    ("manner.calm", range(0.0, 3600.0, "s")),
    ("manner.adjust_deceleration", range(0.0, 8.0, "m/s²")),
    ("manner.yield_deceleration", range(0.0, 8.0, "m/s²")),
    ("manner.tightest", range(0.05, 1.0, "")),
    ("manner.relaxation", range(0.1, 3600.0, "s")),
    ("yielding.critical_gap", range(0.0, 60.0, "s")),
    ("yielding.patience", range(0.1, 3600.0, "s")),
    ("guidance.route_error", range(0.0, 2.0, "")),
    ("guidance.indifference", range(0.0, 1e5, "s")),
    ("guidance.habit", range(0.0, 1.0, "")),
    ("guidance.compliance", range(0.0, 1.0, "")),
    ("guidance.turn_s", range(0.0, 3600.0, "s")),
    ("guidance.light_s", range(0.0, 3600.0, "s")),
];

const fn range(from: f64, to: f64, unit: &'static str) -> Range {
    Range { from, to, unit }
}

impl Range {
    /// The range of the number at `key`.
    pub(super) fn of(key: &str) -> Range {
        let listed = RANGES.iter().find(|(name, _)| *name == key);
        listed.map_or(range(f64::NEG_INFINITY, f64::INFINITY, ""), |(_, range)| *range)
    }

    /// Whether all values from `least` to `largest` are inside.
    pub(super) fn holds(&self, least: f64, largest: f64) -> bool {
        self.from <= least && largest <= self.to
    }

    /// The range in words, as a remedy.
    pub(super) fn advice(&self) -> String {
        let Range { from, to, unit } = self;
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        match (from.is_finite(), to.is_finite()) {
            (true, true) => format!("choose {from} to {to}{unit}"),
            (true, false) => format!("choose {from}{unit} or more"),
            _ => "choose a finite number".into(),
        }
    }
}
