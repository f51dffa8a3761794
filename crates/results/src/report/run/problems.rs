//! Problems and possible misunderstandings, with the remedy where there is one; and the methods of measurement.

use laneweave_maps::Problem;
use laneweave_scenario::Remark;

use super::{RunReport, brakings, incidents};
use crate::outcome::Summary;
use crate::report::{Align, Section, Table, counted};

/// Kinds of problems of the map that are listed.
const MOST_KINDS: usize = 15;
/// A run shorter than this has no complete box [s].
const BOX: f64 = 60.0;

pub(super) fn section(run: &RunReport) -> Section {
    use Align::{Numbers, Words};
    let columns = [("what", Words), ("count", Numbers), ("remedy", Words)];
    let mut of_run = Table::new("Of the run.", &columns);
    for (what, count, remedy) in run_problems(run, run.summary) {
        of_run.row([what.to_owned(), count, remedy]);
    }
    let mut odd = Table::new(
        "Of the map: properties that make its traffic unusual.",
        &[("what", Words), ("remedy", Words)],
    );
    for Remark { what, remedy } in &run.about.remarks {
        odd.row([what.clone(), remedy.clone()]);
    }
    let kinds = Problem::kinds(&run.about.problems);
    let total = counted(run.about.problems.len() as u64);
    let caption = match kinds.len() {
        0..=MOST_KINDS => format!("Of the map: {total} elements that could not be used as they are."),
        more => format!(
            "Of the map: {total} elements that could not be used as they are; {MOST_KINDS} of {more} kinds, laneweave check lists all."
        ),
    };
    let mut of_map =
        Table::new(caption, &[("what", Words), ("count", Numbers), ("example", Words), ("remedy", Words)]);
    for (first, count) in kinds.into_iter().take(MOST_KINDS) {
        let Problem { element, line, what, remedy } = first;
        let place = line.map_or(element.clone(), |line| format!("{element} (line {line})"));
        of_map.row([what.clone(), counted(count), place, remedy.clone()]);
    }
    Section::new("problems", "Problems and remedies")
        .table_unless_empty(of_run, "The run had no problems.")
        .table_unless_empty(incidents::table(run), "")
        .table_unless_empty(brakings::table(run), "")
        .table_unless_empty(odd, "")
        .table_unless_empty(
            of_map,
            "No element of the map was left out when it was read; laneweave check examines the map in more detail.",
        )
}

/// What is counted of a run, each with its name and the remedy.
fn counts(summary: &Summary) -> [(u64, &'static str, &'static str); 6] {
    [
        (
            summary.stuck,
            "Vehicles stuck for 300 s",
            "find the places in trajectories; reduce the demand, or change signal programs or priorities",
        ),
        (
            summary.emergency_brakings,
            "Emergency brakings",
            "find the strongest decelerations in trajectories; use a style with larger gaps, or a shorter step",
        ),
        (
            summary.hard_brakings,
            "Hard brakings, beyond 4 m/s²",
            "see their places below; use a style with larger gaps or with comfortable_deceleration, or look at the map there",
        ),
        (
            summary.missed_turns,
            "Missed turns",
            "the road before the turn may be too short or too crowded for the lane changes: reduce the demand, or increase the weights of the incentives route and urgency",
        ),
        (
            summary.lost,
            "Lost drivers",
            "no route leads from their position to any exit, as on a lane that ends without an adjacent lane: correct the map there, or give other exits in the demand",
        ),
        (
            summary.waiting_to_enter,
            "Vehicles waiting to enter at the end",
            "fewer vehicles can enter than the demand: see the causes of the queues above; reduce the demand, or remove the causes",
        ),
    ]
}

fn run_problems(run: &RunReport, summary: &Summary) -> Vec<(&'static str, String, String)> {
    let mut found = incidents::problems(run);
    let mut note = |is_there: bool, what, count: String, remedy: &str| {
        if is_there {
            found.push((what, count, remedy.to_owned()));
        }
    };
    for (count, what, remedy) in counts(summary) {
        note(count > 0, what, counted(count), remedy);
    }
    let demand_is_higher = summary.demand_veh_h > summary.queues_from_veh_h;
    let share = format!("{:.0} against {:.0} veh/h", summary.demand_veh_h, summary.queues_from_veh_h);
    note(
        demand_is_higher,
        "Demand above what the map bears",
        share,
        "queues grow as long as this lasts: reduce the demand, or study the run as congestion",
    );
    note(
        summary.entered == 0,
        "No vehicle entered",
        "–".into(),
        "increase the demand or the duration, or remove what blocks the queues",
    );
    note(summary.interrupted, "The run was stopped early", "–".into(), "resume it, or run it again");
    note(
        summary.duration_s < BOX,
        "The run is shorter than a box of 60 s",
        "–".into(),
        "use a longer duration: without a complete box there are no rates and no fundamental diagram",
    );
    note(
        run.about.times[1] == 0.0 && summary.entered > 0,
        "No warm-up: the road was empty at the beginning",
        "–".into(),
        "results for steady traffic need a warm-up (--warmup) of about one trip time",
    );
    found
}

/// The section on the methods of measurement.
pub(super) fn method() -> Section {
    Section::new("method", "How it was measured")
        .text(
            "A lane change counts once, when the centre of the vehicle crosses the line. Density, flow and speed follow Edie's \
             definitions (1963) in boxes: sections of about 500 m, each with all its parallel lanes, and whole minutes. Sections \
             with less than 200 m of lane, and an incomplete last minute, are left out. A lane change counts for the section that \
             it leaves.",
        )
        .text(
            "Intervals are at 95 %: exact Poisson intervals (Garwood, 1936) for counts, Student's for means over boxes or trips. \
             Successive samples of one vehicle are not independent, so sampled values have no interval. All intervals are of this \
             run only. Another seed gives other traffic; only several runs show the variation between runs.",
        )
        .text(
            "All counts are of the measured time after the warm-up. The same map, scenario, seed and version give the same report, bit \
             for bit, on any number of threads.",
        )
}
