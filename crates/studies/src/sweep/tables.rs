//! The tables of a sweep: a row for each run, and a row for each variant with intervals over its seeds.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use laneweave_scenario::Fault;
use laneweave_study::{Cell, Column, Estimate, Format, Kind, TableWriter, mean};
use serde_json::Value;

use super::row::{Row, measures, own_name};
use super::variant::{Change, Variant};
use super::{Run, Sweep};
use crate::compare::Measure;

/// The names of the tables.
const RUNS: &str = "runs.parquet";
const VARIANTS: &str = "variants.parquet";
/// Up to so many variants are shown on the screen, by these measures.
const SHOWN: usize = 20;
const SHOWN_MEASURES: [&str; 4] = ["mean_speed_kmh", "mean_delay_s", "discretionary_per_veh_km", "completed"];

/// A sweep of which all runs are done.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    /// The table with a row for each run.
    pub runs: PathBuf,
    /// The table with a row for each variant: means over its seeds, with 95 % intervals.
    pub variants: PathBuf,
    /// A few measures of each variant in words, if there are not too many variants.
    pub text: String,
}

/// A key that changes, and the type of its column.
struct Changed {
    key: String,
    kind: Kind,
}

impl Changed {
    fn column(&self) -> Column {
        Column::named(self.key.clone(), self.kind)
    }
}

/// The keys that change: those of rows first, then those of the hypercube and of the grid, each by their names.
fn changed(sweep: &Sweep) -> Vec<Changed> {
    let mut all: Vec<Changed> = Vec::new();
    for change in sweep.plan.variants.iter().flat_map(|it| &it.changes) {
        let kind = match &change.value {
            Value::Number(it) if it.is_i64() => Kind::I64,
            Value::Number(_) => Kind::F64,
            _ => Kind::Text,
        };
        let key = change.key();
        match all.iter_mut().find(|it| it.key == key) {
            None => all.push(Changed { key, kind }),
            Some(it) if it.kind == kind => {}
            Some(it) if it.kind == Kind::Text || kind == Kind::Text => it.kind = Kind::Text,
            Some(it) => it.kind = Kind::F64,
        }
    }
    all
}

/// Writes both tables of a sweep with these rows, in the order of its runs. Programs that end at the same time write
/// the same, each under names of its own first.
///
/// # Errors
/// If they cannot be written.
pub(super) fn write(sweep: &Sweep, rows: &[(&Run, Row)]) -> Result<Swept, Fault> {
    let changed = changed(sweep);
    let notes = [("version", env!("CARGO_PKG_VERSION")), ("plan", &sweep.text)];
    let (runs, variants) = (sweep.folder.table(RUNS), sweep.folder.table(VARIANTS));
    let columns = run_columns(&changed);
    let own = own_name(&runs);
    let mut table = TableWriter::create_with(&own, Format::Parquet, &columns, &notes)?;
    for (run, row) in rows {
        let texts = texts(sweep, run.variant, &changed);
        let mut cells = vec![Cell::Text(&row.key), (run.variant as i64).into()];
        cells.extend(changed.iter().zip(&texts).map(|(it, text)| cell(sweep, run.variant, it, text)));
        cells.push((run.seed as i64).into());
        cells.extend(row.measured.iter().map(|it| Cell::from(*it)));
        cells.push(Cell::Text(&row.state_hash));
        table.row(&cells)?;
    }
    table.finish()?;
    rename(&own, &runs)?;
    let columns = variant_columns(&changed);
    let own = own_name(&variants);
    let mut table = TableWriter::create_with(&own, Format::Parquet, &columns, &notes)?;
    let by_variant: Vec<&[(&Run, Row)]> = rows.chunk_by(|a, b| a.0.variant == b.0.variant).collect();
    for (number, rows) in by_variant.iter().enumerate() {
        let texts = texts(sweep, number, &changed);
        let mut cells = vec![(number as i64).into()];
        cells.extend(changed.iter().zip(&texts).map(|(it, text)| cell(sweep, number, it, text)));
        cells.push((rows.len() as i64).into());
        for at in 0..measures().count() {
            let estimate = estimate(rows, at);
            let width = estimate.as_ref().map(|it| it.half_width).filter(|it| it.is_finite());
            cells.extend([Cell::from(estimate.map(|it| it.mean)), Cell::from(width)]);
        }
        table.row(&cells)?;
    }
    table.finish()?;
    rename(&own, &variants)?;
    Ok(Swept { runs, variants, text: text(sweep, &by_variant) })
}

