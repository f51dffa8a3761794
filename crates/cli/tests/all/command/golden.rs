//! Results that must not change unnoticed. With `LANEWEAVE_BLESS=1` in the environment the files are written again.

use std::fs;
use std::path::Path;

use serde_json::{Map, Value};

use crate::command::program::Folder;

/// Asserts that the file at `path` holds `text`, or writes it there.
pub(crate) fn assert_golden(path: &Path, text: &str) {
    if std::env::var_os("LANEWEAVE_BLESS").is_some() {
        fs::write(path, text).unwrap();
    }
    let expected = fs::read_to_string(path).unwrap_or_default();
    assert!(
        expected == text,
        "{}: differs; if meant so, set LANEWEAVE_BLESS=1. Now:\n{text}",
        path.display()
    );
}

#[test]
fn ten_minutes_on_the_motorway_with_ramps_are_as_they_were() {
    const COUNTS: [&str; 14] = [
        "entered",
        "completed",
        "on_road",
        "waiting_to_enter",
        "lane_changes_discretionary",
        "lane_changes_route_driven",
        "collisions",
        "overlaps",
        "emergency_brakings",
        "stuck",
        "missed_turns",
        "considerations",
        "updates",
        "state_hash",
    ];
    let summary = Folder::new().summary("MAPS/ramps.osm --demand 4200 --record 0");
    let counts: Map<String, Value> = COUNTS.iter().map(|it| ((*it).into(), summary[it].clone())).collect();
    let text = serde_json::to_string_pretty(&counts).unwrap() + "\n";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/golden/ramps.json");
    assert_golden(&path, &text);
}
