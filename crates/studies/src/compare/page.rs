//! The report of comparisons: models side by side, each with its interval over the seeds.

use std::path::Path;

use laneweave_results::output::Boxes;
use laneweave_results::report::classes::{CLASS, LEAST_BOXES, means};
use laneweave_results::report::{Align, Figure, Page, Section, Table, counted};
use laneweave_scenario::style::Model;
use laneweave_study::units::KMH_PER_MPS;
use laneweave_study::{
    BarRow, EdieRow, Estimate, Estimated, Interval, RateSeries, Scattered, Sheet, bars, rate_density, scatter,
};

use super::{Comparison, MEASURES, Measure, OF_FEW, cell};

/// The report of all `comparisons`, each with the name of its input, and with the `command` that made them.
pub fn page(comparisons: &[(String, Comparison)], command: &str) -> Page {
    let lead = format!(
        "Lane-change models on the same traffic, compared by laneweave {}. All results follow from the maps, the scenarios and the \
         seeds; nothing depends on the machine.",
        env!("CARGO_PKG_VERSION")
    );
    let mut page = Page::new("Comparison of lane-change models", lead).section(what(comparisons, command));
    for (number, (input, comparison)) in comparisons.iter().enumerate() {
        let name = Path::new(input).file_name().map_or(input.into(), |it| it.to_string_lossy());
        page = page.section(section(number + 1, &name, comparison));
    }
    page.section(method())
}

fn what(comparisons: &[(String, Comparison)], command: &str) -> Section {
    let mut facts = vec![
        ("Command".to_owned(), command.to_owned()),
        ("Program".to_owned(), format!("laneweave {}", env!("CARGO_PKG_VERSION"))),
    ];
    let models = comparisons.first().map_or(&[][..], |(_, it)| &it.models);
    facts.extend(models.iter().map(|it| (it.name().to_owned(), it.words().to_owned())));
    Section::new("what", "What was compared").facts(facts)
}

fn section(number: usize, input: &str, comparison: &Comparison) -> Section {
    let mut facts = comparison.about.facts();
    let seeds = comparison.seeds();
    let [first, last] = [seeds.first(), seeds.last()].map(|it| it.copied().unwrap_or_default());
    facts.push(("Seeds".into(), format!("{} for each model: {first} to {last}", seeds.len())));
    let mut figures = vec![rates(comparison)];
    figures.extend(diagrams(comparison));
    figures.extend(MEASURES.iter().filter_map(|it| measured(comparison, it)));
    Section::new(format!("input-{number}"), format!("Models on {input}"))
        .facts(facts)
        .table(table(comparison))
        .figures(figures)
        .table_unless_empty(differences(comparison), "")
}

impl Comparison {
    /// The boxes of all runs of a model.
    fn boxes(&self, model: Model) -> impl Iterator<Item = &EdieRow> {
        self.trials.iter().filter(move |it| it.model == model).flat_map(|it| &it.boxes)
    }
}

fn rates(comparison: &Comparison) -> Figure {
    let series = |model: &Model| RateSeries {
        name: model.name().into(),
        points: Boxes::pooled(comparison.boxes(*model).copied()),
    };
    let series: Vec<RateSeries> = comparison.models.iter().map(series).collect();
    let count =
        |it: &RateSeries| format!("{} {}", counted(it.points.iter().map(|it| it.changes).sum()), it.name);
    let counts: Vec<String> = series.iter().map(count).collect();
    Figure {
        drawn: rate_density(Sheet::Column, "", &series),
        title: "Discretionary lane changes against density".into(),
        caption: format!(
            "Discretionary lane changes (both lanes are equally good for the route) per kilometre of lane and hour, in boxes of \
             about 500 m of all parallel lanes and 60 s. Boxes of similar density (2 veh/km) of all seeds are pooled, with exact \
             Poisson 95 % intervals. n = {} lane changes.",
            counts.join(", ")
        ),
    }
}

/// Flow and speed against density.
fn diagrams(comparison: &Comparison) -> [Figure; 2] {
    let figure = |label: &str, title: &str, value: fn(&EdieRow) -> f64| {
        let group = |model: &Model| {
            let boxes = comparison.boxes(*model).filter(|it| it.density_veh_per_km > 0.0);
            let points: Vec<[f64; 2]> = boxes.map(|it| [it.density_veh_per_km, value(it)]).collect();
            let means = means(&points);
            Scattered { name: model.name().into(), points: Vec::new(), means }
        };
        let groups: Vec<Scattered> = comparison.models.iter().map(group).collect();
        let boxes: usize = comparison.trials.iter().map(|it| it.boxes.len()).sum();
        Figure {
            drawn: scatter(Sheet::Column, ["Density [veh/km per lane]", label], &groups),
            title: title.into(),
            caption: format!(
                "Means over boxes of all seeds in classes of {CLASS} veh/km with at least {LEAST_BOXES} boxes, by Edie's \
                 definitions, with Student's 95 % intervals over boxes. Neighbouring boxes are correlated, so the intervals are \
                 somewhat too narrow. n = {} boxes.",
                counted(boxes as u64)
            ),
        }
    };
    [
        figure("Flow [veh/h per lane]", "Flow against density", |it| it.flow_veh_per_h),
        figure("Speed [km/h]", "Speed against density", |it| {
            it.speed_mps.map_or(f64::NAN, |it| it * KMH_PER_MPS)
        }),
    ]
}

