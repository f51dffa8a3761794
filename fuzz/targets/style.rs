//! Style files: no text makes the reader panic or take long, and of a style that was read every driver can be drawn.

#![no_main]

use laneweave::Source;
use laneweave::sim::Random;
use laneweave::style::StyleTemplate;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let source = Source { path: "style.toml".into(), text: text.into() };
    match StyleTemplate::parse(&source) {
        Ok(template) => {
            for number in 0..8 {
                template.draw(&Random::new(1), 0, number).expect("every driver fits");
            }
        }
        Err(fault) => assert!(fault.place.starts_with("style.toml") && !fault.what.is_empty()),
    }
});
