//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod commonroad;
mod lanelet2;
mod large_town;
mod motorways;
mod own_maps;
mod proportion;
mod random_maps;
mod real_maps;
mod robustness;
mod towns;
mod work;
