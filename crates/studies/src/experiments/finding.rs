//! What an experiment found.

use laneweave::study::Estimate;

/// What an experiment found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finding {
    /// In words, as Markdown.
    pub text: String,
    /// Tables as CSV, by name.
    pub tables: Vec<(String, String)>,
    /// Figures as SVG, by name.
    pub figures: Vec<(String, String)>,
    /// What was measured, beside what it should be.
    pub rows: Vec<Row>,
}

/// A measured value beside the range in which it should be.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What is measured.
    pub what: String,
    /// Its unit.
    pub unit: &'static str,
    /// The value over seeds; `None` if there was nothing to measure.
    pub value: Option<Estimate>,
    /// The least and the greatest value that it should have.
    pub range: [f64; 2],
    /// Where the range comes from.
    pub source: &'static str,
}

impl Row {
    /// Whether the value is in its range.
    pub fn is_inside(&self) -> bool {
        let [least, most] = self.range;
        self.value.is_some_and(|it| it.mean >= least && it.mean <= most)
    }

    /// The value with its 95 % interval.
    fn value_text(&self) -> String {
        text_of(self.value.as_ref())
    }

    fn range_text(&self) -> String {
        match self.range {
            [f64::NEG_INFINITY, f64::INFINITY] => "anything".into(),
            [f64::NEG_INFINITY, most] => format!("at most {}", number(most)),
            [least, f64::INFINITY] => format!("at least {}", number(least)),
            [least, most] => format!("{} to {}", number(least), number(most)),
        }
    }
}

/// A value with its 95 % interval.
pub(crate) fn text_of(value: Option<&Estimate>) -> String {
    match value {
        None => "nothing to measure".into(),
        Some(it) if it.replications < 2 => number(it.mean),
        Some(it) => format!("{} ± {}", number(it.mean), number(it.half_width)),
    }
}

/// A Markdown table with this header.
pub(crate) fn markdown(header: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let head: Vec<String> = header.iter().map(|it| (*it).to_owned()).collect();
    let body: String = rows.iter().map(|it| line(it)).collect();
    format!("{}|{}\n{body}", line(&head), "---|".repeat(header.len()))
}

/// A number with three digits that count.
fn number(value: f64) -> String {
    let digits = if value == 0.0 { 0 } else { (2 - value.abs().log10().floor() as i32).clamp(0, 4) };
    format!("{value:.*}", digits as usize)
}

/// The `rows` as a Markdown table, and how many of them are inside their ranges.
pub(crate) fn table_of(rows: &[Row]) -> String {
    let mut text = String::from(
        "| what | measured (95 % interval) | should be | inside | source |\n|---|---|---|---|---|\n",
    );
    for row in rows {
        let inside = if row.is_inside() { "yes" } else { "**no**" };
        let what =
            if row.unit.is_empty() { row.what.clone() } else { format!("{} [{}]", row.what, row.unit) };
        text += &format!(
            "| {what} | {} | {} | {inside} | {} |\n",
            row.value_text(),
            row.range_text(),
            row.source
        );
    }
    let inside = rows.iter().filter(|it| it.is_inside()).count();
    text + &format!("\n{inside} of {} values are inside their ranges.\n", rows.len())
}

/// A value as three cells of CSV: mean, half of its 95 % interval if there is one, number of replications.
pub(crate) fn cells_of(value: &Estimate) -> String {
    let Estimate { mean, half_width, replications, .. } = value;
    let half_width = if half_width.is_finite() { half_width.to_string() } else { String::new() };
    format!("{mean},{half_width},{replications}")
}

/// A text as a cell of CSV.
pub(crate) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

/// The `rows` as CSV.
pub(crate) fn csv_of(rows: &[Row]) -> String {
    let mut text = String::from("what,unit,mean,half_width,replications,least,most,inside,source\n");
    for row in rows {
        let value = row.value.as_ref().map_or(",,".into(), cells_of);
        let [least, most] = row.range;
        text += &format!(
            "{},{},{value},{least},{most},{},{}\n",
            quoted(&row.what),
            quoted(row.unit),
            row.is_inside(),
            quoted(row.source)
        );
    }
    text
}
