//! A step of traffic after the warm-up allocates no memory.
//!
//! The allocator counts for each thread, so that other tests of the same program do not count.
#![expect(unsafe_code, reason = "an allocator that counts can only be written so")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use crate::roads::{Road, drivers};
use laneweave_generate::{Grid, grid};
use laneweave_maps::regulations;
use laneweave_models::{Attention, Style};
use laneweave_network::{ChainIndex, Network, SignalPlan};
use laneweave_sim::{Class, Placement, Setup, World};

/// The system's allocator, which counts the allocations of this thread.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    ALLOCATIONS.set(ALLOCATIONS.get() + 1);
}

// SAFETY: every call is passed to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller fulfils the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: the caller fulfils the contract of `realloc`.
        unsafe { System.realloc(block, layout, size) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller fulfils the contract of `dealloc`.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Number of allocations in one step.
fn allocations_of_a_step(world: &mut World) -> u64 {
    let before = ALLOCATIONS.get();
    world.step();
    ALLOCATIONS.get() - before
}

fn world(network: Network, total: f64) -> World {
    let demand = drivers::demand(&network, total, 0.1, &[0.3, 0.7]);
    let attention = Attention { concentrated_for: 20.0, inattentive_for: 20.0, ..Attention::default() };
    let driver_parameters = vec![drivers::aggressive(), Style { attention, ..drivers::conservative() }];
    World::new(network, driver_parameters, demand, Setup { step: 0.1, seed: 1, threads: 1 })
        .expect("the set-up makes sense")
}

#[test]
fn steps_of_traffic_that_stays_in_its_lanes_allocate_nothing() {
    let mut world = world(Road { length: 3000.0, is_ring: true, ..Road::default() }.network(), 0.0);
    for number in 0..100 {
        let x = 30.0 * f64::from(number) + 10.0;
        let (chain, parameters) = (ChainIndex(0), number % 2);
        let class = if number % 10 == 0 { Class::Truck } else { Class::Car };
        world
            .place(Placement { chain, x, speed: 15.0, class, parameters, destination: None })
            .expect("it fits on the road");
    }
    (0..600).for_each(|_| world.step());
    assert_eq!((0..3000).map(|_| allocations_of_a_step(&mut world)).sum::<u64>(), 0);
}

#[test]
fn steps_of_traffic_that_enters_changes_lanes_and_leaves_allocate_only_while_a_lane_is_fuller_than_ever() {
    const STEPS: u64 = 3000;
    let mut world = world(Road { lanes: 3, length: 9000.0, ..Road::default() }.network(), 4000.0);
    (0..12_000).for_each(|_| world.step());
    let changes_before = world.counts().discretionary_changes;
    let mut steps_that_allocate = 0;
    for _ in 0..STEPS {
        steps_that_allocate += u64::from(allocations_of_a_step(&mut world) > 0);
    }
    assert!(world.counts().discretionary_changes > changes_before + 100);
    assert!(steps_that_allocate <= STEPS / 500, "{steps_that_allocate} of {STEPS} steps");
}

#[test]
fn steps_of_traffic_at_lights_allocate_only_while_a_lane_or_a_queue_is_fuller_than_ever() {
    const STEPS: u64 = 4000;
    let map = grid(&Grid::default()).expect("the grid is possible").build().expect("the drawing is sound");
    let regulations = regulations(&map);
    let network = map.network.regulated(&regulations);
    let actuated: Vec<SignalPlan> =
        network.junctions.made.iter().cloned().map(SignalPlan::actuated).collect();
    for plans in [&[][..], &actuated] {
        let mut world = world(network.clone().with_signals(plans), 1500.0);
        (0..6000).for_each(|_| world.step());
        let left_before = world.counts().left;
        let mut steps_that_allocate = 0;
        for _ in 0..STEPS {
            steps_that_allocate += u64::from(allocations_of_a_step(&mut world) > 0);
        }
        let left = world.counts().left - left_before;
        assert!(left > 100, "{left} left");
        assert!(steps_that_allocate <= STEPS / 100, "{steps_that_allocate} of {STEPS} steps");
    }
}
