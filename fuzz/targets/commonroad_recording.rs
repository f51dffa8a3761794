//! CommonRoad recordings: no bytes make reading and cleaning panic or take long, and cleaned tracks are clean.

#![no_main]

use laneweave_recordings::{clean, commonroad};
use libfuzzer_sys::fuzz_target;

mod cleaned;

fuzz_target!(|bytes: &[u8]| {
    if let Ok((recording, _)) = commonroad::read(bytes) {
        cleaned::check(&clean(recording));
    }
});
