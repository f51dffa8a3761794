//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod commonroad;
mod lanelet2;
mod other_formats;
mod proportion;
mod real_maps;
mod robustness;
mod sumo;
mod unused;
