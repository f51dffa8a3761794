//! The crates of the project: each depends only on those of lower levels.

use std::fs;
use std::path::Path;

use toml::Table;

/// The crates by level; each level comes above those on which it may depend.
const LEVELS: [&[&str]; 11] = [
    &["network", "models", "study"],
    &["maps", "sim"],
    &["generate", "recordings"],
    &["calibration"],
    &["scenario"],
    &["results"],
    &["laneweave"],
    &["studies"],
    &["viewer"],
    &["cli"],
    &["bench"],
];

fn level(name: &str) -> Option<usize> {
    LEVELS.iter().position(|it| it.contains(&name))
}

#[test]
fn every_crate_depends_on_those_below_it_only() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let read = |path: &Path| -> Table {
        let text = fs::read_to_string(path.join("Cargo.toml")).expect("it is text");
        text.parse().expect("it is TOML")
    };
    let members = read(&root)["workspace"]["members"].as_array().expect("a list").clone();
    assert_eq!(members.len(), LEVELS.concat().len());
    for member in members {
        let member = member.as_str().expect("a path");
        let name = member.rsplit('/').next().expect("it is not empty");
        let own = level(name).unwrap_or_else(|| panic!("{name} has no level"));
        let manifest = read(&root.join(member));
        for dependency in manifest["dependencies"].as_table().expect("a table").keys() {
            let there = level(dependency.strip_prefix("laneweave-").unwrap_or(dependency));
            assert!(there.is_none_or(|it| it < own), "{name} depends on {dependency}");
        }
    }
}