/// A measure by model; `None` if no model has a value.
fn measured(comparison: &Comparison, measure: &Measure) -> Option<Figure> {
    let row = |model: &Model| {
        let estimate = comparison.estimate(*model, measure)?;
        let at = Estimated { at: 0.0, value: estimate.mean, interval: drawn(&estimate) };
        Some((estimate, BarRow { name: model.name().into(), values: vec![at] }))
    };
    let (estimates, rows): (Vec<Estimate>, Vec<BarRow>) = comparison.models.iter().filter_map(row).unzip();
    if estimates.iter().all(|it| it.mean == 0.0) {
        return None;
    }
    let (name, _) = measure.title.rsplit_once(" [").unwrap_or((measure.title, ""));
    let least = estimates.iter().map(|it| it.replications).min().unwrap_or(0);
    Some(Figure {
        drawn: bars(Sheet::Column, [&capitalized(measure.title), "Model"], &[name], &rows),
        title: capitalized(name),
        caption: format!(
            "Means over the seeds{}. n = {}{} runs for each model.",
            if least > 1 {
                " with Student's 95 % intervals"
            } else {
                ", without intervals: one seed has none"
            },
            if estimates.iter().all(|it| it.replications == least) { "" } else { "at least " },
            counted(least as u64)
        ),
    })
}

/// The interval in a figure: no measure is negative; with one seed there is none.
fn drawn(estimate: &Estimate) -> Interval {
    let Interval { lower, upper } = estimate.interval();
    if upper.is_finite() {
        Interval { lower: lower.max(0.0), upper }
    } else {
        Interval { lower: estimate.mean, upper: estimate.mean }
    }
}

fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn table(comparison: &Comparison) -> Table {
    let columns: Vec<(&str, Align)> = [("measure", Align::Words)]
        .into_iter()
        .chain(comparison.models.iter().map(|it| (it.name(), Align::Numbers)))
        .collect();
    let caption = format!("Means over the seeds ± half of Student's 95 % intervals. {OF_FEW}.");
    let mut table = Table::new(caption, &columns);
    for measure in &MEASURES {
        let of = |model: &Model| comparison.cell(*model, measure).unwrap_or("–".into());
        table.row([measure.title.to_owned()].into_iter().chain(comparison.models.iter().map(of)));
    }
    table
}

/// The differences of the other models to the first; `None` with only one seed or one model.
fn differences(comparison: &Comparison) -> Table {
    let (reference, others) = match &comparison.models[..] {
        [reference, others @ ..] if comparison.seeds().len() > 1 => (*reference, others),
        [reference, ..] => (*reference, &[][..]),
        [] => return Table::new("", &[]),
    };
    let columns: Vec<(&str, Align)> = [("measure", Align::Words)]
        .into_iter()
        .chain(others.iter().map(|it| (it.name(), Align::Numbers)))
        .collect();
    let caption = format!(
        "Difference from {}: means of the paired differences, seed by seed, ± half of Student's 95 % intervals. With the same seed \
         the same vehicles and drivers arrive at the same times (common random numbers), so differences are more precise than the \
         means. *: the interval does not contain 0; (n) as above. One in twenty such intervals excludes 0 by chance.",
        reference.name()
    );
    let mut table = Table::new(caption, &columns);
    for measure in MEASURES.iter().filter(|_| !others.is_empty()) {
        let of = |model: &Model| {
            let difference = comparison.difference(*model, reference, measure);
            difference.map_or("–".into(), |it| {
                let is_sure = it.half_width.is_finite() && it.mean.abs() > it.half_width;
                cell(&it, measure.digits, comparison.seeds().len()).replacen('-', "−", 1)
                    + if is_sure { " *" } else { "" }
            })
        };
        table.row([measure.title.to_owned()].into_iter().chain(others.iter().map(of)));
    }
    table
}

fn method() -> Section {
    Section::new("method", "How it was measured")
        .text(
            "Each model runs every seed of an input once. Only the lane-change decision differs. The map, the demand, the drivers \
             with their car-following and gap acceptance are the same, and for each seed all random numbers for arrivals and driver \
             parameters. null and constant-hazard are null-model controls: if a claim about the reasons for lane changes also holds \
             for them, it does not show a reason.",
        )
        .text(
            "A lane change is discretionary if both lanes lead to the same place for the driver. Otherwise it is route-driven \
             (mandatory). Held up: the leader keeps the driver below its desired speed, and the lane beside is free. The ratio \
             compares the probability of a lane-change desire of such a driver with that on a free road. A seed in which no driver \
             on a free road wanted to change has no ratio, so the mean of the others is somewhat too low. Delay is the trip time \
             minus the time on a free road at the driver's desired speeds.",
        )
}
