//! A run from its first step to its last, with its outputs.

use laneweave_results::Ending;
use laneweave_results::checkpoint::{Checkpoint, FILE, Keeper};
use laneweave_results::output::{Output, Queues, ShortTrips};
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::Prepared;
use laneweave_sim::CheckpointError;

use crate::Simulation;

/// Runs `simulation` through its warm-up and its measured time, or continues from a checkpoint. `outputs` observe the
/// world after each step. `act` is called before every step: it may give commands, and says whether the run goes on.
/// `when_warm` is called once, when measuring begins or continues. A `keeper` gets checkpoints, if there is one.
///
/// # Errors
/// If an output cannot write its data, if the checkpoint belongs to another run, or if `act` fails or simulates steps
/// itself.
pub fn simulate<E: From<Fault>>(
    simulation: &mut Simulation,
    outputs: &mut [Box<dyn Output>],
    from: Option<Checkpoint>,
    keeper: Option<&Keeper>,
    mut act: impl FnMut(&mut Simulation) -> Result<bool, E>,
    when_warm: impl FnOnce(),
) -> Result<Ending, E> {
    let steps = simulation.prepared.conditions.steps;
    let mut run = match from {
        Some(checkpoint) => Measuring::resumed(&mut simulation.prepared, outputs, checkpoint)?,
        None => Measuring::warmed_up(simulation, outputs, &mut act)?,
    };
    when_warm();
    while run.measured_steps < steps {
        run.is_interrupted = run.is_interrupted || !goes_on(simulation, &mut act)?;
        if run.is_interrupted {
            break;
        }
        simulation.prepared.step();
        run.measured_steps += 1;
        let world = &simulation.prepared.world;
        run.queues.observe(world);
        run.short_trips.observe(world);
        for output in &mut *outputs {
            output.observe(world)?;
        }
        if let Some(keeper) = keeper
            && run.measured_steps.is_multiple_of(keeper.every)
        {
            run.keep(&simulation.prepared, outputs, keeper)?;
        }
    }
    let world = simulation.world();
    let measured_s = world.clock().time() - run.measured_from_s;
    let Measuring { measured_from_s, is_interrupted, queues, short_trips, .. } = run;
    Ok(Ending { measured_from_s, measured_s, is_interrupted, queues: queues.left(world), short_trips })
}

/// Lets `act` give its commands before the next step, and returns whether the run goes on.
fn goes_on<E: From<Fault>>(
    simulation: &mut Simulation,
    act: &mut impl FnMut(&mut Simulation) -> Result<bool, E>,
) -> Result<bool, E> {
    let step = simulation.world().clock().step;
    let goes_on = act(simulation)?;
    if simulation.world().clock().step != step {
        let what = "the program has changed the time of the simulation, so the results would miss steps";
        return Err(Fault::new("run", what, "give commands only: the run simulates the steps").into());
    }
    Ok(goes_on)
}

/// A run in progress.
struct Measuring {
    /// Simulated time at which measuring began [s].
    measured_from_s: f64,
    measured_steps: u32,
    is_interrupted: bool,
    queues: Queues,
    short_trips: ShortTrips,
}

impl Measuring {
    /// The state after the warm-up.
    fn warmed_up<E: From<Fault>>(
        simulation: &mut Simulation,
        outputs: &mut [Box<dyn Output>],
        act: &mut impl FnMut(&mut Simulation) -> Result<bool, E>,
    ) -> Result<Measuring, E> {
        let mut is_interrupted = false;
        for _ in 0..simulation.prepared.conditions.warmup_steps {
            if !goes_on(simulation, act)? {
                is_interrupted = true;
                break;
            }
            simulation.prepared.step();
            for output in &mut *outputs {
                output.warm_up(simulation.world())?;
            }
        }
        let world = &mut simulation.prepared.world;
        if is_interrupted {
            // Nothing was measured.
            world.reset_counts();
        }
        Ok(Measuring {
            measured_from_s: world.clock().time(),
            measured_steps: 0,
            is_interrupted,
            queues: Queues::of(world),
            short_trips: ShortTrips::default(),
        })
    }

    /// The state of a checkpoint.
    fn resumed(
        prepared: &mut Prepared,
        outputs: &mut [Box<dyn Output>],
        checkpoint: Checkpoint,
    ) -> Result<Measuring, Fault> {
        let Checkpoint { measured_from_s, measured_steps, world, queues, short_trips, outputs: kept, .. } =
            checkpoint;
        let other = |what: String| Fault::new(FILE, what, "run again from the beginning, without --resume");
        prepared.restore(&world).map_err(|error| other(error.to_string()))?;
        if kept.len() != outputs.len() {
            return Err(other(format!("{} outputs instead of {}", kept.len(), outputs.len())));
        }
        for (output, kept) in outputs.iter_mut().zip(kept) {
            output.restore(&kept)?;
        }
        Ok(Measuring { measured_from_s, measured_steps, is_interrupted: false, queues, short_trips })
    }

    /// Writes a checkpoint.
    fn keep(
        &self,
        prepared: &Prepared,
        outputs: &mut [Box<dyn Output>],
        keeper: &Keeper,
    ) -> Result<(), Fault> {
        let kept: Result<Vec<Vec<u8>>, Fault> =
            outputs.iter_mut().map(|it| it.save(&prepared.world)).collect();
        let bug = |error: CheckpointError| Fault::bug(FILE, error);
        let checkpoint = Checkpoint {
            fingerprint: keeper.fingerprint.clone(),
            output_settings: keeper.output_settings.clone(),
            measured_from_s: self.measured_from_s,
            measured_steps: self.measured_steps,
            world: prepared.save().map_err(bug)?,
            queues: self.queues.clone(),
            short_trips: self.short_trips,
            outputs: kept?,
        };
        checkpoint.write(&keeper.path)
    }
}
