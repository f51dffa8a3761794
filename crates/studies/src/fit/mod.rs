//! Driving styles fitted to recordings.
//!
//! [`Request::observe`] reads recordings and their maps, fits how drivers follow, and notes what every driver could
//! choose. [`Observed::plan`] says what they can tell; [`Observed::fit`] fits styles to them.

mod accepted;
mod correct;
mod files;
mod following;
mod found;
mod gaps;
mod gaps_page;
mod judge;
mod page;
mod plan;
mod prediction;
mod report;
mod sources;
mod style;
mod words;

use std::path::{Path, PathBuf};

use laneweave_calibration::following::{FollowingFit, NotFitted};
use laneweave_calibration::observe::{Begin, Observations, PLAIN};
use laneweave_calibration::{Asked, Classes, Folds, PriorWeights, Study, by_paper};
use laneweave_models::change::{LaneChangeModel, Mcdm};
use laneweave_models::{Reading, Style};
use laneweave_scenario::scenario::MapOptions;
use laneweave_scenario::style::{StyleTemplate, find};
use laneweave_scenario::{Fault, Source};
use serde::{Deserialize, Deserializer};

use following::with_following;
use sources::Sources;

pub use following::{FollowingNumber, FollowingPrediction, FollowingReport, Off};
pub use gaps::{BrakingReport, CriticalGapReport, GapReport, GapScoreReport};
pub(crate) use judge::{AXES, InClass};
pub use judge::{Design, Judged, JudgedMeasure, JudgedModel, Predicted, Rollouts};
pub use page::{FIGURES, figures, page};
pub use plan::{ExpectedWeight, Plan};
pub use prediction::{Elsewhere, HeldOut, Predictive};
pub use report::{
    BetaReport, ByPaper, ClassReport, Correction, FitReport, FittedStyle, GapLimits, Spread, WeightReport,
    WithLead,
};
pub use style::FITTED;

/// Most classes of drivers.
pub const MOST_CLASSES: usize = 6;
/// Times before the crossing at which changes may begin, for comparison [s].
const LEADS: [f64; 3] = [1.5, 2.5, 3.5];

/// What styles are fitted to, and how.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Request {
    /// The files of the recordings.
    pub recordings: Vec<PathBuf>,
    /// Their map; CommonRoad files contain their own.
    pub map: Option<PathBuf>,
    /// A file that says what the columns hold.
    pub columns: Option<PathBuf>,
    /// How the map is read.
    pub map_options: MapOptions,
    /// The style with the prior weights: a built-in one, or a file.
    pub prior: String,
    /// The reading of the incentives; `None`: that of the prior style.
    pub reading: Option<Reading>,
    /// Number of classes of drivers; as data a number, or nothing.
    #[serde(deserialize_with = "classes")]
    pub classes: Classes,
    /// Whether the paper's procedure is followed, too, to compare.
    pub by_paper: bool,
    /// Draws of the bootstrap.
    pub draws: u32,
    /// Repetitions of holding out a third of the drivers.
    pub repetitions: u32,
    /// Time before the crossing at which changes begin [s]; `None`: as the recording shows it.
    pub lead_s: Option<f64>,
    /// Standard deviation of the errors of recorded positions along each axis [m], for which weights are corrected;
    /// `None`: they are not.
    pub position_error_m: Option<f64>,
    /// How many simulations judge the fit on the last third of the recorded time; `None`: it is not judged.
    pub judge: Option<u32>,
    /// Seed of all random numbers.
    pub seed: u64,
}

fn classes<'a, D: Deserializer<'a>>(from: D) -> Result<Classes, D::Error> {
    Ok(Option::deserialize(from)?.map_or(Classes::Auto, Classes::Exactly))
}

impl Default for Request {
    fn default() -> Request {
        Request::new(Vec::new())
    }
}

impl Request {
    /// The usual one.
    pub fn new(recordings: Vec<PathBuf>) -> Request {
        Request {
            recordings,
            map: None,
            columns: None,
            map_options: MapOptions::default(),
            prior: "conservative".into(),
            reading: None,
            classes: Classes::Auto,
            by_paper: false,
            draws: 200,
            repetitions: 4,
            lead_s: None,
            position_error_m: None,
            judge: None,
            seed: 1,
        }
    }
}

