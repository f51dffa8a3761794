//! The recordings of a fit with their maps.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use laneweave::sim::Navigator;
use laneweave_calibration::following::Followers;
use laneweave_calibration::observe::{Begin, Observations, Options, Origin, observe};
use laneweave_maps::{FileKind, Map};
use laneweave_models::Style;
use laneweave_network::{LaneletIndex, Network};
use laneweave_recordings::{Matched, Recording, clean, cut_ins, lane_changes};
use laneweave_scenario::scenario::{MapOptions, open_map};
use laneweave_scenario::{Fault, Named, elsewhere, joined, open_recording};

use super::Request;

/// The recordings with their maps.
pub(super) struct Sources {
    /// The places where they were made.
    pub(super) sites: Vec<Site>,
    /// The recordings, in the order in which they were given.
    pub(super) parts: Vec<Part>,
    /// What was joined, what was not, and what is left out.
    pub(super) windows: Vec<String>,
    /// Problems in reading the recordings.
    pub(super) problems: Vec<String>,
}

/// A place with its map.
pub(super) struct Site {
    pub(super) map: SiteMap,
    /// Pairs of lanelets, from the first of which several recorded drivers changed to the second, though the map does
    /// not permit it.
    pub(super) permitted: BTreeSet<[LaneletIndex; 2]>,
    /// The map, in which these changes are permitted.
    pub(super) network: Network,
    /// Routes there.
    pub(super) navigator: Navigator,
}

/// A map as it is.
#[derive(Clone)]
pub(super) struct SiteMap {
    /// Its file.
    pub(super) path: PathBuf,
    /// How it is read.
    pub(super) options: MapOptions,
    /// Latitude and longitude of its (0, 0) [°], if it was projected.
    origin: Option<(f64, f64)>,
    network: Network,
}

/// A recording with its map.
#[derive(Clone)]
pub(super) struct Part {
    /// The name of its file, or of its files.
    pub(super) name: String,
    pub(super) recording: Recording,
    /// The number of its site.
    pub(super) site: usize,
}

impl Sources {
    /// Reads the recordings and their maps.
    ///
    /// # Errors
    /// If a file cannot be read, or all recordings lie outside their maps.
    pub(super) fn read(request: &Request) -> Result<Sources, Fault> {
        let (mut problems, mut windows) = (Vec::new(), Vec::new());
        let (maps, parts) = request.read(&mut problems, &mut windows)?;
        let sources = Sources::of(maps, parts);
        let refused = |part: &Part| request.refuse_elsewhere(&sources.matched(part)).err();
        let mut faults: Vec<Option<Fault>> = sources.parts.iter().map(refused).collect();
        if faults.iter().all(Option::is_none) {
            return Ok(Sources { windows, problems, ..sources });
        }
        if faults.iter().all(Option::is_some)
            && let Some(fault) = faults.swap_remove(0)
        {
            return Err(fault);
        }
        let named = sources.parts.iter().zip(&faults).filter_map(|(part, it)| Some((part, it.as_ref()?)));
        windows.extend(named.map(|(part, fault)| format!("{} is left out: {}", part.name, fault.what)));
        let maps = sources.sites.iter().map(|it| it.map.clone()).collect();
        let kept = sources.parts.into_iter().zip(faults).filter(|it| it.1.is_none()).map(|it| it.0);
        Ok(Sources { windows, problems, ..Sources::of(maps, kept.collect()) })
    }

    /// Recordings with the maps of their sites.
    pub(super) fn of(maps: Vec<SiteMap>, parts: Vec<Part>) -> Sources {
        let site = |(number, map): (usize, SiteMap)| {
            let permitted = permitted(&map.network, parts.iter().filter(|it| it.site == number));
            let network = map.network.clone().permitting(&permitted);
            Site { navigator: Navigator::new(&network), map, permitted, network }
        };
        let sites = maps.into_iter().enumerate().map(site).collect();
        Sources { sites, parts, windows: Vec::new(), problems: Vec::new() }
    }

    /// Recorded time [s].
    pub(super) fn seconds(&self) -> f64 {
        let of = |it: &Part| {
            let frames = it.recording.frames();
            frames.map_or(0.0, |(first, last)| (last - first) as f64 * it.recording.step)
        };
        self.parts.iter().map(of).sum()
    }

    /// A recording with the places of its vehicles.
    pub(super) fn matched<'a>(&'a self, part: &'a Part) -> Matched<'a> {
        Matched::new(&self.sites[part.site].network, &part.recording)
    }

    /// The hardest braking of every follower before whom a recorded driver changes lanes [m/s²].
    pub(super) fn braking_behind(&self) -> Vec<f64> {
        let of = |part: &Part| {
            let matched = self.matched(part);
            let cut_ins = cut_ins(&matched, &lane_changes(&matched));
            cut_ins.iter().filter_map(|it| it.braking(&matched)).collect::<Vec<f64>>()
        };
        self.parts.iter().flat_map(of).collect()
    }

    /// How drivers follow whose road is that of drivers of the style `typical`.
    pub(super) fn followers(&self, typical: &Style) -> Result<Followers, Fault> {
        let mut followers = Followers::default();
        for part in &self.parts {
            let added = followers.add(&self.matched(part), &self.sites[part.site].navigator, typical);
            added.map_err(|error| Fault::new(&typical.name, error, "choose another style"))?;
        }
        Ok(followers)
    }

