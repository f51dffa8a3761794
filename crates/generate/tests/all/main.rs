//! Generated maps.

mod any_numbers;
mod large_town;
mod motorways;
mod own_maps;
mod random_maps;
mod towns;
