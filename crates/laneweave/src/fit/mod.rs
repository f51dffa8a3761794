//! Driving styles fitted to recordings.
//!
//! [`Request::observe`] reads recordings and their maps, and notes what every driver could choose. [`Observed::plan`]
//! says what they can tell; [`Observed::fit`] fits styles to them.

#[cfg(feature = "reports")]
mod page;
mod plan;
mod report;
mod style;
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use laneweave_calibration::observe::{Begin, Observations, Options, Origin, observe};
use laneweave_calibration::{Asked, Classes, Folds, PriorWeights, Study, by_paper};
use laneweave_models::change::{LaneChangeModel, Mcdm};
use laneweave_models::{Reading, Style};
use laneweave_network::{LaneletIndex, Network};
use laneweave_recordings::{Matched, Recording, clean, join, lane_changes};
use laneweave_scenario::scenario::{MapOptions, open_map};
use laneweave_scenario::style::{StyleTemplate, find};
use laneweave_scenario::{Fault, elsewhere, open_recording};
use laneweave_sim::Navigator;

use crate::check::extension;

#[cfg(feature = "reports")]
pub use page::page;
pub use plan::{ExpectedWeight, Plan};
pub use report::{
    BetaReport, ByPaper, ClassReport, FitReport, HeldOut, Predictive, Spread, WeightReport, WithLead,
};
pub use style::FittedStyle;

/// Times before the crossing at which changes may begin, for comparison [s].
const LEADS: [f64; 3] = [1.5, 2.5, 3.5];

/// What styles are fitted to, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The recordings.
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
    /// Number of classes of drivers.
    pub classes: Classes,
    /// Whether the paper's procedure is followed, too, to compare.
    pub by_paper: bool,
    /// Draws of the bootstrap.
    pub draws: u32,
    /// Repetitions of holding out a third of the drivers.
    pub repetitions: u32,
    /// Time before the crossing at which changes begin [s]; `None`: as the recording shows it.
    pub lead: Option<f64>,
    /// Seed of all random numbers.
    pub seed: u64,
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
            repetitions: 10,
            lead: None,
            seed: 1,
        }
    }
}

/// What was observed.
pub struct Observed {
    request: Request,
    sources: Sources,
    observations: Observations,
    prior: PriorStyle,
}

/// The recordings with their maps.
struct Sources {
    /// The maps, one for each site.
    sites: Vec<Network>,
    navigators: Vec<Navigator>,
    parts: Vec<Part>,
    /// Problems in reading the recordings.
    problems: Vec<String>,
}

/// The style with the prior weights.
#[derive(Clone, Debug)]
struct PriorStyle {
    template: StyleTemplate,
    /// It with the medians of its distributed numbers, and the reading that was asked for.
    typical: Style,
    mcdm: Mcdm,
}

/// A recording with its map.
struct Part {
    recording: Recording,
    /// The number of its site.
    site: usize,
}

impl Request {
    /// Reads the recordings, and notes what their drivers could choose.
    ///
    /// # Errors
    /// If a file cannot be read or is of no known format, a recording lies outside its map, or the prior style is not
    /// one of multi-criteria decision-making.
    pub fn observe(&self) -> Result<Observed, Fault> {
        let prior = self.prior_style()?;
        let mut problems = Vec::new();
        let (sites, parts) = self.read(&mut problems)?;
        let sites = permitting(sites, &parts);
        let navigators = sites.iter().map(Navigator::new).collect();
        let sources = Sources { sites, navigators, parts, problems };
        for part in &sources.parts {
            self.refuse_elsewhere(&Matched::new(&sources.sites[part.site], &part.recording))?;
        }
        let begin = self.lead.map_or(Begin::Auto, Begin::Lead);
        let observations = sources.observations(&prior.typical, begin)?;
        Ok(Observed { request: self.clone(), sources, observations, prior })
    }

    /// The maps, and the recordings that belong to them: recordings that continue one another are one.
    fn read(&self, problems: &mut Vec<String>) -> Result<(Vec<Network>, Vec<Part>), Fault> {
        let mut recordings = Vec::with_capacity(self.recordings.len());
        for path in &self.recordings {
            let (recording, found) = open_recording(path, self.columns.as_deref())?;
            problems
                .extend(found.iter().map(|it| format!("{}: {}: {}", path.display(), it.element, it.what)));
            recordings.push(recording);
        }
        let Some(map) = &self.map else { return self.read_with_own_maps(recordings) };
        let network = open_map(map, &self.map_options)?.network;
        let joined = if recordings.len() > 1 { join(recordings.clone()).ok() } else { None };
        let recordings = joined.map_or(recordings, |it| vec![it.recording]);
        let parts = recordings.into_iter().map(|it| Part { recording: clean(it).0, site: 0 });
        Ok((vec![network], parts.collect()))
    }

