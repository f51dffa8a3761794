//! Parquet files: no bytes make reading and cleaning panic or take long, and cleaned tracks are clean. The reader
//! catches panics of the crate that it uses, so those end nothing here.

#![no_main]

use std::panic::set_hook;
use std::sync::LazyLock;

use laneweave_recordings::table::{Columns, Layout};
use laneweave_recordings::{clean, open};
use libfuzzer_sys::fuzz_target;

mod cleaned;
mod file;

/// That of the trajectories of a run.
static LAYOUT: LazyLock<Layout> = LazyLock::new(|| {
    Layout::of_columns(Columns {
        track: "vehicle".into(),
        time: Some("time_s".into()),
        x: "x_m".into(),
        y: "y_m".into(),
        ..Columns::default()
    })
});

fuzz_target!(
    // The hook of the fuzzer would end the process before they are caught.
    init: set_hook(Box::new(|_| {})),
    |bytes: &[u8]| {
        if let Ok((recording, _)) = open(&file::holding(bytes), Some(&LAYOUT)) {
            cleaned::check(&clean(recording));
        }
    }
);
