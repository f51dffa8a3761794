//! A run from its first step to its last, watched by observers.

use laneweave_sim::World;

use crate::fault::Fault;
use crate::output::{Observer, Queue, Queues};
use crate::scenario::Prepared;

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// Simulated time at which measuring began [s].
    pub measured_from_s: f64,
    /// Simulated and measured time [s].
    pub measured_s: f64,
    /// It was called off before its time.
    pub is_interrupted: bool,
    /// The queues that are left at the entrances, the longest first.
    pub queues: Vec<Queue>,
}

/// Runs `prepared` through its warm-up and its measured time. `observers` see the world after each measured step;
/// `goes_on` is asked before every step; `when_warm` is called once, when measuring begins.
///
/// # Errors
/// If an observer cannot write what it sees.
pub fn simulate(
    prepared: &mut Prepared,
    observers: &mut [Box<dyn Observer>],
    mut goes_on: impl FnMut(&World) -> bool,
    when_warm: impl FnOnce(),
) -> Result<Ending, Fault> {
    let Prepared { world, warmup_steps, steps, .. } = prepared;
    let mut is_interrupted = false;
    for _ in 0..*warmup_steps {
        if !goes_on(world) {
            is_interrupted = true;
            break;
        }
        world.step();
    }
    world.reset_counts();
    when_warm();
    let mut queues = Queues::of(world);
    let measured_from_s = world.clock().time();
    for _ in 0..*steps {
        is_interrupted = is_interrupted || !goes_on(world);
        if is_interrupted {
            break;
        }
        world.step();
        queues.observe(world);
        for observer in &mut *observers {
            observer.observe(world)?;
        }
    }
    let measured_s = world.clock().time() - measured_from_s;
    Ok(Ending { measured_from_s, measured_s, is_interrupted, queues: queues.left(world) })
}