    /// What drivers of the style `typical` could choose, if their changes begin as `begin` says.
    pub(super) fn observations(&self, typical: &Style, begin: Begin) -> Result<Observations, Fault> {
        let mut options = Options::of(typical.clone());
        options.begin = begin;
        let mut observations = Observations::default();
        for (number, part) in self.parts.iter().enumerate() {
            let origin = Origin { site: part.site as u32, recording: number as u32 };
            let navigator = &self.sites[part.site].navigator;
            let seen = observe(&self.matched(part), navigator, &options, origin);
            let wrong = |error| Fault::new(&typical.name, error, "choose another style");
            observations.extend(seen.map_err(wrong)?);
        }
        Ok(observations)
    }
}

impl Request {
    /// The maps, and the recordings that belong to them: recordings that continue one another are one.
    fn read(
        &self,
        problems: &mut Vec<String>,
        windows: &mut Vec<String>,
    ) -> Result<(Vec<SiteMap>, Vec<Part>), Fault> {
        let mut recordings = Vec::with_capacity(self.recordings.len());
        for path in &self.recordings {
            let (recording, found) = open_recording(path, self.columns.as_deref())?;
            let name = path.display().to_string();
            problems.extend(found.iter().map(|it| format!("{name}: {}: {}", it.element, it.what)));
            recordings.push((name, recording));
        }
        let (maps, by_site) = match &self.map {
            Some(map) => (vec![self.site_map(map)?], vec![recordings]),
            None => self.with_own_maps(recordings)?,
        };
        let mut parts = Vec::new();
        for (site, recordings) in by_site.into_iter().enumerate() {
            let (recordings, notes) = joined(recordings);
            windows.extend(notes);
            let part = |(name, mut it): Named| {
                it.place(maps[site].origin);
                Part { name, recording: clean(it).0, site }
            };
            parts.extend(recordings.into_iter().map(part));
        }
        Ok((maps, parts))
    }

    /// CommonRoad files contain their maps. Those with the same lanelets are one site.
    fn with_own_maps(&self, recordings: Vec<Named>) -> Result<(Vec<SiteMap>, Vec<Vec<Named>>), Fault> {
        let (mut sites, mut by_site): (Vec<SiteMap>, Vec<Vec<Named>>) = (Vec::new(), Vec::new());
        for (path, recording) in self.recordings.iter().zip(recordings) {
            if !FileKind::of(path).has_tracks() {
                let what = "a recording needs the map of its location";
                return Err(Fault::new(path.display(), what, "add --map MAP"));
            }
            let map = self.site_map(path)?;
            let is_same = |it: &SiteMap| {
                let [one, other] = [&it.network, &map.network].map(|it| &it.lanelets);
                let mut both = one.iter().zip(other);
                one.len() == other.len()
                    && both.all(|(a, b)| a.id == b.id && a.centre.points() == b.centre.points())
            };
            let site = sites.iter().position(is_same).unwrap_or(sites.len());
            if site == sites.len() {
                sites.push(map);
                by_site.push(Vec::new());
            }
            by_site[site].push(recording);
        }
        Ok((sites, by_site))
    }

    /// The map at `path`, in which lanelets that meet at their ends continue one another: what drove there shows that
    /// they do.
    fn site_map(&self, path: &std::path::Path) -> Result<SiteMap, Fault> {
        let Map { network, origin, .. } = open_map(path, &self.map_options)?;
        // A network that was sound is so with more joints.
        let network = network.clone().joined().unwrap_or(network);
        Ok(SiteMap { path: path.to_owned(), options: self.map_options.clone(), origin, network })
    }

    /// Refuses a recording most of which lies outside all lanelets.
    fn refuse_elsewhere(&self, matched: &Matched) -> Result<(), Fault> {
        let (states, unmatched) = matched.count_states();
        if 2 * unmatched <= states && states > 0 {
            return Ok(());
        }
        let place = self.map.as_ref().or(self.recordings.first());
        let place = place.map_or(String::new(), |it| it.display().to_string());
        if states == 0 {
            let what = "the recording has no vehicles";
            return Err(Fault::new(place, what, "choose a recording of motor traffic"));
        }
        let problem = elsewhere(matched.recording, matched.network);
        Err(Fault::new(place, problem.what, problem.remedy))
    }
}

/// The pairs of lanelets between which several drivers change lanes, whatever the map says.
fn permitted<'a>(network: &Network, parts: impl Iterator<Item = &'a Part>) -> BTreeSet<[LaneletIndex; 2]> {
    /// So many of them change there (ours): one may be an error of matching.
    const SEVERAL: usize = 2;
    let mut crossed: BTreeMap<[LaneletIndex; 2], usize> = BTreeMap::new();
    for part in parts {
        let matched = Matched::new(network, &part.recording);
        for change in lane_changes(&matched).iter().filter(|it| !it.along_graph) {
            *crossed.entry([change.from, change.to]).or_default() += 1;
        }
    }
    crossed.into_iter().filter(|it| it.1 >= SEVERAL).map(|it| it.0).collect()
}