/// What was observed.
pub struct Observed {
    request: Request,
    sources: Sources,
    /// How its drivers follow.
    following: Result<FollowingFit, NotFitted>,
    observations: Observations,
    prior: PriorStyle,
}

/// The style with the prior weights.
#[derive(Clone, Debug)]
struct PriorStyle {
    template: StyleTemplate,
    /// It with the medians of its distributed numbers, the reading that was asked for, and fitted following.
    typical: Style,
    mcdm: Mcdm,
}

impl Request {
    /// Reads the recordings, fits how their drivers follow, and notes what they could choose.
    ///
    /// # Errors
    /// If a number is not in its range, a file cannot be read or is of no known format, a recording lies outside its
    /// map, or the prior style is not one of multi-criteria decision-making.
    pub fn observe(&self) -> Result<Observed, Fault> {
        self.check()?;
        let prior = self.prior_style()?;
        self.observed(Sources::read(self)?, prior)
    }

    fn check(&self) -> Result<(), Fault> {
        let within = |option: &str, number: usize, least: usize, most: usize| {
            if (least..=most).contains(&number) {
                return Ok(());
            }
            Err(Fault::new(option, format!("{number} is out of range"), format!("choose {least} to {most}")))
        };
        if let Classes::Exactly(count) = self.classes {
            within("--classes", count, 1, MOST_CLASSES)?;
        }
        within("--draws", self.draws as usize, 0, 10_000)?;
        within("--repetitions", self.repetitions as usize, 1, 100)?;
        if let Some(count) = self.judge {
            within("--judge", count as usize, 2, 10_000)?;
        }
        if self.recordings.is_empty() {
            return Err(Fault::new("recordings", "there is none", "name a file"));
        }
        /// Longest time between begin and crossing [s].
        const LONGEST: f64 = 10.0;
        /// Largest error [m]: beyond it lanes are not told apart.
        const LARGEST: f64 = 1.0;
        if let Some(lead) = self.lead_s.filter(|it| !(0.0..=LONGEST).contains(it)) {
            let what = format!("{lead} s is no time before a crossing");
            return Err(Fault::new("--lead", what, "choose 0 to 10 s"));
        }
        if let Some(error) = self.position_error_m.filter(|it| !(*it > 0.0 && *it <= LARGEST)) {
            let what = format!("{error} m is no error of positions that can be corrected");
            return Err(Fault::new("--position-error", what, "choose more than 0, and 1 m at most"));
        }
        Ok(())
    }

    /// Fits following to recordings beside a style that has none yet, and notes what drivers who follow so could
    /// choose.
    fn observed(&self, sources: Sources, mut prior: PriorStyle) -> Result<Observed, Fault> {
        let followers = sources.followers(&prior.typical)?;
        let following = followers.fit(&prior.typical, &self.folds(), self.draws);
        prior.typical = with_following(&prior.typical, &following);
        let observations = sources.observations(&prior.typical, self.begin())?;
        Ok(Observed { request: self.clone(), sources, following, observations, prior })
    }

    /// How drivers are held out.
    fn folds(&self) -> Folds {
        Folds { repetitions: self.repetitions, parts: 3, draws: 1000, seed: self.seed }
    }

    /// When changes begin.
    fn begin(&self) -> Begin {
        self.lead_s.map_or(Begin::Auto, Begin::Lead)
    }

    /// The style from which a fit begins, as it is written.
    fn prior_source(&self) -> Result<Source, Fault> {
        find(&self.prior, Path::new("."), || "--prior".to_owned())
    }

