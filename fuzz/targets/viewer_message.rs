//! Messages of a page: no text makes the reader panic or take long, and a message that is none is refused in words.

#![no_main]

use laneweave_viewer::Asked;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Err(what) = Asked::read(text) {
        assert!(!what.is_empty());
    }
});
