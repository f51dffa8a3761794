//! All integration tests of the crate, in one program: it is linked once, and its tests share the cores.

mod any_numbers;
mod large_town;
mod motorways;
mod own_maps;
mod random_maps;
mod roundabouts;
mod signals;
mod towns;
mod work;
