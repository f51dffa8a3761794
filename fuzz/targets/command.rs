//! Commands: whatever a user gives, one JSON object a line, is carried out or refused in words, and traffic goes on.

#![no_main]

use laneweave::sim::Command;
use libfuzzer_sys::fuzz_target;

mod simulated;

fuzz_target!(|text: &str| {
    let mut simulation = simulated::traffic();
    for line in text.lines().take(32) {
        let Ok(command) = serde_json::from_str::<Command>(line) else { continue };
        if let Err(fault) = simulation.give(command) {
            assert!(!fault.what.is_empty());
        }
        simulation.steps(5);
    }
});
