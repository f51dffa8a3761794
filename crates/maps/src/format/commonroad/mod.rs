//! CommonRoad maps: XML with lanelets that name those around them, in the versions 2018b and 2020a.
//!
//! Lanelets have bounds of their own and coordinates in metres. Where the format leaves something open, these rules
//! apply:
//!
//! * A lanelet is for cars if its users say so, or, without users, if all of its types are roads; others (shoulders,
//!   bus lanes, bicycle lanes, sidewalks, crosswalks …) are left out.
//! * A dashed or unpainted line may be crossed, a solid one or a kerb not. The lanelet's own bound counts; if nothing
//!   is known of it, the neighbour's; if nothing is known of either, the line may be crossed.
//! * Where neither the lanelet nor a sign gives a speed limit, the legal one applies: in Germany 50 km/h in towns and
//!   where nothing is known, 130 km/h on motorways, 100 km/h on other roads. The lanelet's type decides; if it has
//!   none, or `urban` alone, the tags of the scenario decide.
//! * Traffic drives on the right unless the options say otherwise: the format has no such field.
//!
//! Static obstacles are contents of the map. Dynamic ones are a recording.
//!
//! Traffic lights, stop lines, intersections and signs other than speed limits are ignored, and named as problems.
//! Lanelets that overlap without a link stay without one.

mod document;
mod element;
mod links;
mod obstacle;
mod rules;
mod speed;
mod unheeded;
mod unused;

use std::collections::BTreeMap;
use std::collections::hash_map::Entry;
use std::mem;

use laneweave_network::{Lanelet, LaneletIndex, Network};

use crate::contents::Contents;
use crate::drawing::Surroundings;
use crate::error::MapError;
use crate::graph::Graph;
use crate::law::Law;
use crate::left_hand;
use crate::map::Map;
use crate::options::ReadOptions;
use crate::problem::Problem;
use crate::shape::Shape;
use crate::size::Size;
use document::Document;
use element::LaneletElement;
use links::Places;
pub use obstacle::{ObstacleShape, Place, Value};
use speed::SpeedSigns;

/// Reads a CommonRoad map. Lanelets that cannot be used as they stand are left out and listed as problems.
///
/// Lanelets that cars may use in both directions are used in their forward direction only, and listed, too.
///
/// # Errors
/// If it is no CommonRoad XML or holds no lanelet that cars may use.
pub fn read(bytes: &[u8], options: &ReadOptions) -> Result<Map, MapError> {
    if bytes.len() as u64 > Size::MAXIMUM.0 {
        return Err(MapError::TooLarge { largest: Size::MAXIMUM });
    }
    let mut problems = Vec::new();
    let mut document = document::parse(bytes, &mut problems)?;
    let mut unused = mem::take(&mut document.unused);
    let mut contents = Contents::default();
    contents.obstacles.extend(document.obstacles.iter().filter_map(|it| it.ground(&mut problems)));
    let (elements, places, mut lanelets) =
        shaped(&document, options.law, &mut contents.limits_of_law, &mut problems);
    links::connect(&elements, &places, &mut lanelets, &mut problems);
    unheeded::count(&document, &mut unused);
    problems.extend(unused.problems());
    let [latitude, longitude] = document.place;
    problems.extend(left_hand::warning(latitude.zip(longitude), None, options));
    if lanelets.is_empty() {
        let remedy = "give lanelets two bounds and a laneletType for cars, such as urban";
        return Err(MapError::NotDrivable { lanelets: document.lanelets.len(), problems, remedy });
    }
    let (graph, heaps) = Graph::of(&lanelets);
    problems.extend(heaps);
    problems.sort_by_key(|it| it.line);
    let mut network = Network::new(lanelets, options.driving_side.unwrap_or_default())?;
    network.law = options.law.rules();
    Ok(Map { network, graph, rules: Vec::new(), programs: BTreeMap::new(), contents, problems, origin: None })
}

/// The lanelets that vehicles may use and that have a shape, without links; and the indices of all ids.
fn shaped<'a>(
    document: &'a Document,
    law: Law,
    of_law: &mut Vec<f64>,
    problems: &mut Vec<Problem>,
) -> (Vec<&'a LaneletElement>, Places, Vec<Lanelet>) {
    let signs = SpeedSigns::of(&document.signs, problems);
    let of_scenario = rules::surroundings_of(&document.tags);
    let (mut elements, mut places, mut lanelets) = (Vec::new(), Places::new(), Vec::new());
    for element in &document.lanelets {
        let Entry::Vacant(place) = places.entry(element.id) else {
            let what = "another lanelet above has the same id, so this one is left out";
            problems.push(element.problem(what, "give it an id of its own"));
            continue;
        };
        let classes = rules::classes(element);
        let lanelet = if classes.is_empty() { None } else { bare(element, problems) };
        place.insert(lanelet.as_ref().map(|_| LaneletIndex(lanelets.len() as u32)));
        let Some(mut lanelet) = lanelet else { continue };
        let surroundings = rules::surroundings(element, of_scenario);
        lanelet.classes = classes;
        lanelet.is_in_town = surroundings == Surroundings::Town;
        lanelet.speed_limit = speed::limit(element, &signs, law, surroundings, of_law, problems);
        elements.push(element);
        lanelets.push(lanelet);
        if rules::is_two_way(element) {
            let what = "it may be used in both directions; only the forward one is";
            problems.push(element.problem(what, "draw a lanelet for each direction"));
        }
    }
    (elements, places, lanelets)
}

/// The shape of `element` as a lanelet.
fn bare(element: &LaneletElement, problems: &mut Vec<Problem>) -> Option<Lanelet> {
    match Shape::between(&element.left.points, &element.right.points) {
        Ok(Shape { left, right, centre, flaws }) => {
            problems.extend(flaws.iter().map(|it| element.problem(it.what, it.remedy)));
            Some(Lanelet::alone(element.id, [left, right, centre], 0.0))
        }
        Err(flaw) => {
            let what = format!("{}, so it is left out", flaw.what);
            problems.push(element.problem(what, flaw.remedy));
            None
        }
    }
}
