//! The crates of the project: each depends only on those of lower levels.

use std::fs;
use std::path::{Path, PathBuf};

use toml::Table;

/// The crates by level; each level comes above those on which it may depend.
const LEVELS: [&[&str]; 13] = [
    &["network", "models", "pool", "study", "test-data"],
    &["maps", "sim"],
    &["generate", "recordings"],
    &["recorded"],
    &["calibration"],
    &["scenario"],
    &["results"],
    &["laneweave"],
    &["learning", "studies"],
    &["viewer"],
    &["cli"],
    &["python"],
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
        let dependencies = manifest.get("dependencies").and_then(|it| it.as_table());
        for dependency in dependencies.into_iter().flat_map(Table::keys) {
            let there = level(dependency.strip_prefix("laneweave-").unwrap_or(dependency));
            assert!(there.is_none_or(|it| it < own), "{name} depends on {dependency}");
        }
    }
}

/// Above the library nobody knows what is behind [`laneweave::Simulation`].
#[test]
fn nobody_above_the_library_imports_the_world_or_what_is_prepared_of_it() {
    let library = level("laneweave").expect("it has a level");
    let above: Vec<&str> = LEVELS[library + 1..].concat();
    assert!(above.contains(&"studies") && above.contains(&"bench"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = 0;
    for name in above {
        let folder = if name == "bench" { root.join(name) } else { root.join("crates").join(name) };
        for file in rust_files(&folder) {
            let text = fs::read_to_string(&file).expect("it is text");
            files += 1;
            for word in ["Prepared", "World"] {
                let is_word =
                    |it: &str| it.split(|it: char| !it.is_alphanumeric() && it != '_').any(|it| it == word);
                let code = text.lines().filter(|it| !it.trim_start().starts_with("//"));
                let found = code.filter(|it| !it.contains('"')).find(|it| is_word(it));
                assert_eq!(found, None, "{} names {word}", file.display());
            }
        }
    }
    assert!(files > 100, "{files} files");
}

/// All Rust files of a folder.
pub(crate) fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|it| it.expect("an entry").path());
    entries
        .flat_map(|path| match path.is_dir() {
            true => rust_files(&path),
            false => Vec::from_iter(Some(path).filter(|it| it.extension().is_some_and(|it| it == "rs"))),
        })
        .collect()
}
