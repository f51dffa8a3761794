//! Checkpoints: no bytes make restoring panic or take long, and what is refused changes nothing. The input is a
//! checkpoint, or changes a sound one: three bytes are a place and what is written there.

#![no_main]

use laneweave_sim::{sealed, unsealed};
use libfuzzer_sys::fuzz_target;

mod simulated;

fuzz_target!(|bytes: &[u8]| {
    let mut simulation = simulated::traffic();
    let before = simulation.state_hash();
    let sound = simulation.save().expect("there is memory");
    let mut body = unsealed(&sound).expect("it is sound").to_vec();
    for change in bytes.chunks_exact(3) {
        let place = usize::from(change[0]) << 8 | usize::from(change[1]);
        let last = body.len() - 1;
        body[place.min(last)] = change[2];
    }
    for damaged in [bytes.to_vec(), sealed(bytes.to_vec()), sealed(body)] {
        match simulation.restore(&damaged) {
            Ok(()) => simulation.restore(&sound).expect("it is sound"),
            Err(fault) => assert!(!fault.what.is_empty()),
        }
        assert_eq!(simulation.state_hash(), before);
    }
});
