//! The reader does not panic, whatever the bytes.

use laneweave_maps::{ReadOptions, lanelet2};
use proptest::prelude::*;

/// A road with an on-ramp.
const MAP: &str = include_str!("../../../../fuzz/seeds/lanelet2/on_ramp.osm");

/// Text that is put into files: markup in unusual places, and invalid numbers.
fn scrap() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        prop::collection::vec(any::<u8>(), 0..4),
        prop::sample::select(vec![
            "<",
            ">",
            "/>",
            "\"",
            "&",
            "&#0;",
            "<!--",
            "<![CDATA[",
            "<?",
            "</osm>",
            "<way id=\"1\">",
            "-",
            "NaN",
            "inf",
            "1e308",
            "-1e-308",
            "\u{feff}",
            "99999999999999999999",
        ])
        .prop_map(|it| it.as_bytes().to_vec()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_maps_never_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), 0_usize..40, scrap()), 1..12),
    ) {
        let mut bytes = MAP.as_bytes().to_vec();
        for (at, length, scrap) in changes {
            let from = at.index(bytes.len().max(1)).min(bytes.len());
            let to = (from + length).min(bytes.len());
            bytes.splice(from..to, scrap);
        }
        let _ = lanelet2::read(&bytes, &ReadOptions::default());
    }

    #[test]
    fn maps_with_any_numbers_never_panic(
        numbers in prop::collection::vec((any::<prop::sample::Index>(), any::<f64>()), 1..30),
    ) {
        let mut parts: Vec<String> = MAP.split('"').map(String::from).collect();
        for (at, number) in numbers {
            // Every second part is the value of an attribute.
            let value = 2 * at.index(parts.len() / 2) + 1;
            if parts[value].parse::<f64>().is_ok() {
                parts[value] = number.to_string();
            }
        }
        let _ = lanelet2::read(parts.join("\"").as_bytes(), &ReadOptions::default());
    }
}
