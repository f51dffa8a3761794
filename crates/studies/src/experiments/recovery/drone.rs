//! Drivers who are seen by a drone: their positions, 25 times a second, with errors of 10 cm.

use std::collections::BTreeMap;

use laneweave::Fault;
use laneweave::models::Style;
use laneweave::network::Network;
use laneweave::recordings::{Drone, Matched, Recording, clean};
use laneweave::sim::Navigator;
use laneweave_calibration::observe::{Known, Observations, Options, Origin, observe};

use super::settings::Setting;
use super::truth::Truth;

/// The name of the style whose drivers are fitted.
const FITTED: &str = "conservative";
/// Frames per second.
const FRAMES: f64 = 25.0;
/// Errors of positions [m].
pub(crate) const NOISE: f64 = 0.1;

/// Simulated drivers with the truth about them.
pub(crate) struct Driven {
    pub(crate) seed: u64,
    /// The traffic, exactly.
    traffic: Recording,
    network: Network,
    /// The names of the styles of all drivers.
    styles: BTreeMap<i64, String>,
    /// The parameters of all drivers.
    driver_parameters: Vec<Style>,
    /// The style that is fitted.
    pub(crate) style: Style,
    /// Whether rates of changes differ between places.
    pub(crate) has_places: bool,
    /// What is true of the drivers.
    pub(crate) truth: Known,
}

impl Driven {
    /// Those of `setting` with one seed, its times multiplied by `length`.
    pub(crate) fn of(setting: &Setting, seed: u64, length: f64) -> Result<Driven, Fault> {
        let mut simulation = setting.traffic.simulation(seed, length)?;
        let [warmup_steps, steps] = simulation.run_steps();
        (0..warmup_steps).for_each(|_| simulation.advance());
        let (mut watch, mut truth) = (simulation.drone_watch(), Truth::from_now(&simulation));
        for _ in 0..steps {
            simulation.show(&mut watch);
            truth.see(&simulation);
            simulation.advance();
        }
        let (truth, styles) = truth.into_known();
        let driver_parameters = simulation.driver_parameters().to_vec();
        let style = driver_parameters.iter().find(|it| it.name == FITTED).cloned();
        let none = || Fault::bug("recovery", format!("nobody is {FITTED}"));
        Ok(Driven {
            seed,
            traffic: watch.into_recording(),
            network: simulation.network().clone(),
            styles,
            driver_parameters,
            has_places: setting.has_places,
            style: style.ok_or_else(none)?,
            truth,
        })
    }

    /// What a drone records of them, with errors of `noise` [m].
    pub(crate) fn recorded(&self, noise: f64) -> Recording {
        clean(self.drone(noise).observe(&self.traffic)).0
    }

    /// The same with errors of [`NOISE`], to which others of `more` [m] are added, drawn with their own seed.
    pub(crate) fn recorded_worse(&self, more: f64, seed: u64) -> Recording {
        let drone = Drone { noise: more, seed: (self.seed << 16) + seed, ..Drone::exact(FRAMES) };
        clean(drone.observe(&self.drone(NOISE).observe(&self.traffic))).0
    }

    fn drone(&self, noise: f64) -> Drone {
        Drone { noise, seed: self.seed + 1, ..Drone::exact(FRAMES) }
    }

    /// The recording with the places of its vehicles.
    pub(crate) fn matched<'a>(&'a self, recording: &'a Recording) -> Matched<'a> {
        Matched::new(&self.network, recording)
    }

    /// What the recording shows of the drivers of the fitted style, of whom this is known. They are looked at `phases`
    /// times in a second.
    pub(crate) fn observations(
        &self,
        matched: &Matched,
        known: Known,
        phases: u32,
    ) -> Result<Observations, Fault> {
        let options = Options { known, phases, ..Options::of(self.style.clone()) };
        let mut seen = self.all_observations(matched, &options)?;
        seen.drivers.retain(|it| self.style_of(it.vehicle) == FITTED);
        Ok(seen)
    }

    /// What the recording shows of all drivers.
    pub(crate) fn all_observations(
        &self,
        matched: &Matched,
        options: &Options,
    ) -> Result<Observations, Fault> {
        let seen = observe(matched, &Navigator::new(&self.network), options, Origin::default());
        seen.map_err(|error| Fault::bug("recovery", error))
    }

    /// The first driver parameters of the style with this name.
    pub(crate) fn style(&self, name: &str) -> Option<&Style> {
        self.driver_parameters.iter().find(|it| it.name == name)
    }

    /// The name of the style of a driver.
    pub(crate) fn style_of(&self, vehicle: i64) -> &str {
        self.styles.get(&vehicle).map_or("", String::as_str)
    }
}
