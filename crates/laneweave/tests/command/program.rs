//! Runs the program in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU32, Ordering};

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

/// The maps that come with the program.
pub(crate) fn maps() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps")
}

/// What a run of the program left.
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
