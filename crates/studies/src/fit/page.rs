//! The report of a fit.

use laneweave_results::report::{Align, Figure, Page, Section, Table, counted};
use laneweave_study::{BarRow, Estimated, Interval, Sheet, bars};

use super::following::Off;
use super::found::by_paper_terms;
use super::gaps_page;
use super::judge::{self, Judged};
use super::prediction::HeldOut;
use super::report::{FitReport, Spread};
use super::words::{correction, told, with_interval};

/// The report of a fit to the recordings with these names, made by `command`.
pub fn page(report: &FitReport, recordings: &str, command: &str) -> Page {
    let lead = format!(
        "Driving styles fitted to recorded lane changes by laneweave {}. Weights are in units of the choice noise.",
        env!("CARGO_PKG_VERSION")
    );
    let data = &report.data;
    let facts = [
        ("Command", command.to_owned()),
        ("Recordings", recordings.to_owned()),
        ("Driven", format!("{:.1} veh-km in {:.2} veh-h", data.veh_km, data.veh_h)),
        ("Drivers who could change lanes", counted(data.drivers as u64)),
        ("Seconds in which they could", counted(data.observations as u64)),
        ("Lane changes", counted(data.events as u64)),
        ("Of them used", counted(data.events_used as u64)),
        ("Not identified", data.not_identified.join(", ")),
    ];
    let facts = facts.map(|(name, value)| (name.to_owned(), value)).to_vec();
    let of_weights = Section::new("weights", "Weights").table(weights(report));
    let of_weights = match &report.correction {
        Some(it) => of_weights.text(correction(it)),
        None => of_weights,
    };
    let page = Page::new("Fit of driving styles", lead)
        .section(Section::new("what", "What was fitted").facts(facts).table(events(report)))
        .section(of_weights.text(
            "Intervals are those of a bootstrap over blocks of drivers who were seen at the same time, or of the information matrix if \
             there are no draws. A weight is identified if its standard deviation is at most half of the prior's, and the likelihood falls \
             significantly, by 1.92 nats, on both sides. It matters if its interval excludes 0. A weight that is not identified drives at \
             the prior, and the others are fitted beside that. Between lanes that lead to the same place the yield of the route is one with \
             that of speed, so its weight has the prior's proportion to that of speed.",
        ))
        .section(Section::new("lead", "When changes begin").table(by_lead(report)).text(
            "The weights if all changes begin at one time before their vehicles cross the line, with β of the prior. What differs much \
             depends on that time.",
        ))
        .section(Section::new("beta", "β of comfort").table(beta(report)).text(
            "β by its profile likelihood: at each value everything else is fitted anew. It is identified if the likelihood falls \
             significantly, by 1.92 nats, on both sides.",
        ));
    let page = page
        .section(following(report))
        .section(gaps_page::section(&report.gaps))
        .section(held_out_section(report));
    let page = if report.by_paper.is_empty() { page } else { page.section(paper(report)) };
    let page = match &report.judged {
        Some(judged) => page.section(judge::section(judged)),
        None => page,
    };
    page.section(Section::new("manner", "Durations, gaps, desired speeds").table(spreads(report)).text(
            "Durations are those of changes that were seen as a whole, so long ones are rarer than they should be. Gaps count up to 150 m.",
        ))
}

/// The names of the figures as files.
pub const FIGURES: [&str; 3] = ["prediction.svg", "world.svg", "density.svg"];

/// The figures of the report by the names of their files; all but the first only if the fit was judged.
pub fn figures(report: &FitReport) -> Vec<(&'static str, String)> {
    let mut figures = vec![(FIGURES[0], figure(report, Sheet::Page).drawn.svg)];
    let judged: [fn(&Judged, Sheet) -> Figure; 2] = [judge::figure, judge::density_figure];
    for (name, draw) in FIGURES[1..].iter().zip(judged) {
        figures.extend(report.judged.as_ref().map(|it| (*name, draw(it, Sheet::Page).drawn.svg)));
    }
    figures
}

