//! The report of a replay.

use laneweave_results::report::{Align, Figure, Page, Section, Table, counted};
use laneweave_study::{Sheet, TimeLine, over_time};

use super::{Matched, PartedAfter, ReplayReport};

/// The report of a replay of the recording with this name, made by `command`.
pub fn page(report: &ReplayReport, recording: &str, command: &str) -> Page {
    let lead = format!(
        "Recorded vehicles beside drivers who react, replayed by laneweave {}. What a driver does up to a time depends only on what \
         was recorded up to that time.",
        env!("CARGO_PKG_VERSION")
    );
    let facts = [
        ("Command", command.to_owned()),
        ("Recording", recording.to_owned()),
        ("Time", format!("{:.1} s in steps of {} s", report.duration_s, report.step_s)),
        ("Recorded vehicles", counted(report.recorded as u64)),
        ("Of them drivers who react", counted(report.reactive as u64)),
        ("Chosen, but in no lane that leads on", counted(report.never_in_a_lane as u64)),
    ];
    let facts = facts.map(|(name, value)| (name.to_owned(), value)).to_vec();
    let page = Page::new("Replay of a recording", lead)
        .section(Section::new("what", "What was replayed").facts(facts));
    if report.reactive == 0 {
        return page;
    }
    page.section(
        Section::new("parting", "How far drivers part from the record")
            .figures(vec![
                figure(report, "Speed [m/s]", "Difference of the speeds", |it| it.speed_mps),
                figure(report, "Distance [m]", "Distance from the recorded place", |it| it.distance_m),
            ])
            .table(parting(report)),
    )
    .section(Section::new("collisions", "Collisions, by fault").table(collisions(report)).text(
        "A recorded vehicle does not react: it drives through a driver who is slower than the recorded one was. A vehicle that \
         alone changes lanes when two touch, or has done so in the 2 s before, is at fault; otherwise the one behind.",
    ))
    .section(Section::new("score", "How likely the record is").table(scores(report)).text(
        "Means over the drivers of the logarithm of the density of what was recorded, in nats: of the speed, the acceleration and \
         the gap at every full second up to 10 s after they became drivers, and of the time of the first lane change. The density \
         is that of the rollouts: normal kernels around their values (1 m/s, 0.5 m/s², 20 % of the gap), with 1 % of a uniform \
         distribution; for lane changes, shares of classes of 2 s. A higher score is better. The difference from the first model \
         is paired by driver, with its 95 % interval.",
    ))
}

fn figure(report: &ReplayReport, label: &str, title: &str, of: fn(&PartedAfter) -> f64) -> Figure {
    let line = |it: &Matched| TimeLine {
        name: it.model.into(),
        points: it.parting.after.iter().map(|it| [it.time_s, of(it)]).collect(),
    };
    let lines: Vec<TimeLine> = report.models.iter().map(line).collect();
    let drivers = report.models.first().map_or(0, |it| it.parting.drivers);
    Figure {
        drawn: over_time(Sheet::Column, label, &lines),
        title: title.into(),
        caption: format!(
            "Means over the drivers and rollouts, against the time since they became drivers. n = {} drivers that were recorded for 5 s \
             or more, over all rollouts.",
            counted(drivers as u64)
        ),
    }
}

fn parting(report: &ReplayReport) -> Table {
    let columns = [
        ("model", Align::Words),
        ("rollouts", Align::Numbers),
        ("drivers", Align::Numbers),
        ("parted by more than 2 m/s within 5 s [%]", Align::Numbers),
    ];
    let mut table = Table::new("Drivers that were recorded for 5 s or more, over all rollouts.", &columns);
    for Matched { model, rollouts, parting, .. } in &report.models {
        let share = format!("{:.1}", 100.0 * parting.parted_share);
        table.row([model.to_string(), rollouts.to_string(), parting.drivers.to_string(), share]);
    }
    table
}

fn collisions(report: &ReplayReport) -> Table {
    let columns = [
        ("model", Align::Words),
        ("by a driver", Align::Numbers),
        ("by a recorded vehicle", Align::Numbers),
        ("between drivers", Align::Numbers),
        ("between recorded vehicles", Align::Numbers),
    ];
    let mut table = Table::new("Pairs that touched, in the mean of the rollouts.", &columns);
    for Matched { model, collisions: it, .. } in &report.models {
        let counts = [it.by_reactive, it.by_recorded, it.between_reactive, it.between_recorded];
        table.row([model.to_string()].into_iter().chain(counts.map(|it| format!("{it:.1}"))));
    }
    table
}

fn scores(report: &ReplayReport) -> Table {
    let columns = [
        ("model", Align::Words),
        ("drivers", Align::Numbers),
        ("speed", Align::Numbers),
        ("acceleration", Align::Numbers),
        ("gap", Align::Numbers),
        ("lane change", Align::Numbers),
        ("whole", Align::Numbers),
        ("difference from the first", Align::Numbers),
    ];
    let mut table = Table::new("Mean scores [nats].", &columns);
    for Matched { model, score, difference, .. } in &report.models {
        let parts = [score.speed, score.acceleration, score.gap, score.lane_change, score.whole];
        let difference =
            difference.map_or("–".into(), |it| format!("{:+.3} ± {:.3}", it.mean, it.half_width));
        let cells = [model.to_string(), score.drivers.to_string()].into_iter();
        table.row(cells.chain(parts.map(|it| format!("{it:.3}"))).chain([difference]));
    }
    table
}