    /// CommonRoad files contain their maps. Those with the same lanelets are one site.
    fn read_with_own_maps(&self, recordings: Vec<Recording>) -> Result<(Vec<Network>, Vec<Part>), Fault> {
        let (mut sites, mut parts): (Vec<Network>, Vec<Part>) = (Vec::new(), Vec::new());
        for (path, recording) in self.recordings.iter().zip(recordings) {
            if extension(path) != "xml" {
                let what = "a recording needs the map of its location";
                return Err(Fault::new(path.display(), what, "add --map MAP"));
            }
            let network = open_map(path, &self.map_options)?.network;
            let is_same = |it: &Network| {
                let both = || it.lanelets.iter().zip(&network.lanelets);
                it.lanelets.len() == network.lanelets.len()
                    && both().all(|(a, b)| a.id == b.id && a.centre.points() == b.centre.points())
            };
            let site = sites.iter().position(is_same).unwrap_or(sites.len());
            if site == sites.len() {
                sites.push(network);
            }
            parts.push(Part { recording: clean(recording).0, site });
        }
        Ok((sites, parts))
    }

    /// Refuses a recording most of which lies outside all lanelets.
    fn refuse_elsewhere(&self, matched: &Matched) -> Result<(), Fault> {
        let (states, unmatched) = matched.count_states();
        if 2 * unmatched <= states && states > 0 {
            return Ok(());
        }
        let place = self.map.as_deref().or(self.recordings.first().map(PathBuf::as_path));
        let place = place.map_or(String::new(), |it| it.display().to_string());
        if states == 0 {
            let what = "the recording has no vehicles";
            return Err(Fault::new(place, what, "choose a recording of motor traffic"));
        }
        let problem = elsewhere(matched.recording, matched.network);
        Err(Fault::new(place, problem.what, problem.remedy))
    }

    fn prior_style(&self) -> Result<PriorStyle, Fault> {
        let place = || "--prior".to_owned();
        let source = find(&self.prior, Path::new("."), place)?;
        let template = StyleTemplate::parse(&source)?;
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

impl Sources {
    /// What drivers of the style `typical` could choose, if their changes begin as `begin` says.
    fn observations(&self, typical: &Style, begin: Begin) -> Result<Observations, Fault> {
        let mut options = Options::of(typical.clone());
        options.begin = begin;
        let mut observations = Observations::default();
        for (number, part) in self.parts.iter().enumerate() {
            let matched = Matched::new(&self.sites[part.site], &part.recording);
            let origin = Origin { site: part.site as u32, recording: number as u32 };
            let seen = observe(&matched, &self.navigators[part.site], &options, origin);
            let wrong = |error| Fault::new(&typical.name, error, "choose another style");
            observations.extend(seen.map_err(wrong)?);
        }
        Ok(observations)
    }
}

/// The maps, in which drivers may change lanes where those of the recordings do, whatever the map says.
fn permitting(sites: Vec<Network>, parts: &[Part]) -> Vec<Network> {
    /// So many of them change there (ours): one may be an error of matching.
    const SEVERAL: usize = 2;
    let mut crossed: Vec<BTreeMap<[LaneletIndex; 2], usize>> = vec![BTreeMap::new(); sites.len()];
    for part in parts {
        let matched = Matched::new(&sites[part.site], &part.recording);
        for change in lane_changes(&matched).iter().filter(|it| !it.along_graph) {
            *crossed[part.site].entry([change.from, change.to]).or_default() += 1;
        }
    }
    let several = |crossed: BTreeMap<[LaneletIndex; 2], usize>| {
        crossed.into_iter().filter(|it| it.1 >= SEVERAL).map(|it| it.0).collect::<BTreeSet<_>>()
    };
    sites.into_iter().zip(crossed).map(|(site, crossed)| site.permitting(&several(crossed))).collect()
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
        let Mcdm { speed, route, comfort, courtesy, keeping, returning, .. } = &self.prior.mcdm;
        PriorWeights {
            speed: speed.weight,
            route: route.weight,
            comfort: comfort.weight,
            courtesy: courtesy.weight,
            keeping: keeping.weight,
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
        if self.observations.used().next().is_none() {
            let place = self.request.recordings.first().map_or(String::new(), |it| it.display().to_string());
            let (what, remedy) = match self.observations.changes.len() {
                0 => (
                    "nobody changes lanes".to_owned(),
                    "give longer recordings, or of roads with several lanes",
                ),
                count => (
                    format!("none of its {count} lane changes can be used"),
                    "see why with --plan, or give more recordings",
                ),
            };
            return Err(Fault::new(place, what, remedy));
        }
        let Request { draws, repetitions, classes, seed, .. } = self.request;
        let folds = Folds { repetitions, parts: 3, draws: 1000, seed };
        let asked = Asked { prior: self.weights(), draws, folds, classes };
        let study = Study::of(&self.observations, &asked);
        let mut report = FitReport::of(self, &study)?;
        if self.request.by_paper {
            report.by_paper = by_paper(&self.observations, seed).iter().map(ByPaper::of).collect();
        }
        report.by_lead = LEADS.iter().map(|it| self.with_lead(*it, &asked)).collect::<Result<_, _>>()?;
        Ok(report)
    }

    /// The weights if all changes begin `lead` [s] before the crossing.
    fn with_lead(&self, lead: f64, asked: &Asked) -> Result<WithLead, Fault> {
        let observations = self.sources.observations(&self.prior.typical, Begin::Lead(lead))?;
        let weights = Study::weights_of(&observations, asked);
        Ok(WithLead::of(lead, &observations, &weights))
    }
}
