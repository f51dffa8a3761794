//! What a fit is worth in the world, in words.

use std::fmt::Write;

use super::report::{Score, scores};
use super::{Design, Judged, JudgedMeasure, Predicted};

/// Widths of the columns: of names, of what was recorded, of the fitted style, and of other models.
const NAME: usize = 44;
const RECORDED: usize = 9;
const FITTED: usize = 34;
const OTHER: usize = 10;

/// The keys of the measures whose scores are printed. The report has all of them.
const SCORED: [&str; 7] = [
    "changes",
    "rate_by_density",
    "duration_s",
    "headway_p5_s",
    "inverse_ttc_p95",
    "speed_kmh",
    "pace_s_per_km",
];

impl Judged {
    /// It in words.
    pub fn to_text(&self) -> String {
        let mut out = String::new();
        // Writing to a string never fails.
        let _ = self.write_to(&mut out);
        out
    }

    fn write_to(&self, out: &mut String) -> std::fmt::Result {
        writeln!(
            out,
            "\nIn the world: a style fitted to {:.0} s with {} lane changes drives in the {:.0} s after them,",
            self.fitted_s, self.events_used, self.third.simulated_s
        )?;
        writeln!(
            out,
            "in which {} lane changes were recorded; {} rollouts of each model, * not as recorded",
            self.third.events, self.rollouts
        )?;
        writeln!(
            out,
            "theta is moved by {:.2}, so that the style changes lanes as often as recorded before",
            self.theta_moved_by
        )?;
        self.write_measures(out, &self.third.measures)?;
        for (number, it) in self.models.iter().enumerate().skip(1) {
            writeln!(out, "{} differs from the fitted style in: {}", it.model, self.differences(number))?;
        }
        let Design { simulations, simulated_s, events, measures, .. } = &self.snapshots;
        writeln!(
            out,
            "\nRollouts from recorded snapshots: {simulations}, {simulated_s:.0} s with {events} lane changes"
        )?;
        self.write_measures(out, measures)?;
        writeln!(out, "\nScores of the predictions, the less the better: CRPS, and of counts nats")?;
        self.write_head(out, "", OTHER)?;
        for (of, measures) in [("last third", &self.third.measures), ("snapshots", measures)] {
            writeln!(out, "  {of}")?;
            self.write_scores(out, measures)?;
        }
        Ok(())
    }

    fn write_head(&self, out: &mut String, recorded: &str, fitted: usize) -> std::fmt::Result {
        write!(out, "  {:NAME$}{recorded:>RECORDED$}", "")?;
        for (number, it) in self.models.iter().enumerate() {
            let width = if number == 0 { fitted } else { OTHER };
            write!(out, "{:>width$}", it.model)?;
        }
        writeln!(out)
    }

    fn write_measures(&self, out: &mut String, measures: &[JudgedMeasure]) -> std::fmt::Result {
        self.write_head(out, "recorded", FITTED)?;
        for JudgedMeasure { name, recorded, simulated, .. } in measures {
            let recorded = recorded.map_or("–".to_owned(), |it| format!("{it:.2}"));
            write!(out, "  {name:NAME$}{recorded:>RECORDED$}")?;
            for (number, it) in simulated.iter().enumerate() {
                match number {
                    0 => write!(out, "{:>FITTED$}", it.to_text())?,
                    _ => write!(out, "{:>OTHER$}", it.median_text())?,
                }
            }
            writeln!(out)?;
        }
        Ok(())
    }

    fn write_scores(&self, out: &mut String, measures: &[JudgedMeasure]) -> std::fmt::Result {
        for Score { name, values, .. } in
            scores(measures).iter().filter(|it| SCORED.contains(&it.key.as_str()))
        {
            write!(out, "  {name:NAME$}{:RECORDED$}", "")?;
            for it in values {
                write!(out, "{:>OTHER$}", it.map_or("–".to_owned(), |it| format!("{it:.2}")))?;
            }
            writeln!(out)?;
        }
        Ok(())
    }

    /// The measures that tell a model apart from the fitted style, in words.
    pub fn differences(&self, model: usize) -> String {
        self.names(|it| it.simulated[model].is_told_apart)
    }

    /// The measures whose recorded values lie outside of what a model predicts, in words.
    pub fn misses(&self, model: usize) -> String {
        self.names(|it| it.simulated[model].is_missed())
    }

    /// The names of some measures.
    fn names(&self, is_named: impl Fn(&JudgedMeasure) -> bool) -> String {
        let named = self.third.measures.iter().filter(|it| is_named(it));
        let names: Vec<&str> = named.map(|it| it.name.split(" [").next().unwrap_or(&it.name)).collect();
        if names.is_empty() { "nothing that was measured".to_owned() } else { names.join("; ") }
    }
}

impl Predicted {
    /// The median with the interval, marked if the recorded value lies outside.
    pub(super) fn to_text(&self) -> String {
        match (self.median, self.interval) {
            (Some(median), Some([low, high])) => {
                format!("{median:.2} ({low:.2} to {high:.2}){}", self.mark())
            }
            _ => "–".to_owned(),
        }
    }

    fn median_text(&self) -> String {
        self.median.map_or("–  ".to_owned(), |it| format!("{it:.2}{}", self.mark()))
    }

    fn mark(&self) -> &'static str {
        if self.is_missed() { " *" } else { "  " }
    }
}
