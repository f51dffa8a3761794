//! A page on which lanelets are found by their ids, and say what a scenario needs to know of them.

use std::collections::{HashMap, HashSet};

use laneweave_maps::{Map, Problem};
use laneweave_network::{Gate, LaneletIndex};
use laneweave_study::escaped;
use serde::Serialize;

use super::{LEGEND, bare};
use crate::check::{Opening, Report};

const PAGE: &str = include_str!("explorer.html");
const STYLE: &str = include_str!("explorer.css");
const SCRIPT: &str = include_str!("explorer.js");

/// The map as one HTML file that needs no other one: its picture, which can be moved and enlarged, with a search for
/// ids, and what is known of each lanelet. `report` is that of the map.
pub fn explorer(title: &str, map: &Map, report: &Report) -> String {
    let facts = Facts::of(map, report);
    // "<" would end the script early.
    let facts = serde_json::to_string(&facts).unwrap_or_default().replace('<', "\\u003c");
    let key = |(text, colour): &(&str, &str)| {
        format!("<li><svg viewBox=\"0 0 1 1\"><path d=\"M0 0h1v1H0z\" fill=\"{colour}\"/></svg>{text}</li>\n")
    };
    let parts = [
        ("{{title}}", escaped(title)),
        ("{{style}}", STYLE.to_owned()),
        ("{{heading}}", escaped(title)),
        ("{{legend}}", LEGEND.iter().map(key).collect()),
        ("{{map}}", bare(map, &report.problems)),
        ("{{facts}}", facts),
        ("{{script}}", SCRIPT.to_owned()),
    ];
    let mut page = String::new();
    let mut rest = PAGE;
    // Each part stands once, in this order, so that none is looked for in another one.
    for (mark, part) in &parts {
        let Some((before, after)) = rest.split_once(mark) else { continue };
        page += before;
        page += part;
        rest = after;
    }
    page + rest
}

/// The id of a lanelet in digits: numbers of a browser have 53 bits.
type Id = String;

/// What the page says.
#[derive(Serialize)]
struct Facts<'a> {
    /// The names of the entrances and exits that a run uses: their smallest lanelet ids.
    entrances: Vec<Id>,
    exits: Vec<Id>,
    lanelets: Vec<LaneletFacts>,
    problems: Vec<ProblemFacts<'a>>,
}

#[derive(Serialize)]
struct LaneletFacts {
    id: Id,
    length_m: f64,
    limit_kmh: f64,
    next: Vec<Id>,
    before: Vec<Id>,
    /// To which a change is allowed.
    left: Option<Id>,
    right: Option<Id>,
    /// Those beside it to which none is allowed.
    closed: Vec<Id>,
    /// The entrance or the exit to which it belongs.
    entrance: Option<Id>,
    exit: Option<Id>,
}

#[derive(Serialize)]
struct ProblemFacts<'a> {
    /// The lanelet, if it is one that is drawn.
    id: Option<Id>,
    element: &'a str,
    what: &'a str,
    remedy: &'a str,
}

impl<'a> Facts<'a> {
    fn of(map: &Map, report: &'a Report) -> Facts<'a> {
        let network = &map.network;
        let id = |it: &LaneletIndex| network.lanelets[it.at()].id.to_string();
        let names = |used: &[Opening]| used.iter().map(|it| it.id.to_string()).collect::<Vec<Id>>();
        let (used_entrances, used_exits) = (names(&report.entrances), names(&report.exits));
        let entrances = gates(map, &network.entrances, &used_entrances, |it| it.first());
        let exits = gates(map, &network.exits, &used_exits, |it| it.last());
        let mut before = vec![Vec::new(); network.lanelets.len()];
        for lanelet in &network.lanelets {
            lanelet.following.iter().for_each(|it| before[it.at()].push(lanelet.id.to_string()));
        }
        let round = |value: f64| (value * 10.0).round() / 10.0;
        let facts = |(number, before): (usize, Vec<Id>)| {
            let (lanelet, index) = (&network.lanelets[number], LaneletIndex(number as u32));
            let closed = [&lanelet.adjacent_left, &lanelet.adjacent_right];
            LaneletFacts {
                id: lanelet.id.to_string(),
                length_m: round(lanelet.length()),
                limit_kmh: round(lanelet.speed_limit * 3.6),
                next: lanelet.following.iter().map(id).collect(),
                before,
                left: lanelet.left.as_ref().map(id),
                right: lanelet.right.as_ref().map(id),
                closed: closed.into_iter().flatten().map(id).collect(),
                entrance: entrances.get(&index).cloned(),
                exit: exits.get(&index).cloned(),
            }
        };
        let lanelets: Vec<LaneletFacts> = before.into_iter().enumerate().map(facts).collect();
        let drawn: HashSet<&str> = lanelets.iter().map(|it| it.id.as_str()).collect();
        let problem = |it: &'a Problem| {
            let id = it.element.strip_prefix("lanelet ").filter(|it| drawn.contains(it)).map(str::to_owned);
            ProblemFacts { id, element: &it.element, what: &it.what, remedy: &it.remedy }
        };
        Facts {
            entrances: used_entrances,
            exits: used_exits,
            problems: report.problems.iter().map(problem).collect(),
            lanelets,
        }
    }
}

/// The names of the `used` gates by the lanelets at which they lie: the first or the last of their chains.
fn gates(
    map: &Map,
    gates: &[Gate],
    used: &[Id],
    end: fn(&[LaneletIndex]) -> Option<&LaneletIndex>,
) -> HashMap<LaneletIndex, Id> {
    let mut names = HashMap::new();
    for gate in gates {
        let name = gate.id.to_string();
        let ends = gate.chains.iter().filter_map(|it| end(&map.network.chain(*it).lanelets));
        names.extend(ends.filter(|_| used.contains(&name)).map(|it| (*it, name.clone())));
    }
    names
}
