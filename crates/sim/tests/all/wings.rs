//! The wings of this crate: each wing imports only from wings below it, and only the step changes a world.

use std::fs;
use std::path::{Path, PathBuf};

/// The wings by level. Each level may import from the levels before it.
const LEVELS: [&[&str]; 8] = [
    &["state"],
    &["route"],
    &["junction"],
    &["view"],
    &["demand", "record", "right_of_way"],
    &["driver"],
    &["step"],
    &["ask"],
];

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn level(wing: &str) -> Option<usize> {
    LEVELS.iter().position(|it| it.contains(&wing))
}

/// The wing of every file except the crate's own, with its path and its text.
fn files() -> Vec<(String, PathBuf, String)> {
    let mut folders = vec![source()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let below = path.strip_prefix(source()).expect("it is in there");
            if below.components().count() > 1 {
                let wing = below.iter().next().expect("it is not empty").to_string_lossy().into_owned();
                let text = fs::read_to_string(&path).expect("it is text");
                found.push((wing, path, text));
            }
        }
    }
    found
}

/// The names that follow `crate::` in the code of a text.
fn imported(text: &str) -> impl Iterator<Item = &str> {
    let code = text.lines().filter(|it| !it.trim_start().starts_with("//"));
    let names = code.flat_map(|it| it.split("crate::").skip(1));
    names.map(|it| it.split(|it: char| !(it.is_alphanumeric() || it == '_')).next().unwrap_or_default())
}

#[test]
fn every_wing_has_its_level_and_says_in_a_line_what_it_is() {
    let wings: Vec<&str> = LEVELS.concat();
    for entry in fs::read_dir(source()).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("it has a name").to_string_lossy().into_owned();
        assert!(name == "lib.rs" || wings.contains(&name.as_str()), "{name} is no wing");
    }
    for wing in wings {
        let text = fs::read_to_string(source().join(wing).join("mod.rs")).expect("it is text");
        assert!(text.starts_with("//! "), "{wing} does not say what it is");
    }
}

#[test]
fn imports_run_from_a_wing_to_itself_and_to_those_below_it_only() {
    let files = files();
    assert!(files.len() > 50);
    let mut arrows = 0;
    for (wing, path, text) in &files {
        let own = level(wing).expect("it is a wing");
        assert!(!text.contains("super::super"), "{} goes round the names of wings", path.display());
        for there in imported(text).filter(|it| it != wing) {
            let path = path.display();
            let below = level(there).unwrap_or_else(|| panic!("{path} imports {there}, which is no wing"));
            assert!(below < own, "{path} imports from {there}, which does not lie below {wing}");
            arrows += 1;
        }
    }
    assert!(arrows > 100);
}

#[test]
fn nothing_but_the_step_has_methods_of_the_world() {
    for (wing, path, text) in files() {
        let is_there = text.lines().any(|it| it.starts_with("impl") && it.ends_with("World {"));
        assert!(!is_there || wing == "step", "{} has methods of the world", path.display());
    }
}

#[test]
fn the_parts_of_the_world_keep_their_fields_to_themselves() {
    const PARTS: [&str; 5] = ["Roads", "Traffic", "JunctionState", "Arrivals", "Log"];
    let files = files();
    for part in PARTS {
        let start = format!("pub(crate) struct {part} {{\n");
        let body = files.iter().find_map(|(_, _, text)| text.split(start.as_str()).nth(1));
        let (fields, _) = body.and_then(|it| it.split_once("\n}")).expect(part);
        assert!(!fields.contains("pub"), "a field of {part} can be reached from outside: {fields}");
    }
    let world = files.iter().find_map(|(_, _, text)| text.split("pub struct World {\n").nth(1));
    let (fields, _) = world.and_then(|it| it.split_once("\n}")).expect("World");
    assert!(PARTS.iter().all(|it| fields.contains(&format!(": {it},"))), "{fields}");
    assert!(!fields.contains("pub(crate)") && !fields.contains("pub "), "{fields}");
}