fn events(report: &FitReport) -> Table {
    let columns = [("lane changes", Align::Words), ("number", Align::Numbers)];
    let mut table = Table::new("Lane changes by kind, why some are not used, and what is cut off.", &columns);
    let data = &report.data;
    for (of, counts) in
        [("", &data.events_by_kind), ("not used: ", &data.unused), ("cut off: ", &data.censored)]
    {
        for (name, count) in counts {
            table.row([format!("{of}{}", name.replace('_', " ")), count.to_string()]);
        }
    }
    table
}

fn weights(report: &FitReport) -> Table {
    let columns = [
        ("weight", Align::Words),
        ("estimate", Align::Numbers),
        ("standard error", Align::Numbers),
        ("95 % interval", Align::Numbers),
        ("prior", Align::Numbers),
        ("drives", Align::Numbers),
        ("", Align::Words),
    ];
    let mut table = Table::new("Fitted weights beside those of the prior style.", &columns);
    for it in report.weights.iter().chain([&report.theta]) {
        let [lower, upper] = it.interval;
        table.row([
            it.name.to_owned(),
            format!("{:.3}", it.estimate),
            format!("{:.3}", it.standard_error),
            format!("{lower:.3} to {upper:.3}"),
            format!("{:.3}", it.prior),
            format!("{:.3}", it.value),
            told(it),
        ]);
    }
    table
}

fn by_lead(report: &FitReport) -> Table {
    let names = report.by_lead.first().map_or(&[][..], |it| &it.weights[..]).iter().map(|it| it.name);
    let columns: Vec<(&str, Align)> =
        [("before the crossing [s]", Align::Numbers), ("lane changes used", Align::Numbers)]
            .into_iter()
            .chain(names.map(|it| (it, Align::Numbers)))
            .collect();
    let mut table = Table::new("Weights and standard errors, by the begin of changes.", &columns);
    for it in &report.by_lead {
        let weights = it.weights.iter().map(|it| format!("{:.3} ± {:.3}", it.estimate, it.standard_error));
        table.row([it.lead_s.to_string(), it.events_used.to_string()].into_iter().chain(weights));
    }
    table
}

fn paper(report: &FitReport) -> Section {
    let names = by_paper_terms().into_iter().map(|it| match it {
        "speed" => "speed and route",
        "keeping" => "slow side",
        other => other,
    });
    let names: Vec<&str> = names.collect();
    let columns: Vec<(&str, Align)> = [
        ("group", Align::Words),
        ("vehicles", Align::Numbers),
        ("changed", Align::Numbers),
        ("β", Align::Numbers),
    ]
    .into_iter()
    .chain(names.iter().map(|it| (*it, Align::Numbers)))
    .collect();
    let mut table = Table::new("Weights and standard errors by the paper's procedure.", &columns);
    for it in &report.by_paper {
        let beta = it.beta.map_or("–".to_owned(), |it| it.to_string());
        let cells = [it.group.to_owned(), it.vehicles.to_string(), it.changed.to_string(), beta];
        let weights = (0..names.len()).map(|at| {
            it.weights.get(at).map_or("–".to_owned(), |[value, error]| format!("{value:.2} ± {error:.2}"))
        });
        table.row(cells.into_iter().chain(weights));
    }
    Section::new("paper", "The paper's procedure").table(table).text(
        "Every vehicle is one observation, without an intercept, and two thirds of them are used. Vehicles that changed lanes most often \
         count as aggressive, as many as the paper's share: this sorts drivers by what is to be explained. Without an intercept a \
         driver for whom nothing speaks for or against a change makes it with a chance of one half, so negative weights have to explain \
         that most do not. Neither gaps nor time count.",
    )
}

fn beta(report: &FitReport) -> Table {
    let columns = [("β", Align::Numbers), ("less likely than the best by [nats]", Align::Numbers)];
    let what = match report.beta.is_identified {
        true => format!("Profile of β; {} is used.", report.beta.estimate),
        false => {
            format!("Profile of β; it is not identified, so the prior's {} is used.", report.beta.estimate)
        }
    };
    let mut table = Table::new(what, &columns);
    for [beta, log] in &report.beta.profile {
        table.row([beta.to_string(), format!("{:.2}", log.abs())]);
    }
    table
}

