//! The report of a replay.

use laneweave_network::Network;
use laneweave_results::report::{Align, Figure, Page, Section, Table, area, counted};
use laneweave_study::{Area, MarkAt, Marks, Sheet, TimeLine, map, over_time};

use super::{Example, HandedOver, LateStart, Matched, Mean, PartedAfter, ReplayReport};

/// The report of a replay of the recording with this name on a network, made by `command`.
pub fn page(report: &ReplayReport, network: &Network, recording: &str, command: &str) -> Page {
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
    page.section(as_recorded(report, network)).section(
        Section::new("parting", "How far drivers part from the record")
            .figures(
                [
                    Some(figure(report, "Speed [m/s]", "Difference of the speeds", |it| it.speed_mps)),
                    Some(distances(report)),
                    report.example.as_ref().map(|it| example(it, report.step_s)),
                ]
                .into_iter()
                .flatten()
                .collect(),
            )
            .table(parting(report)),
    )
    .section(Section::new("collisions", "Collisions, by fault").table(collisions(report)).text(
        "A vehicle that alone changes lanes when two touch, or has done so in the 2 s before, is at fault; otherwise the one behind.",
    ))
    .section(Section::new("score", "How likely the record is").table(scores(report)).text(
        "Means over the drivers of the logarithm of the density of what was recorded, in nats: of the speed, the acceleration and \
         the gap at every full second up to 10 s after they became drivers, and of the time of the first lane change. The density \
         is that of the rollouts: normal kernels around their values (1 m/s, 0.5 m/s², 20 % of the gap), with 1 % of a uniform \
         distribution; for lane changes, shares of classes of 2 s. A higher score is better. The difference from the first model \
         is paired by driver, with its 95 % interval.",
    ))
}

/// How much of the replay is as recorded.
fn as_recorded(report: &ReplayReport, network: &Network) -> Section {
    let section = Section::new("recorded", "How much is as recorded").text(
        "A recorded vehicle heeds somebody who is not where the recording has him when it would have to brake for him by 2 m/s² more \
         than its record, or when the two would touch within 3 s. It then goes on along its recorded path behind whoever is ahead. \
         It is handed over as soon as it is more than .3 m behind its record, until it has caught up. A driver is compared with its \
         record until somebody is handed over because of it. It is taken off the road when its record ends.",
    );
    let columns = [
        ("model", Align::Words),
        ("contacts a driver", Align::Numbers),
        ("hand-overs per veh-km", Align::Numbers),
        ("time handed over [%]", Align::Numbers),
        ("time of drivers compared [%]", Align::Numbers),
        ("taken off", Align::Numbers),
        ("late or behind", Align::Numbers),
        ("never came", Align::Numbers),
    ];
    let mut table =
        Table::new("Means of the rollouts, with 95 % intervals where there are several.", &columns);
    for Matched { model, contacts_per_driver, hand_overs: it, .. } in &report.models {
        let figures = [
            interval(*contacts_per_driver, 1.0),
            interval(it.per_veh_km, 1.0),
            interval(it.share, 100.0),
            interval(it.compared_share, 100.0),
            format!("{:.1}", it.taken_off),
            format!("{:.1}", it.late),
            format!("{:.1}", it.never_came),
        ];
        table.row([model.to_string()].into_iter().chain(figures));
    }
    let section = section.table(table).figures(vec![places(report, network)]);
    if report.late.is_empty() { section } else { section.table(late(report)) }
}

fn interval(mean: Option<Mean>, scale: f64) -> String {
    let Some(Mean { mean, half_width }) = mean else { return "–".into() };
    match half_width {
        Some(half) => format!("{:.2} ± {:.2}", scale * mean, scale * half),
        None => format!("{:.2}", scale * mean),
    }
}