fn rename(from: &Path, to: &Path) -> Result<(), Fault> {
    fs::rename(from, to).map_err(|error| Fault::refused(to, "written", &error))
}

/// A measure over the runs of a variant.
fn estimate(rows: &[(&Run, Row)], at: usize) -> Option<Estimate> {
    mean(&rows.iter().filter_map(|(_, row)| row.measured[at]).collect::<Vec<f64>>())
}

/// The values of the keys that change as texts, where their columns are texts.
fn texts(sweep: &Sweep, variant: usize, changed: &[Changed]) -> Vec<Option<String>> {
    let text = |it: &Changed| {
        let change = sweep.plan.variants[variant].change(&it.key).filter(|_| it.kind == Kind::Text);
        change.map(Change::value_text)
    };
    changed.iter().map(text).collect()
}

/// The value of a key that changes; it is missing where a variant leaves the key as it is.
fn cell<'t>(sweep: &Sweep, variant: usize, changed: &Changed, text: &'t Option<String>) -> Cell<'t> {
    let value = sweep.plan.variants[variant].change(&changed.key).map(|it| &it.value);
    match changed.kind {
        Kind::Text => text.as_deref().into(),
        Kind::I64 => value.and_then(Value::as_i64).into(),
        Kind::F64 => value.and_then(Value::as_f64).into(),
    }
}

fn run_columns(changed: &[Changed]) -> Vec<Column> {
    let named = [Column::text("key"), Column::integer("variant")];
    let changed = changed.iter().map(Changed::column);
    let measured = measures().map(|it| Column::real(it.column));
    let all = named.into_iter().chain(changed).chain([Column::integer("seed")]);
    all.chain(measured).chain([Column::text("state_hash")]).collect()
}

fn variant_columns(changed: &[Changed]) -> Vec<Column> {
    let width = |it: &Measure| Column::named(format!("{}_half_width", it.column), Kind::F64);
    let measured = measures().flat_map(|it| [Column::real(it.column), width(it)]);
    let changed = changed.iter().map(Changed::column);
    [Column::integer("variant")]
        .into_iter()
        .chain(changed)
        .chain([Column::integer("runs")])
        .chain(measured)
        .collect()
}

/// A few measures of each variant, if there are not too many variants.
fn text(sweep: &Sweep, by_variant: &[&[(&Run, Row)]]) -> String {
    const CELL: usize = 28;
    let mut text = String::new();
    if by_variant.len() > SHOWN {
        return text;
    }
    let variants = &sweep.plan.variants;
    let differs = |it: &Change| {
        variants.iter().any(|other| other.change(&it.key()).is_none_or(|o| o.value != it.value))
    };
    let name =
        |it: &Variant| Variant::of(it.changes.iter().filter(|it| differs(it)).cloned().collect::<Vec<_>>());
    let names: Vec<String> = variants.iter().map(|it| name(it).to_text()).collect();
    let wide = names.iter().map(|it| it.chars().count()).max().unwrap_or(0) + 2;
    let shown: Vec<(usize, &Measure)> =
        measures().enumerate().filter(|it| SHOWN_MEASURES.contains(&it.1.column)).collect();
    // Writing to a string never fails.
    let _ = write!(text, "{:wide$}", "");
    for (_, measure) in &shown {
        let _ = write!(text, "{:>CELL$}", measure.column);
    }
    for (name, rows) in names.iter().zip(by_variant) {
        let _ = write!(text, "\n{name:wide$}");
        for (at, measure) in &shown {
            let digits = measure.digits;
            let cell = estimate(rows, *at).map_or("-".to_owned(), |it| match it.half_width.is_finite() {
                true => format!("{:.digits$} ± {:.digits$}", it.mean, it.half_width),
                false => format!("{:.digits$}", it.mean),
            });
            let _ = write!(text, "{cell:>CELL$}");
        }
    }
    text + "\n"
}