fn figure(report: &FitReport, sheet: Sheet) -> Figure {
    let row = |it: &HeldOut| {
        let [lower, upper] = it.over_constant_interval;
        let interval = Interval { lower, upper };
        BarRow {
            name: it.model.clone(),
            values: vec![Estimated { at: 0.0, value: it.over_constant, interval }],
        }
    };
    let rows: Vec<BarRow> = report.held_out.iter().filter(|it| it.model != "constant").map(row).collect();
    let label = "Better than a constant chance [nats per lane change]";
    Figure {
        drawn: bars(sheet, [label, "Model"], &["held out"], &rows),
        title: "Prediction of held-out drivers".into(),
        caption: format!(
            "By how much models predict better than a constant chance, with 95 % intervals by a bootstrap over drivers. n = {} lane \
             changes.",
            counted(report.data.events_used as u64)
        ),
    }
}

fn following(report: &FitReport) -> Section {
    let following = &report.following;
    let section = Section::new("following", "Following");
    if let Some(why) = following.not_fitted {
        return section.text(format!("The prior style's: {why}."));
    }
    let columns = [
        ("number", Align::Words),
        ("estimate", Align::Numbers),
        ("95 % interval", Align::Numbers),
        ("prior", Align::Numbers),
        ("identified", Align::Words),
    ];
    let what = format!(
        "Fitted to {} drivers in {:.0} s, in stretches of {:.0} s.",
        following.drivers, following.seconds, following.stretch_s
    );
    let mut numbers = Table::new(what, &columns);
    for it in &following.numbers {
        let interval = format!("{:.3} to {:.3}", it.interval[0], it.interval[1]);
        let identified = if it.is_identified { "yes" } else { "no: the style has the prior's" };
        let cells = [it.name.key().to_owned(), format!("{:.3}", it.estimate), interval];
        numbers.row(cells.into_iter().chain([format!("{:.3}", it.prior), identified.to_owned()]));
    }
    section.table(numbers).text(following.own()).table(followed(report)).text(
        "Drivers are simulated through stretches of equal length in which they follow one leader, or nobody, behind the leader as \
         recorded. Stretches are as long as enough drivers show. A number is identified if its standard error is at most half of the \
         prior's and the likelihood falls significantly to half and to twice the estimate. A third of the drivers is held out in turn; of them only what came before a prediction is known.",
    )
}

/// Predictions of the following of held-out drivers.
fn followed(report: &FitReport) -> Table {
    let columns = [
        ("after [s]", Align::Numbers),
        ("fitted", Align::Numbers),
        ("prior", Align::Numbers),
        ("constant speed", Align::Numbers),
        ("fitted is", Align::Words),
    ];
    let what = "Held-out drivers: mean errors of distance [m] and of speed [m/s].";
    let mut table = Table::new(what, &columns);
    for it in &report.following.predictions {
        let off = |it: Off| format!("{:.2} m, {:.2} m/s", it.distance_m, it.speed_mps);
        let off = [it.fitted, it.prior, it.constant_speed].map(off);
        let verdict = format!("{} than a constant speed", it.fitted_is);
        let verdict = if it.fitted_is.starts_with("not") { it.fitted_is.to_owned() } else { verdict };
        table.row([format!("{:.1}", it.after_s)].into_iter().chain(off).chain([verdict]));
    }
    table
}

fn held_out_section(report: &FitReport) -> Section {
    let section = Section::new("held-out", "Predicting drivers who were not seen")
        .figures(vec![figure(report, Sheet::Column)])
        .table(held_out(report));
    let section = match elsewhere(report) {
        Some(table) => section.table(table),
        None => section,
    };
    section.table(predictive(report)).text(
        "A third of the drivers is held out in turn, again and again. All models but the first have the same intercepts of places: lane, \
         side and distance before the next fork, since no recording shows the route of a driver before it takes it. The last one is a \
         control: it is fitted to changes that are shuffled over all seconds.",
    )
}