/// Where vehicles were handed over in the first rollout.
fn places(report: &ReplayReport, network: &Network) -> Figure {
    let areas: Vec<Area> = network.lanelets.iter().map(area).collect();
    let mark = |it: &HandedOver| MarkAt { area: String::new(), at: it.at_m, value: it.from_s, weight: 1.0 };
    let marks = Marks {
        kind: "handed over".into(),
        key: format!("handed over ({})", counted(report.handed_over.len() as u64)),
        quantity: "time [s]".into(),
        series: 1,
        largest: 1.0,
        marks: report.handed_over.iter().map(mark).collect(),
    };
    Figure {
        drawn: map(&areas, None, &[marks]),
        title: "Hand-overs on the map".into(),
        caption: format!(
            "Where recorded vehicles left their records in the first rollout. North is up. n = {}.",
            counted(report.handed_over.len() as u64)
        ),
    }
}

fn late(report: &ReplayReport) -> Table {
    let columns = [
        ("vehicle of the recording", Align::Numbers),
        ("late [s]", Align::Numbers),
        ("behind its place [m]", Align::Numbers),
        ("why", Align::Words),
    ];
    let mut table =
        Table::new("Drivers of the first rollout who began later than their records, or behind.", &columns);
    for LateStart { recorded, late_s, behind_m, because_of } in &report.late {
        let why = match because_of {
            Some(other) => format!("vehicle {other} was in the way"),
            None => "it was in no lane that leads on".into(),
        };
        table.row([recorded.to_string(), format!("{late_s:.1}"), format!("{behind_m:.1}"), why]);
    }
    table
}

/// Distances from the record, beside those at constant speed.
fn distances(report: &ReplayReport) -> Figure {
    let mut lines = lines(report, |it| it.distance_m);
    if let Some(first) = report.models.first() {
        let points = first.parting.after.iter().map(|it| [it.time_s, it.constant_speed_m]).collect();
        lines.push(TimeLine { name: "constant speed".into(), points });
    }
    drawn(report, "Distance [m]", "Distance from the recorded place", &lines)
}

/// A driver in several rollouts beside its record.
fn example(example: &Example, step_s: f64) -> Figure {
    let line = |name: String, speeds: &Vec<f64>| TimeLine {
        name,
        points: speeds.iter().enumerate().map(|(step, it)| [step as f64 * step_s, *it]).collect(),
    };
    let recorded = line("recorded".into(), &example.recorded_mps);
    let driven = example.driven_mps.iter().enumerate();
    let driven = driven.map(|(number, it)| line(format!("rollout {}", number + 1), it));
    Figure {
        drawn: over_time(
            Sheet::Column,
            "Speed [m/s]",
            &[recorded].into_iter().chain(driven).collect::<Vec<_>>(),
        ),
        title: "One driver beside its record".into(),
        caption: format!(
            "Vehicle {} of the recording, which is compared for the longest time: its recorded speed, and its speed as a driver in \
             rollouts of the first model, against the time since it became a driver.",
            example.recorded
        ),
    }
}

fn figure(report: &ReplayReport, label: &str, title: &str, of: fn(&PartedAfter) -> f64) -> Figure {
    drawn(report, label, title, &lines(report, of))
}

fn lines(report: &ReplayReport, of: fn(&PartedAfter) -> f64) -> Vec<TimeLine> {
    let line = |it: &Matched| TimeLine {
        name: it.model.into(),
        points: it.parting.after.iter().map(|it| [it.time_s, of(it)]).collect(),
    };
    report.models.iter().map(line).collect()
}

fn drawn(report: &ReplayReport, label: &str, title: &str, lines: &[TimeLine]) -> Figure {
    let drivers = report.models.first().map_or(0, |it| it.parting.drivers);
    Figure {
        drawn: over_time(Sheet::Column, label, lines),
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
        ("of a vehicle handed over", Align::Numbers),
        ("between recorded vehicles", Align::Numbers),
    ];
    let mut table = Table::new("Pairs that touched, in the mean of the rollouts.", &columns);
    for Matched { model, collisions: it, .. } in &report.models {
        let counts =
            [it.by_reactive, it.by_recorded, it.between_reactive, it.of_handed_over, it.between_recorded];
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
