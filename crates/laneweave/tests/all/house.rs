//! Files and functions of the project are short.

use std::fs;
use std::path::{Path, PathBuf};

/// Maximum of lines of a file, and of a function; maximum of columns of a comment.
const FILE: usize = 400;
const FUNCTION: usize = 70;
const COMMENT: usize = 120;

/// All source files of the workspace.
fn files() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut folders = vec![root.join("crates"), root.join("bench")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|it| it == "rs") {
                files.push(path);
            }
        }
    }
    files
}

/// The functions of a text in the usual format, each with its number of lines.
fn functions(text: &str) -> Vec<(&str, usize)> {
    const MODIFIERS: [&str; 6] = ["pub(crate) ", "pub(super) ", "pub ", "const ", "async ", "unsafe "];
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let bare = MODIFIERS.iter().fold(code, |code, it| code.strip_prefix(it).unwrap_or(code));
        let Some(head) = bare.strip_prefix("fn ") else { continue };
        let name = head.split(['(', '<']).next().unwrap_or_default();
        // Its end has the same indentation as its beginning; a function without a body ends at once.
        let end = format!("{}}}", &line[..line.len() - code.len()]);
        let length =
            if line.ends_with(';') { Some(0) } else { lines[number..].iter().position(|it| *it == end) };
        found.extend(length.map(|it| (name, it + 1)));
    }
    found
}

#[test]
fn no_comment_is_wide() {
    for path in files() {
        let text = fs::read_to_string(&path).expect("it is text");
        let mut wide = text.lines().zip(1..).filter(|(line, _)| line.trim_start().starts_with("//"));
        let wide = wide.find(|(line, _)| line.chars().count() > COMMENT);
        assert_eq!(wide, None, "{}", path.display());
    }
}

#[test]
fn no_file_and_no_function_is_long() {
    let files = files();
    assert!(files.len() > 300);
    let mut count = 0;
    for path in files {
        let text = fs::read_to_string(&path).expect("it is text");
        let length = text.lines().count();
        assert!(length <= FILE, "{} has {length} lines", path.display());
        for (name, length) in functions(&text) {
            assert!(length <= FUNCTION, "{name} in {} has {length} lines", path.display());
            count += 1;
        }
    }
    assert!(count > 2000, "{count} functions");
}