    fn prior_style(&self) -> Result<PriorStyle, Fault> {
        let template = StyleTemplate::parse(&self.prior_source()?)?;
        let typical = template.typical().clone();
        let LaneChangeModel::Mcdm(model) = &typical.change else {
            let what = format!("{} does not decide by weighted incentives", self.prior);
            return Err(Fault::new(
                "--prior",
                what,
                "choose a style with model = \"mcdm\", such as conservative",
            ));
        };
        let mcdm = self.reading.map_or(model.clone(), |it| with_reading(model, it));
        let typical = Style { change: LaneChangeModel::Mcdm(mcdm.clone()), ..typical };
        Ok(PriorStyle { template, typical, mcdm })
    }
}

/// `model` with all its incentives in one reading.
fn with_reading(model: &Mcdm, reading: Reading) -> Mcdm {
    let mut model = model.clone();
    model.speed.reading = reading;
    model.route.reading = reading.into();
    model.comfort.reading = reading;
    model.courtesy.reading = reading;
    model.returning.reading = reading;
    model
}

impl Observed {
    /// The prior weights.
    fn weights(&self) -> PriorWeights {
        let mcdm = &self.prior.mcdm;
        let Mcdm { speed, route, comfort, courtesy, returning, .. } = mcdm;
        PriorWeights {
            speed: speed.weight,
            route: route.weight,
            comfort: comfort.weight,
            courtesy: courtesy.weight,
            plain: PLAIN.map(|it| mcdm.weight(it)),
            beta: comfort.beta,
            alpha: returning.alpha,
        }
    }

    /// What was observed.
    pub fn observations(&self) -> &Observations {
        &self.observations
    }

    /// Problems in reading the recordings.
    pub fn problems(&self) -> &[String] {
        &self.sources.problems
    }

    /// What the recordings can tell.
    pub fn plan(&self) -> Plan {
        Plan::of(self)
    }

    /// Fits styles.
    ///
    /// # Errors
    /// If no lane change can be used.
    pub fn fit(&self) -> Result<FitReport, Fault> {
        self.fit_beside(None)
    }

    /// The same, with what was found by [`Observed::judge`]: θ of the styles is moved as there.
    ///
    /// # Errors
    /// If no lane change can be used.
    pub fn fit_beside(&self, judged: Option<Judged>) -> Result<FitReport, Fault> {
        self.check_changes()?;
        let asked = self.asked();
        let (study, correction) = self.corrected(Study::of(&self.observations, &asked), &asked)?;
        let moved_by = judged.as_ref().map_or(0.0, |it| it.theta_moved_by);
        let mut report = FitReport::of(self, &study.with_thresholds_moved(moved_by))?;
        report.correction = correction;
        report.judged = judged;
        if self.request.by_paper {
            report.by_paper =
                by_paper(&self.observations, self.request.seed).iter().map(ByPaper::of).collect();
        }
        report.by_lead = LEADS.iter().map(|it| self.with_lead(*it, &asked)).collect::<Result<_, _>>()?;
        Ok(report)
    }

    /// What is asked of the fit.
    fn asked(&self) -> Asked {
        let Request { draws, classes, .. } = self.request;
        Asked { prior: self.weights(), draws, folds: self.request.folds(), classes }
    }

    /// Refuses recordings without a lane change that can be used.
    fn check_changes(&self) -> Result<(), Fault> {
        if self.observations.used().next().is_some() {
            return Ok(());
        }
        let place = match &self.request.recordings[..] {
            [] => String::new(),
            [one] => one.display().to_string(),
            [first, others @ ..] => format!("{} and {} other recordings", first.display(), others.len()),
        };
        let (what, remedy) = match self.observations.changes.len() {
            0 => {
                ("nobody changes lanes".to_owned(), "give longer recordings, or of roads with several lanes")
            }
            count => (
                format!("none of the {count} lane changes can be used"),
                "see why with --plan, or give more recordings",
            ),
        };
        Err(Fault::new(place, what, remedy))
    }

    /// The weights if all changes begin `lead` [s] before the crossing.
    fn with_lead(&self, lead: f64, asked: &Asked) -> Result<WithLead, Fault> {
        let observations = self.sources.observations(&self.prior.typical, Begin::Lead(lead))?;
        let weights = Study::weights_of(&observations, asked);
        Ok(WithLead::of(lead, &observations, &weights))
    }
}
