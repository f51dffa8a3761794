//! Tables of datasets: no bytes make reading and cleaning panic or take long, and cleaned tracks are clean. The first
//! byte chooses the dataset.

#![no_main]

use laneweave_recordings::clean;
use laneweave_recordings::datasets::Dataset;
use laneweave_recordings::table::{Known, read};
use libfuzzer_sys::fuzz_target;

mod cleaned;

fuzz_target!(|bytes: &[u8]| {
    let Some((first, table)) = bytes.split_first() else { return };
    let dataset = Dataset::ALL[usize::from(*first) % Dataset::ALL.len()];
    if let Ok((recording, _)) = read(table, &dataset.layout(), &Known::default()) {
        cleaned::check(&clean(recording));
    }
});
