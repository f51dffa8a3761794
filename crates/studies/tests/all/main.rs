//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod branch;
mod commands;
#[allow(unreachable_pub, reason = "the examples are programs of their own, too")]
mod examples;
mod following;
mod gaps;
mod mutations;
mod quick;
mod replayed;
mod same_entrances;
mod sweep;
mod weights;
