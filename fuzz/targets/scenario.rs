//! Scenario files: no text makes the reader panic or take long, and a mistake has a place in the file.

#![no_main]

use laneweave::Source;
use laneweave::scenario::Scenario;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let source = Source { path: "scenario.toml".into(), text: text.into() };
    match source.parse::<Scenario>() {
        Ok(_) => assert!(source.place(&["map"]).starts_with("scenario.toml:")),
        Err(fault) => assert!(fault.place.starts_with("scenario.toml") && !fault.what.is_empty()),
    }
});
