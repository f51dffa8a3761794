//! Lanelet2 maps: no bytes make the reader panic or take long, and what was read is the same map after it was written.

#![no_main]

use laneweave_maps::lanelet2::{self, Document};
use laneweave_maps::{Map, ReadOptions};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok((document, _)) = Document::parse(bytes) else { return };
    let written = document.write();
    let (again, problems) = Document::parse(written.as_bytes()).expect("what was written can be read");
    assert!(problems.is_empty(), "{problems:?}");
    assert_eq!(again.write(), written);
    let read = |bytes| lanelet2::read(bytes, &ReadOptions::default()).ok();
    assert_eq!(read(bytes).map(essence), read(written.as_bytes()).map(essence));
});

/// What does not depend on the lines of the file.
fn essence(map: Map) -> impl PartialEq + std::fmt::Debug {
    (map.graph, map.contents, map.origin, map.network.driving_side)
}
