//! The reader does not panic, and reads everything once, whatever the bytes.

use std::fmt::Write;

use laneweave_maps::{ReadOptions, commonroad};

use crate::commonroad::{read, short, two_lanes};

#[test]
fn entity_bombs_and_deep_nesting_are_refused_with_their_line() {
    let bomb = two_lanes().replacen("<x>0</x>", "<x>\n&lol;</x>", 1);
    let bomb = format!("<!DOCTYPE commonRoad [<!ENTITY lol '0'>]>{bomb}");
    assert!(
        read(&bomb).unwrap_err().to_string().starts_with("line 3: not well-formed XML (the entity &lol;")
    );
    let deep = two_lanes().replacen("<x>0</x>", &"<x>".repeat(40), 1);
    assert!(
        read(&deep).unwrap_err().to_string().starts_with("line 2: not well-formed XML (elements are nested")
    );
}

#[test]
fn no_more_than_32_lanelets_lead_to_one() {
    let all: String = (1..=40).map(|id| short(id, 0.0, "<successor ref='1'/>")).collect();
    let map = read(&format!("<commonRoad commonRoadVersion='2020a'>{all}</commonRoad>")).unwrap();
    let linked = map.network.lanelets.iter().filter(|it| !it.following.is_empty()).count();
    assert_eq!(linked, 32);
    let full = "its successor 1 is not connected: 32 other lanelets already fork or merge there";
    assert_eq!(map.problems.iter().filter(|it| it.what == full).count(), 8);
}

/// The file is so large that work which grew with the square of the references would take hours.
#[test]
fn a_million_references_to_one_lanelet_are_read_once_each() {
    let mut references = String::new();
    for id in 0..1_000_000 {
        let name = ["successor", "predecessor", "trafficSignRef"][id % 3];
        write!(references, "<{name} ref='{}'/>", if id % 2 == 0 { 1 } else { id }).unwrap();
    }
    let all: String =
        (2..20_000).map(|id| short(id, 0.0, "<predecessor ref='1'/><successor ref='1'/>")).collect();
    let text = format!("<commonRoad>{}{all}</commonRoad>", short(1, 0.0, &references));
    let map = read(&text).unwrap();
    assert_eq!(map.network.lanelets.len(), 19_999);
    assert!(map.problems.len() < 100_000);
}

#[test]
fn cut_files_are_refused_or_read_but_never_panic() {
    let text = two_lanes();
    for end in 0..text.len() {
        let read = commonroad::read(&text.as_bytes()[..end], &ReadOptions::default());
        assert_eq!(read.is_ok(), end >= text.len() - 1, "{end}");
    }
}

/// Pseudo-random numbers: a linear congruential generator with Knuth's constants.
struct Dice(u64);

impl Dice {
    /// A number below `sides`.
    fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % sides
    }
}

#[test]
fn ten_thousand_mutated_files_never_panic() {
    const SCRAP: [&str; 29] = [
        "",
        "<",
        ">",
        "/>",
        "'",
        "&",
        "&#0;",
        "&#65;",
        "<!--",
        "<![CDATA[",
        "<?",
        "</lanelet>",
        "<lanelet id='1'>",
        "<point>",
        "-",
        "NaN",
        "inf",
        "1e308",
        "1e-308",
        "99999999999999999999",
        "ref='11'",
        "opposite",
        "\u{feff}",
        "7",
        "0",
        "2.5",
        "same",
        "solid",
        "\n",
    ];
    let (mut dice, text) = (Dice(1), two_lanes().into_bytes());
    let mut read_nevertheless = 0;
    for _ in 0..10_000 {
        let mut bytes = text.clone();
        for _ in 0..=dice.roll(4) {
            let from = dice.roll(bytes.len());
            if bytes[from].is_ascii_digit() {
                bytes[from] = b"-.0e9x"[dice.roll(6)];
            } else if dice.roll(2) == 0 {
                let to = (from + dice.roll(8)).min(bytes.len());
                bytes.splice(from..to, SCRAP[dice.roll(SCRAP.len())].bytes());
            }
        }
        read_nevertheless += usize::from(commonroad::read(&bytes, &ReadOptions::default()).is_ok());
    }
    // Some mutations only touch numbers and names.
    assert!((1_000..9_000).contains(&read_nevertheless), "{read_nevertheless}");
}

#[test]
fn tags_in_any_order_never_panic() {
    let (mut dice, text) = (Dice(2), two_lanes());
    let pieces: Vec<&str> = text.split_inclusive('>').collect();
    for _ in 0..1_000 {
        let mut pieces = pieces.clone();
        for _ in 0..=dice.roll(3) {
            let (one, other) = (dice.roll(pieces.len()), dice.roll(pieces.len()));
            pieces.swap(one, other);
        }
        let _ = commonroad::read(pieces.concat().as_bytes(), &ReadOptions::default());
    }
}
