//! `laneweave explain`.

use std::path::PathBuf;

use clap::Args;
use laneweave::explain::{Commonest, Moment, moment, trip};
use laneweave::record::{End, Record};
use laneweave::{Fault, Simulation};

use super::numbers::whole;
use super::say;

#[derive(Debug, Args)]
pub(crate) struct ExplainArguments {
    /// The folder with the results of a run; the run is repeated.
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// The vehicle to explain, by its id in the tables.
    #[arg(long, value_name = "ID", value_parser = whole::<u32>)]
    vehicle: Option<u32>,
    /// The time to explain, in seconds as in the tables [default: the whole trip].
    #[arg(long, value_name = "S", requires = "vehicle")]
    time: Option<f64>,
    /// Report the smallest change of a weight, a gap or a speed that would have changed each decision.
    #[arg(long, requires = "vehicle")]
    flip: bool,
    /// Explain all drivers, after the warm-up: for what reasons they changed lanes, and why they did not.
    #[arg(long, conflicts_with = "vehicle")]
    summary: bool,
}

impl ExplainArguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let ExplainArguments { out, vehicle, time, flip, summary } = self;
        let Record { scenario, origin, end } = Record::open(&out)?;
        if vehicle.is_none() && !summary {
            let remedy = "give a vehicle with --vehicle ID, or use --summary for all";
            return Err(Fault::new("explain", "no vehicle is given", remedy));
        }
        let End { duration_s, warmup_s, .. } = end;
        let [steps, warmup] =
            [duration_s + warmup_s, warmup_s].map(|it| (it / scenario.run.step_s).round() as u32);
        let last = f64::from(steps) * scenario.run.step_s;
        if let Some(time) = time.filter(|it| !(0.0..=last).contains(it)) {
            let what = format!("the time {time} s");
            return Err(Fault::new(
                "--time",
                what,
                format!("the run lasted from 0 to {last} s: choose a time in this range"),
            ));
        }
        let mut simulation = Simulation::from_scenario(&scenario, &origin)?;
        let Some(vehicle) = vehicle else {
            (0..warmup).for_each(|_| simulation.advance());
            let mut commonest = Commonest::since_now(&simulation);
            (warmup..steps).for_each(|_| commonest.step(&mut simulation));
            return say(&commonest.to_text());
        };
        let never = || {
            let what = format!("no vehicle {vehicle} entered the road");
            Fault::new("--vehicle", what, "choose an id of the tables lane_changes, trips or trajectories")
        };
        let Some(time) = time else {
            let told = trip(&mut simulation, vehicle, steps, flip).ok_or_else(never)?;
            return say(&told);
        };
        match moment(&mut simulation, vehicle, time, steps, flip) {
            Moment::Told(told) => say(&told),
            Moment::At(from, until) => {
                let what = format!("vehicle {vehicle} was not on the road at {time} s");
                let remedy = format!("choose a time from {from:.1} to {until:.1} s");
                Err(Fault::new("--time", what, remedy))
            }
            Moment::Never => Err(never()),
        }
    }
}
