//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod comfortable;
mod decision;
mod decision_properties;
mod following;
mod incentives;
mod lateral;
mod link_time;
mod lmrs;
mod misperception;
mod mobil;
mod near;
mod returning;
mod safety;
mod situations;
mod weights;
