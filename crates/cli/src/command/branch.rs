//! `laneweave branch`.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use laneweave::Fault;
use laneweave::folder::{BRANCH, Claim, REPORT};
use laneweave::output::write_whole;
use laneweave::record::{Record, SCENARIO};
use laneweave::study::{Column, Format, TableWriter, seconds};
use laneweave_studies::branch::{Differences, Setting, Twins, page};

use super::Call;
use super::complain;
use super::say;

#[derive(Debug, Args)]
pub(crate) struct BranchArguments {
    /// The folder with the results of a run; the run is repeated.
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// The time from which on the change holds, in seconds as in the tables.
    #[arg(long, value_name = "S")]
    at: f64,
    /// The change: a key of all styles (style.speed.weight=2), or of one style (aggressive.follow.jam_gap=3); or
    /// other commands of users (commands=FILE, or commands=none); may be repeated.
    #[arg(long = "set", value_name = "STYLE.KEY=VALUE|commands=FILE")]
    settings: Vec<Setting>,
    /// Folder for the differences [default: OUT/branch].
    #[arg(long, value_name = "DIR")]
    into: Option<PathBuf>,
}

impl BranchArguments {
    pub(crate) fn execute(self, call: &Call) -> Result<(), Fault> {
        let BranchArguments { out, at, settings, into } = self;
        let record = Record::open(&out)?;
        let folder = into.unwrap_or_else(|| out.join(BRANCH));
        if folder.join(SCENARIO).exists() {
            let what = "this folder contains a scenario; the results of a run of it would be mixed with the differences";
            return Err(Fault::new(folder.display(), what, "choose another folder with --into"));
        }
        let mut twins = Twins::part(&record, at, &settings)?;
        let claim = Claim::on(&folder)?;
        claim.clear_differences()?;
        let differences = twins.drive();
        twins.warnings().iter().for_each(|it| complain(format_args!("warning: commands: {it}")));
        let end = format!("{:016x}", twins.base.state_hash());
        if end != record.end.state_hash {
            let what = format!(
                "the run ended with state hash {}, but its repetition with {end}",
                record.end.state_hash
            );
            let remedy = "run it again if its summary.json was changed; otherwise report this as a bug";
            return Err(Fault::new(out.display(), what, remedy));
        }
        let texts: Vec<&str> = settings.iter().map(Setting::text).collect();
        let settings = if texts.is_empty() { "nothing changed".into() } else { texts.join(", ") };
        let mut text = differences.to_text(&settings);
        if differences.are_none() {
            // An empty folder is misleading; one that is not empty stays.
            let _ = fs::remove_dir(&folder);
        } else {
            for (number, path) in
                tables(&differences, &folder, record.scenario.output.format.into())?.iter().enumerate()
            {
                let name = if number == 0 { "files" } else { "" };
                text += &format!("  {name:<17}{}\n", path.display());
            }
            let report = folder.join(REPORT);
            write_whole(&report, &page(&twins, &differences, &settings, &call.line).to_html())?;
            text += &format!("  {:<17}{}\n", "report", report.display());
        }
        say(&text)
    }
}

const VEHICLES: [Column; 8] = [
    Column::integer("vehicle"),
    Column::text("style"),
    Column::text("class"),
    Column::real("since_s"),
    Column::integer("base_lane_changes"),
    Column::integer("branch_lane_changes"),
    Column::real("base_completed_s"),
    Column::real("branch_completed_s"),
];

const INSTANTS: [Column; 7] = [
    Column::real("time_s"),
    Column::integer("on_road"),
    Column::integer("differ"),
    Column::integer("base_lane_changes"),
    Column::integer("branch_lane_changes"),
    Column::real("base_mean_speed_mps"),
    Column::real("branch_mean_speed_mps"),
];

/// Writes the vehicles that differ, and the differences second by second.
fn tables(
    differences: &Differences,
    folder: &std::path::Path,
    format: Format,
) -> Result<Vec<PathBuf>, Fault> {
    let path = |name: &str| folder.join(name).with_extension(format.extension());
    let (vehicles, instants) = (path("differences"), path("instants"));
    let mut table = TableWriter::create(&vehicles, format, &VEHICLES)?;
    for (id, it) in &differences.vehicles {
        let [base, branch] = it.lane_changes;
        let [base_completed, branch_completed] = it.completed_s;
        table.row(&[
            (*id).into(),
            it.style.as_str().into(),
            it.class.into(),
            seconds(it.since_s).into(),
            base.into(),
            branch.into(),
            base_completed.map(seconds).into(),
            branch_completed.map(seconds).into(),
        ])?;
    }
    table.finish()?;
    let mut table = TableWriter::create(&instants, format, &INSTANTS)?;
    for it in &differences.instants {
        let [base, branch] = it.lane_changes.map(|it| it as i64);
        let [base_speed, branch_speed] = it.mean_speed_mps;
        table.row(&[
            seconds(it.time_s).into(),
            it.on_road.into(),
            it.differ.into(),
            base.into(),
            branch.into(),
            base_speed.into(),
            branch_speed.into(),
        ])?;
    }
    table.finish()?;
    Ok(vec![vehicles, instants])
}
