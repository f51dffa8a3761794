//! C2 at a recorded site: lane changes against density, recorded and simulated on the same road.
//!
//! A fit that is judged has what it takes ([`Observed::judge`]): fitted drivers, the built-in style, MOBIL, LMRS and a
//! constant chance drive the last third of the recorded time, with the vehicles that came then.

use laneweave::Fault;
use laneweave::study::{Sheet, estimates};

use super::effort::Effort;
use super::finding::{Finding, markdown, quoted};
use crate::fit::{AXES, Design, InClass, Judged, Observed, Predicted, Rollouts};

/// Rollouts of each model for a seed: pairs have the same draw of the fitted parameters.
const ROLLOUTS: u32 = 8;
/// With fewer rollouts than this their middle 95 % are too narrow (ours).
const ENOUGH: usize = 40;
/// The designs, in words.
const DESIGNS: [&str; 2] = ["the last third as a whole", "rollouts from recorded snapshots"];
/// The models that the claim is about, by their names in a judged fit.
const CLAIMED: [&str; 2] = ["fitted", "mobil"];

/// Judges a fit to the recordings of a site, and sets rates against density beside the recorded ones. `show` is told
/// what share of the simulations is done, from 0 to 1.
///
/// # Errors
/// If the recordings are too short, nobody changes lanes in them, or the site cannot be simulated.
pub fn site_rates(
    observed: &Observed,
    effort: &Effort,
    show: &(dyn Fn(f64) + Sync),
) -> Result<Finding, Fault> {
    let count = (effort.seeds as u32).saturating_mul(ROLLOUTS);
    let rollouts = Rollouts { count, threads: effort.threads };
    let Some(judged) = observed.judge(&rollouts, show)? else {
        let what = "the recordings are too short to be simulated: 60 s are needed before and after two thirds of their time";
        return Err(Fault::new(
            "--site",
            what,
            "give longer recordings, or several that continue one another",
        ));
    };
    let figure =
        |design: &Design, title: &str| estimates(Sheet::Page, title, AXES, &design.curves(&judged)).svg;
    Ok(Finding {
        text: words(&judged),
        tables: vec![("C2_site".into(), csv(&judged))],
        figures: vec![
            ("C2_site".into(), figure(&judged.third, "Lane changes against density: the last third")),
            (
                "C2_site_snapshots".into(),
                figure(&judged.snapshots, "Lane changes against density: snapshots"),
            ),
        ],
        rows: Vec::new(),
    })
}

/// The designs with their names.
fn designs(judged: &Judged) -> [(&'static str, &Design); 2] {
    [(DESIGNS[0], &judged.third), (DESIGNS[1], &judged.snapshots)]
}

fn csv(judged: &Judged) -> String {
    let mut csv =
        String::from("design,density_veh_km_lane,recorded_per_veh_km,model,median,lower,upper,crps\n");
    let cell = |value: Option<f64>| value.map_or(String::new(), |it| it.to_string());
    for (name, design) in designs(judged) {
        for class in design.classes() {
            for (model, it) in judged.models.iter().zip(class.simulated) {
                let [lower, upper] = it.interval.map_or([None; 2], |it| it.map(Some));
                let numbers = [it.median, lower, upper, it.crps].map(cell).join(",");
                let (density, recorded) = (class.density, cell(class.recorded));
                csv += &format!("{},{density},{recorded},{},{numbers}\n", quoted(name), quoted(model.model));
            }
        }
    }
    csv
}

fn words(judged: &Judged) -> String {
    let tables: String = designs(judged).map(|(name, design)| of_design(judged, name, design)).concat();
    let few = if judged.rollouts < ENOUGH {
        " These are few rollouts: their intervals are too narrow, so that even a true model often does not follow."
    } else {
        ""
    };
    format!(
        "# C2 at a recorded site: the rate of lane changes follows the recorded one\n\n\
         Drivers are fitted to the first two thirds of the recorded time, {:.0} s with {} lane changes. The last third is simulated with the \
         vehicles that came then, {} rollouts of each model. Light, middle and dense traffic have a third of the recorded distance each (Edie's density of 100 m of a lane in 30 s). \
         *Follows* means here that what was recorded lies within the middle 95 % of the rollouts in each of the three in which there was traffic; the paper has no number.{few}\n\n{tables}",
        judged.fitted_s, judged.events_used, judged.rollouts
    )
}

/// A design in words, with its table.
fn of_design(judged: &Judged, name: &str, design: &Design) -> String {
    let of = |it: &Predicted| match (it.median, it.interval) {
        (Some(median), Some([low, high])) => {
            let mark = if it.is_missed() { " *" } else { "" };
            format!("{median:.2} ({low:.2} to {high:.2}){mark}")
        }
        _ => "nothing to measure".to_owned(),
    };
    let row = |class: InClass| {
        let recorded = class.recorded.map_or("no traffic".to_owned(), |it| format!("{it:.2}"));
        let cells = class.simulated.iter().map(of);
        [format!("{:.1}", class.density), recorded].into_iter().chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = design.classes().map(row).collect();
    let models: Vec<&str> = judged.models.iter().map(|it| it.model).collect();
    let table = markdown(&[&["density [veh/km]", "recorded"], &models[..]].concat(), &rows);
    format!(
        "In {name} ({:.0} s with {} recorded lane changes), lane changes per vehicle-kilometre; * not as recorded:\n\n{table}\n{}",
        design.simulated_s,
        design.events,
        verdict(judged, design)
    )
}

/// Which models follow what was recorded, in words.
fn verdict(judged: &Judged, design: &Design) -> String {
    let follows = |name: &str| {
        let found = judged.models.iter().position(|it| it.model == name);
        found.is_some_and(|it| design.is_followed_by(it))
    };
    let claim = match CLAIMED.map(follows) {
        [true, false] => "The claim holds here: fitted drivers follow the recorded rate, and MOBIL does not.",
        [true, true] => {
            "The claim is not shown here: fitted drivers follow the recorded rate, and so does MOBIL."
        }
        [false, true] => {
            "The claim does not hold here: MOBIL follows the recorded rate, and fitted drivers do not."
        }
        [false, false] => {
            "The claim does not hold here: neither fitted drivers nor MOBIL follow the recorded rate."
        }
    };
    let constant = if follows("null") {
        " A constant chance follows it, too: that is no evidence for reasons."
    } else {
        ""
    };
    format!("{claim}{constant}\n\n")
}
