//! `laneweave observe`.

use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use laneweave::record::{End, Record};
use laneweave::recordings::{Drone, Interruptions, Recording};
use laneweave::{Fault, Simulation};

use super::numbers::{number, seed};
use super::recording::{told, write};
use super::say;

#[derive(Debug, Args)]
pub(crate) struct ObserveArguments {
    /// The folder with the results of a run; the run is repeated.
    #[arg(value_name = "OUT_DIR")]
    out: PathBuf,
    /// The recording to write, in the layout of INTERACTION.
    #[arg(long, value_name = "FILE", default_value = "observed.csv", value_hint = ValueHint::FilePath)]
    to: PathBuf,
    /// Record from this time on, in seconds after the warm-up.
    #[arg(long, value_name = "S", value_parser = number, default_value = "0")]
    from: f64,
    /// Record until this time [default: the end of the run].
    #[arg(long, value_name = "S", value_parser = number)]
    until: Option<f64>,
    /// Where the drone is: east and north in the coordinates of the map, in metres.
    #[arg(long, value_name = "X,Y", value_parser = place, allow_hyphen_values = true, requires = "view")]
    above: Option<[f64; 2]>,
    /// Side of its square field of view, in metres [default: it sees the whole map].
    #[arg(long, value_name = "M", value_parser = number, requires = "above")]
    view: Option<f64>,
    /// Frames per second.
    #[arg(long, value_name = "HZ", value_parser = number, default_value = "25")]
    rate: f64,
    /// Standard deviation of positions along each axis, in metres.
    #[arg(long, value_name = "M", value_parser = number, default_value = "0.1")]
    noise: f64,
    /// Mean time until the drone loses a vehicle, in seconds [default: it loses none].
    #[arg(long, value_name = "S", value_parser = number)]
    lost_every: Option<f64>,
    /// Time for which a vehicle is lost, in seconds.
    #[arg(long, value_name = "S", value_parser = number, default_value = "1", requires = "lost_every")]
    lost_for: f64,
    /// Seed of the errors.
    #[arg(long, value_name = "N", value_parser = seed, default_value = "1")]
    seed: u64,
}

fn place(text: &str) -> Result<[f64; 2], String> {
    let (east, north) = text.split_once(',').ok_or("write X,Y in metres, such as 250,-40")?;
    Ok([number(east.trim())?, number(north.trim())?])
}

impl ObserveArguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let drone = self.drone()?;
        let observed = drone.observe(&watched(&self.out, [self.from, self.until.unwrap_or(f64::INFINITY)])?);
        write(&self.to, &observed)?;
        say(&format!("{} {}\n", told(&observed), self.to.display()))
    }

    fn drone(&self) -> Result<Drone, Fault> {
        let within = |option: &str, value: f64, [least, most]: [f64; 2]| {
            if (least..=most).contains(&value) {
                return Ok(value);
            }
            Err(Fault::new(option, format!("{value} is out of range"), format!("choose {least} to {most}")))
        };
        let interruptions = match self.lost_every {
            None => None,
            Some(every) => Some(Interruptions {
                every: within("--lost-every", every, [0.1, 1e6])?,
                lasting: within("--lost-for", self.lost_for, [0.0, 1e6])?,
            }),
        };
        Ok(Drone {
            above: self.above.unwrap_or_default(),
            view: self.view.map_or(Ok(f64::INFINITY), |it| within("--view", it, [1.0, 1e6]))?,
            frames_per_second: within("--rate", self.rate, [0.5, 100.0])?,
            noise: within("--noise", self.noise, [0.0, 10.0])?,
            interruptions,
            seed: self.seed,
        })
    }
}

/// The traffic of the run in the folder `out` at every step between two times after its warm-up [s].
fn watched(out: &Path, [from, until]: [f64; 2]) -> Result<Recording, Fault> {
    let Record { scenario, origin, end } = Record::open(out)?;
    let End { duration_s, warmup_s, .. } = end;
    let [measured, warmup] = [duration_s, warmup_s].map(|it| (it / scenario.run.step_s).round() as u32);
    let mut simulation = Simulation::from_scenario(&scenario, &origin)?;
    (0..warmup).for_each(|_| simulation.advance());
    if !(0.0..until.min(duration_s)).contains(&from) {
        let what = format!("from {from} to {} s", until.min(duration_s));
        return Err(Fault::new(
            "--from, --until",
            what,
            format!("choose times between 0 and {duration_s} s"),
        ));
    }
    let mut watch = simulation.drone_watch();
    for step in 0..=measured {
        let time = f64::from(step) * scenario.run.step_s;
        if (from..=until).contains(&time) {
            simulation.show(&mut watch);
        }
        simulation.advance();
    }
    Ok(watch.into_recording())
}
