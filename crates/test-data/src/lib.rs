//! What the tests of all crates share: where their maps and recordings are, and how much they test.
//!
//! | variable | meaning |
//! |---|---|
//! | `LANEWEAVE_DATA` | the folder of real maps and recordings, or `none`; else `../shared/data` beside the clone |
//! | `LANEWEAVE_SKIPPED` | a file to which each test that skips something adds a line |
//! | `LANEWEAVE_TESTS` | `full` for the whole of those tests that are usually small |
//! | `CI` | `true` where nothing may be skipped unless `LANEWEAVE_DATA` is `none` |

mod data;
mod size;

use std::path::{Path, PathBuf};

pub use data::data;
pub use size::{Size, size};

/// The folder of the maps that come with the program.
pub fn maps() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps")
}

/// A map that comes with the program.
pub fn map(name: &str) -> PathBuf {
    maps().join(name)
}