fn held_out(report: &FitReport) -> Table {
    let columns = [
        ("model", Align::Words),
        ("log-likelihood", Align::Numbers),
        ("over a constant chance", Align::Numbers),
        ("mcdm over it", Align::Numbers),
        ("mcdm is", Align::Words),
    ];
    let mut table = Table::new("Held-out drivers [nats per lane change], with 95 % intervals.", &columns);
    for it in &report.held_out {
        let log = format!("{:.3}", it.log_likelihood_per_event);
        let over = with_interval(it.over_constant, it.over_constant_interval);
        let mcdm = with_interval(it.mcdm_over_it, it.mcdm_over_it_interval);
        let [mcdm, verdict] = beside_mcdm(it, [mcdm, it.mcdm_is.to_owned()]);
        table.row([it.model.clone(), log, over, mcdm, verdict]);
    }
    table
}

/// How multi-criteria decision-making compares with a model, unless it is that model.
fn beside_mcdm(it: &HeldOut, cells: [String; 2]) -> [String; 2] {
    if it.model == "mcdm" { ["–".to_owned(), "–".to_owned()] } else { cells }
}

/// Predictions for sites that were not seen, if there are several sites.
fn elsewhere(report: &FitReport) -> Option<Table> {
    let columns = [
        ("model", Align::Words),
        ("over a constant chance", Align::Numbers),
        ("mcdm over it", Align::Numbers),
        ("mcdm is", Align::Words),
    ];
    let mut table = Table::new(
        "Sites that were held out [nats per lane change], with 95 % intervals. Only how often drivers change lanes is estimated at the \
         site itself, for all models alike; of its places nothing is known.",
        &columns,
    );
    for it in &report.held_out {
        let elsewhere = it.elsewhere.as_ref()?;
        let over = with_interval(elsewhere.over_constant, elsewhere.over_constant_interval);
        let mcdm = with_interval(elsewhere.mcdm_over_it, elsewhere.mcdm_over_it_interval);
        let [mcdm, verdict] = beside_mcdm(it, [mcdm, elsewhere.mcdm_is.to_owned()]);
        table.row([it.model.clone(), over, mcdm, verdict]);
    }
    Some(table)
}

fn predictive(report: &FitReport) -> Table {
    let columns = [
        ("model", Align::Words),
        ("McFadden's R²", Align::Numbers),
        ("area under ROC", Align::Numbers),
        ("area of precision over recall", Align::Numbers),
        ("Brier", Align::Numbers),
        ("calibration: intercept", Align::Numbers),
        ("slope", Align::Numbers),
    ];
    let base = report.predictive.first().map_or(0.0, |it| it.base_rate);
    let what = format!(
        "Predictions of single seconds of held-out drivers. By chance the area under ROC is .5, that of precision over recall {base:.4}, the \
         share of seconds in which a change begins."
    );
    let mut table = Table::new(what, &columns);
    let text =
        |value: Option<f64>, digits: usize| value.map_or("–".to_owned(), |it| format!("{it:.digits$}"));
    for it in &report.predictive {
        table.row([
            it.model.clone(),
            format!("{:.4}", it.mcfadden_r2),
            text(it.roc_area, 3),
            text(it.precision_recall_area, 4),
            format!("{:.5}", it.brier),
            text(it.calibration.map(|it| it[0]), 2),
            text(it.calibration.map(|it| it[1]), 2),
        ]);
    }
    table
}

fn spreads(report: &FitReport) -> Table {
    let columns = [
        ("quantity", Align::Words),
        ("number", Align::Numbers),
        ("median", Align::Numbers),
        ("middle half", Align::Numbers),
    ];
    let mut table = Table::new("What else was seen of the drivers.", &columns);
    let rows: [(&str, Option<Spread>); 4] = [
        ("duration of a lane change [s]", report.durations_s),
        ("gap to the new leader when it begins [m]", report.lead_gaps_m),
        ("gap to the new follower when it begins [m]", report.lag_gaps_m),
        (
            "desired speed of those who drove freely, share of what limit and class allow",
            report.desired_speed_factors,
        ),
    ];
    for (name, spread) in rows {
        let cells = spread.map_or(["0".into(), "–".into(), "–".into()], |it| {
            let half = format!("{:.2} to {:.2}", it.lower_quartile, it.upper_quartile);
            [it.count.to_string(), format!("{:.2}", it.median), half]
        });
        table.row([name.to_owned()].into_iter().chain(cells));
    }
    table
}
