//! `check` does not panic on any mutation of a map: neither the report, nor the graph, nor the picture.

use std::thread;

use laneweave::generate::{Motorway, motorway};
use laneweave::maps::{ReadOptions, lanelet2};
use laneweave::sim::{Purpose, Random};
use laneweave_studies::check::{GraphJson, Report, picture};
use laneweave_test_data::data;

/// Total number of mutated maps.
const MAPS: u32 = 10_000;
/// Number of mutations of each.
const MUTATIONS: u32 = 100;

/// Values that are unexpected in attributes.
const ODD: [&str; 14] = [
    "",
    "-1",
    "0",
    "1",
    "2",
    "NaN",
    "inf",
    "1e308",
    "-1e-308",
    "99999999999999999999",
    "lanelet",
    "no",
    "&amp;",
    "no_such",
];
/// Pieces of markup.
const SCRAP: [&str; 8] = ["<", "/>", "</osm>", "<way id=\"1\">", "&", "<!--", "\"", "\u{feff}"];

#[test]
fn check_survives_mutated_maps() {
    let maps = originals();
    let (first, second) = thread::scope(|scope| {
        let run = |from: u32| (from..MAPS).step_by(2).map(|it| survives(&maps, it)).sum::<usize>();
        let other = scope.spawn(move || run(1));
        (run(0), other.join().expect("it ends"))
    });
    // Many are still maps, so the steps after reading are tested, too.
    assert!(first + second > MAPS as usize / 5, "only {} could be read", first + second);
}

/// A generated motorway, and real junctions if they are available.
fn originals() -> Vec<String> {
    let small = Motorway {
        lanes: 2,
        length_m: 800.0,
        on_ramp_at: vec![300.0],
        lanelet_length_m: 200.0,
        ..Motorway::default()
    };
    let real = ["lanelet2/xian.osm", "lanelet2/tianjin.osm"].into_iter().filter_map(data);
    let real = real.map(|it| std::fs::read_to_string(it).expect("it is text"));
    let mut maps = vec![lanelet2::write(&motorway(&small).expect("the motorway is possible"))];
    maps.extend(real.map(|it| it.replace('\'', "\"")));
    maps
}

/// Checks the mutation with this number; 1 if it is still a map.
fn survives(maps: &[String], number: u32) -> usize {
    // Real maps are long, so most mutations are of the short one.
    let map = if number.is_multiple_of(20) { number as usize / 20 % maps.len() } else { 0 };
    let text = mutated(&maps[map], number);
    let Ok(map) = lanelet2::read(text.as_bytes(), &ReadOptions::default()) else { return 0 };
    let report = Report::of(&map);
    assert!(!report.to_text().is_empty());
    assert!(serde_json::to_string(&GraphJson(&map)).is_ok());
    assert!(picture("a mutated map", &map, &report.problems).ends_with("</svg>\n"));
    1
}

/// Two of three keep the markup intact and change only values and lines.
fn mutated(text: &str, number: u32) -> String {
    let random = Random::new(7);
    let draw =
        |count: u32, below: usize| (random.uniform(number, Purpose::Arrival, count) * below as f64) as usize;
    let mut lines: Vec<String> = text.lines().map(String::from).collect();
    for mutation in 0..MUTATIONS {
        let at = draw(4 * mutation, lines.len());
        let what = draw(4 * mutation + 1, if number.is_multiple_of(3) { 6 } else { 4 });
        match what {
            // Another value, from a list or from another place in the map.
            0 | 1 => {
                let mut parts: Vec<&str> = lines[at].split('"').collect();
                let place = 2 * draw(4 * mutation + 2, parts.len() / 2 + 1) + 1;
                let other = &lines[draw(4 * mutation + 3, lines.len())];
                let theirs = other.split('"').nth(place).unwrap_or_default();
                if place < parts.len() {
                    parts[place] = if what == 0 { ODD[draw(4 * mutation + 3, ODD.len())] } else { theirs };
                    lines[at] = parts.join("\"");
                }
            }
            // A whole line is removed, or repeated.
            2 if lines.len() > 10 && lines[at].starts_with("<node") => {
                lines.remove(at);
            }
            2 | 3 if lines[at].ends_with('>') && lines[at].starts_with(['<', ' ']) => {
                let line = lines[at].clone();
                if is_whole(&line) {
                    lines.insert(draw(4 * mutation + 2, lines.len() - 3) + 3, line);
                }
            }
            4 => lines[at].push_str(SCRAP[draw(4 * mutation + 2, SCRAP.len())]),
            5 => {
                let cut = draw(4 * mutation + 2, lines[at].len() + 1);
                if lines[at].is_char_boundary(cut) {
                    lines[at].truncate(cut);
                }
            }
            _ => {}
        }
    }
    lines.join("\n")
}

/// Whether the line holds elements that begin and end on it.
fn is_whole(line: &str) -> bool {
    let ends = line.matches("/>").count() + line.matches("</").count();
    line.matches('<').count() - line.matches("</").count() == ends
}
