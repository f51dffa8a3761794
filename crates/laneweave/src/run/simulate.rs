//! A run from its first step to its last, with its outputs.

use laneweave_results::Ending;
use laneweave_results::checkpoint::{Checkpoint, FILE, Keeper};
use laneweave_results::output::{Output, Queues, ShortTrips};
use laneweave_scenario::Fault;
use laneweave_scenario::scenario::Prepared;
use laneweave_sim::{CheckpointError, World};

/// Runs `prepared` through its warm-up and its measured time, or continues from a checkpoint. `outputs` observe
/// the world after each measured step. `goes_on` is asked before every step. `when_warm` is called once, when measuring
/// begins or continues. A `keeper` gets checkpoints, if there is one.
///
/// # Errors
/// If an output cannot write its data, or if the checkpoint belongs to another run.
pub fn simulate(
    prepared: &mut Prepared,
    outputs: &mut [Box<dyn Output>],
    from: Option<Checkpoint>,
    keeper: Option<&Keeper>,
    mut goes_on: impl FnMut(&World) -> bool,
    when_warm: impl FnOnce(),
) -> Result<Ending, Fault> {
    let steps = prepared.steps;
    let mut run = match from {
        Some(checkpoint) => Measuring::resumed(prepared, outputs, checkpoint)?,
        None => Measuring::warmed_up(prepared, &mut goes_on),
    };
    when_warm();
    let world = &mut prepared.world;
    while run.measured_steps < steps {
        run.is_interrupted = run.is_interrupted || !goes_on(world);
        if run.is_interrupted {
            break;
        }
        world.step();
        run.measured_steps += 1;
        run.queues.observe(world);
        run.short_trips.observe(world);
        for output in &mut *outputs {
            output.observe(world)?;
        }
        if let Some(keeper) = keeper
            && run.measured_steps.is_multiple_of(keeper.every)
        {
            run.keep(world, outputs, keeper)?;
        }
    }
    let measured_s = world.clock().time() - run.measured_from_s;
    let Measuring { measured_from_s, is_interrupted, queues, short_trips, .. } = run;
    Ok(Ending { measured_from_s, measured_s, is_interrupted, queues: queues.left(world), short_trips })
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
    fn warmed_up(prepared: &mut Prepared, mut goes_on: impl FnMut(&World) -> bool) -> Measuring {
        let Prepared { world, warmup_steps, .. } = prepared;
        let mut is_interrupted = false;
        for _ in 0..*warmup_steps {
            if !goes_on(world) {
                is_interrupted = true;
                break;
            }
            world.step();
        }
        world.reset_counts();
        Measuring {
            measured_from_s: world.clock().time(),
            measured_steps: 0,
            is_interrupted,
            queues: Queues::of(world),
            short_trips: ShortTrips::default(),
        }
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
        prepared.world.restore(&world).map_err(|error| other(error.to_string()))?;
        if kept.len() != outputs.len() {
            return Err(other(format!("{} outputs instead of {}", kept.len(), outputs.len())));
        }
        for (output, kept) in outputs.iter_mut().zip(kept) {
            output.restore(&kept)?;
        }
        Ok(Measuring { measured_from_s, measured_steps, is_interrupted: false, queues, short_trips })
    }

    /// Writes a checkpoint.
    fn keep(&self, world: &World, outputs: &mut [Box<dyn Output>], keeper: &Keeper) -> Result<(), Fault> {
        let kept: Result<Vec<Vec<u8>>, Fault> = outputs.iter_mut().map(|it| it.save(world)).collect();
        let bug = |error: CheckpointError| Fault::new(FILE, error, "report this as a bug");
        let checkpoint = Checkpoint {
            fingerprint: keeper.fingerprint.clone(),
            output_settings: keeper.output_settings.clone(),
            measured_from_s: self.measured_from_s,
            measured_steps: self.measured_steps,
            world: world.save().map_err(bug)?,
            queues: self.queues.clone(),
            short_trips: self.short_trips,
            outputs: kept?,
        };
        checkpoint.write(&keeper.path)
    }
}
