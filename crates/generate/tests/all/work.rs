//! The work of making a network grows with the map, not with its square.

use laneweave_generate::{Control, Grid, grid};
use laneweave_maps::regulations;

/// Comparisons that it takes to find the junctions of a grid with so many streets in each direction.
fn comparisons(streets: usize, control: Control) -> u64 {
    let wanted = Grid { rows: streets, columns: streets, control, ..Grid::default() };
    let map = grid(&wanted).expect("the grid is possible").build().expect("the drawing is sound");
    let rules = regulations(&map);
    map.network.regulated(&rules).junctions.comparisons
}

#[test]
fn four_times_as_many_junctions_take_at_most_five_times_as_many_comparisons() {
    for control in [Control::Signals, Control::Priority] {
        let [few, many] = [4, 8].map(|it| comparisons(it, control));
        assert!(few > 10_000 && many <= 5 * few, "{control:?}: {few}, then {many}");
    }
}
