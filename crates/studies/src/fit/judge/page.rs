//! What a fit is worth in the world, in its report.

use laneweave_results::report::{Align, Figure, Section, Table};
use laneweave_study::{BarRow, Estimated, Interval, Sheet, bars, estimates};

use super::report::{Score, scores};
use super::{AXES, Design, Judged, JudgedMeasure};

/// The measures of the figure, with their names there.
const SHOWN: [(&str, &str); 8] = [
    ("rate", "lane changes"),
    ("rate_discretionary", "discretionary"),
    ("faster_share_pct", "to the faster lane"),
    ("lead_gap_m", "gap ahead"),
    ("lag_gap_m", "gap behind"),
    ("duration_s", "duration"),
    ("speed_kmh", "mean speed"),
    ("pace_s_per_km", "travel time"),
];

/// The section of the report.
pub(in crate::fit) fn section(judged: &Judged) -> Section {
    let Judged { fitted_s, events_used, rollouts, third, snapshots, theta_moved_by, .. } = judged;
    let Design { simulated_s, events, measures, .. } = third;
    Section::new("world", "In the world")
        .text(format!(
            "A style is fitted to the first two thirds of the recorded time, {fitted_s:.0} s with {events_used} lane changes. In the last \
             third, {simulated_s:.0} s with {events} lane changes, vehicles come when, where and as fast as they came, and drive on as \
             drivers of that style, whose θ is moved by {theta_moved_by:.2}: {rollouts} rollouts, each pair with another draw of the parameters. Where the view ends they are no \
             faster than 85 % of traffic was there in that minute. A drone sees them with errors of 10 cm. Lane changes count that began in view. \
             Where vehicles go is drawn from those who went before. Vehicles that were first seen in the middle of the view do not come: \
             recordings lose vehicles, and find them again under another number."
        ))
        .figures(vec![figure(judged, Sheet::Column), density_figure(judged, Sheet::Column)])
        .table(measured(measures, judged))
        .table(differences(judged))
        .text(format!(
            "In the second design all vehicles become drivers where they were recorded, {} times one after the other, and drive for {:.0} s \
             in all, in which {} lane changes were recorded.",
            snapshots.simulations, snapshots.simulated_s, snapshots.events
        ))
        .table(measured(&snapshots.measures, judged))
        .table(scored("Scores of the last third", measures, judged))
        .table(scored("Scores of the rollouts from snapshots", &snapshots.measures, judged))
        .text(
            "Each model has one number that is fitted to the rate of lane changes in the ten minutes before: the style and a constant \
             chance their thresholds, MOBIL its threshold, LMRS its gain of speed. These three models have the style's car-following. The default is the built-in style from \
             which the fit began, with its own car-following. A score is the less, the better: the continuous ranked probability score in \
             the unit of the measure, and for counts the negative logarithm of the likelihood of the recorded count.",
        )
}

/// The figure of simulated beside recorded traffic.
pub(in crate::fit) fn figure(judged: &Judged, sheet: Sheet) -> Figure {
    let row = |(key, name): &(&str, &str)| {
        let measure = judged.third.measures.iter().find(|it| it.key == *key)?;
        let recorded = measure.recorded.filter(|it| *it > 0.0)?;
        let values = measure.simulated.iter().map(|it| {
            let [lower, upper] = it.interval.unwrap_or([f64::NAN; 2]).map(|it| it / recorded);
            let value = it.median.unwrap_or(f64::NAN) / recorded;
            Estimated { at: 0.0, value, interval: Interval { lower, upper } }
        });
        Some(BarRow { name: (*name).to_owned(), values: values.collect() })
    };
    let rows: Vec<BarRow> = SHOWN.iter().filter_map(row).collect();
    let models: Vec<&str> = judged.models.iter().map(|it| it.model).collect();
    Figure {
        drawn: bars(sheet, ["Simulated, as a share of recorded", "Measure"], &models, &rows),
        title: "Simulated beside recorded traffic".into(),
        caption: format!(
            "Medians of {} rollouts as shares of what was recorded, with the middle 95 % of the rollouts. 1 is as recorded.",
            judged.rollouts
        ),
    }
}

/// The figure of lane changes against density.
pub(in crate::fit) fn density_figure(judged: &Judged, sheet: Sheet) -> Figure {
    let title = "Lane changes against density";
    Figure {
        drawn: estimates(sheet, title, AXES, &judged.third.curves(judged)),
        title: title.into(),
        caption: format!(
            "Medians of {} rollouts of the last third in light, middle and dense traffic, a third of the recorded distance each, with the \
             middle 95 % of the rollouts.",
            judged.rollouts
        ),
    }
}

fn measured(measures: &[JudgedMeasure], judged: &Judged) -> Table {
    let models = judged.models.iter().map(|it| (it.model, Align::Numbers));
    let parameters = [
        ("width of the fitted one's interval", Align::Numbers),
        ("of its spread, from parameters [%]", Align::Numbers),
    ];
    let columns: Vec<(&str, Align)> = [("measure", Align::Words), ("recorded", Align::Numbers)]
        .into_iter()
        .chain(models)
        .chain(parameters)
        .collect();
    let what = "Medians of the rollouts with the middle 95 %; an asterisk where the recorded value lies outside. What of the spread does \
                not come from the parameters is chance.";
    let mut table = Table::new(what, &columns);
    for JudgedMeasure { name, recorded, simulated, .. } in measures {
        let recorded = recorded.map_or("–".to_owned(), |it| format!("{it:.2}"));
        let width = simulated[0].width.map_or("–".to_owned(), |it| format!("{it:.2}"));
        let share = simulated[0].from_parameters;
        let share = share.map_or("–".to_owned(), |it| format!("{:.0}", 100.0 * it));
        let cells = simulated.iter().map(|it| it.to_text().trim_end().to_owned());
        table.row([name.clone(), recorded].into_iter().chain(cells).chain([width, share]));
    }
    table
}

fn scored(what: &str, measures: &[JudgedMeasure], judged: &Judged) -> Table {
    let models = judged.models.iter().map(|it| (it.model, Align::Numbers));
    let columns: Vec<(&str, Align)> = [("measure", Align::Words)].into_iter().chain(models).collect();
    let mut table = Table::new(what, &columns);
    for Score { name, values, .. } in scores(measures) {
        let cells = values.iter().map(|it| it.map_or("–".to_owned(), |it| format!("{it:.2}")));
        table.row([name].into_iter().chain(cells));
    }
    table
}

fn differences(judged: &Judged) -> Table {
    let columns = [
        ("model", Align::Words),
        ("number that is fitted", Align::Words),
        ("its value", Align::Numbers),
        ("not as recorded", Align::Words),
        ("differs from the fitted style in", Align::Words),
        ("collisions per rollout", Align::Numbers),
    ];
    let what = "What tells the models apart: a model differs from the fitted style where more than 97.5 % of its rollouts, or fewer than \
                2.5 %, show more.";
    let mut table = Table::new(what, &columns);
    for (number, model) in judged.models.iter().enumerate() {
        let (key, value) =
            model.scale.map_or(("–", "–".to_owned()), |(key, it)| (key, format!("{it:.2}")));
        let differences = if number == 0 { "–".to_owned() } else { judged.differences(number) };
        table.row([
            model.model.to_owned(),
            key.to_owned(),
            value,
            judged.misses(number),
            differences,
            format!("{:.1}", model.collisions),
        ]);
    }
    table
}
