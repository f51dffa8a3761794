//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod an_hour_in_town;
mod approach;
mod bad_calls;
mod bus_lanes;
mod capacity;
mod checkpoint;
mod circles;
mod crates;
mod cut_ins;
mod default_demand;
mod door;
#[allow(unreachable_pub, reason = "the examples are programs of their own, too")]
mod examples;
mod explain;
mod fleet;
mod flows;
mod hostile_maps;
mod house;
mod incidents;
mod lane_drop;
mod null_model_control;
mod roundabouts;
mod simulated;
mod simulation;
mod steps;
mod styles;
mod template;
mod turns;
mod two_entries;
