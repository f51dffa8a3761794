//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod allocation;
mod assignment;
mod attention;
mod bends;
mod changes;
mod closed_maps;
mod conservation;
mod demand;
mod determinism;
mod external;
mod following;
mod gap_acceptance;
mod headways;
mod junctions;
mod keeping;
mod lanelet_aggregates;
mod lateral;
mod other_models;
mod perception;
mod real_towns;
mod roads;
mod safety;
mod snapshot;
mod trip_log;
mod trips;
mod wings;
