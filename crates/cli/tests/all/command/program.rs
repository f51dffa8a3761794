//! Runs the program in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU32, Ordering};

pub(crate) use laneweave_test_data::maps;
use serde_json::Value;

/// A folder that is removed with the test.
pub(crate) struct Folder(PathBuf);

impl Folder {
    pub(crate) fn new() -> Folder {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("laneweave-{}-{number}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// Writes a file.
    pub(crate) fn with(self, name: &str, text: &str) -> Folder {
        fs::write(self.0.join(name), text).unwrap();
        self
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }

    pub(crate) fn holds(&self, name: &str) -> bool {
        self.0.join(name).exists()
    }

    /// The length of a file [bytes]; 0 if it does not exist.
    pub(crate) fn length(&self, name: &str) -> u64 {
        fs::metadata(self.0.join(name)).map_or(0, |it| it.len())
    }

    /// Runs the program here, with the arguments in `line` separated by spaces.
    pub(crate) fn laneweave(&self, line: &str) -> Run {
        let line = line.replace("MAPS", maps().to_str().unwrap());
        let mut command = Command::new(env!("CARGO_BIN_EXE_laneweave"));
        Run(command.args(line.split_whitespace()).current_dir(&self.0).output().unwrap())
    }

    /// Runs the program and reads the object that it prints.
    pub(crate) fn summary(&self, line: &str) -> Value {
        let run = self.laneweave(&format!("run {line} --json"));
        assert_eq!(run.code(), 0, "{}", run.errors());
        serde_json::from_str(&run.text()).unwrap()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A folder with the built-in maps and scenarios.
pub(crate) fn at_home() -> Folder {
    let folder = Folder::new();
    for name in ["maps", "scenarios"] {
        let from = maps().join("..").join(name);
        fs::create_dir(folder.path().join(name)).unwrap();
        for file in fs::read_dir(from).unwrap() {
            let file = file.unwrap();
            fs::copy(file.path(), folder.path().join(name).join(file.file_name())).unwrap();
        }
    }
    folder
}

/// `line` without its first `--duration` if it has two.
pub(crate) fn without_first_duration(line: &str) -> String {
    let words: Vec<&str> = line.split_whitespace().collect();
    let places: Vec<usize> = (0..words.len()).filter(|it| words[*it] == "--duration").collect();
    match places[..] {
        [first, _] => [&words[..first], &words[first + 2..]].concat().join(" "),
        _ => line.into(),
    }
}

/// A map of a closed loop of four lanelets: no vehicle enters it or leaves it.
pub(crate) fn closed() -> String {
    let mut map = String::from("<osm>");
    for (id, x, y) in [(1, 0, 0), (2, 90, 0), (3, 90, 90), (4, 0, 90)] {
        let (inner_x, inner_y) = (if x == 0 { 4 } else { x - 4 }, if y == 0 { 4 } else { y - 4 });
        map +=
            &format!("<node id='{id}' x='{x}' y='{y}'/><node id='{}' x='{inner_x}' y='{inner_y}'/>", id + 10);
    }
    for (id, next) in [(1, 2), (2, 3), (3, 4), (4, 1)] {
        map += &format!(
            "<way id='{0}'><nd ref='{id}'/><nd ref='{next}'/></way>\
             <way id='{1}'><nd ref='{2}'/><nd ref='{3}'/></way>\
             <relation id='{4}'><member type='way' ref='{1}' role='left'/><member type='way' ref='{0}' role='right'/>\
             <tag k='type' v='lanelet'/><tag k='subtype' v='road'/><tag k='speed_limit' v='50'/></relation>",
            id + 20,
            id + 30,
            id + 10,
            next + 10,
            id + 40
        );
    }
    map + "</osm>"
}

/// The files of a run of the program.
pub(crate) struct Run(Output);

impl Run {
    pub(crate) fn code(&self) -> i32 {
        self.0.status.code().unwrap()
    }

    pub(crate) fn text(&self) -> String {
        String::from_utf8(self.0.stdout.clone()).unwrap()
    }

    pub(crate) fn errors(&self) -> String {
        String::from_utf8(self.0.stderr.clone()).unwrap()
    }
}
