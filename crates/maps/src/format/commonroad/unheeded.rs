//! Signs and lanelets of CommonRoad that traffic does not use.

use std::collections::HashSet;

use super::document::Document;
use super::rules::classes;
use super::speed::SPEED_SIGNS;
use crate::unused::{Meaning, Unused};

const SIGN: Meaning = (
    "of signs, only speed limits are read, so nobody heeds them",
    "draw the map as Lanelet2, with regulatory elements, if the signs matter",
);
const LONELY_LIMIT: Meaning = (
    "no lanelet refers to them, so their limits have no effect",
    "add a trafficSignRef to the lanelets of that limit",
);
const NO_VEHICLES: Meaning = (
    "no vehicle may drive there, and there are no pedestrians or bicycles",
    "give them userOneWay vehicle if vehicles drive there",
);

/// Counts signs and lanelets that traffic does not use, beside what was found in reading.
pub(super) fn count(document: &Document, unused: &mut Unused) {
    let heeded: HashSet<i64> = document.lanelets.iter().flat_map(|it| &it.signs).copied().collect();
    for sign in &document.signs {
        let place = ("traffic sign", sign.id, sign.line);
        let is_speed = |it: &&(String, Option<f64>)| SPEED_SIGNS.contains(&it.0.as_str());
        let others: Vec<&str> =
            sign.shown.iter().filter(|it| !is_speed(it)).map(|it| it.0.as_str()).collect();
        others.iter().for_each(|it| unused.add(&format!("traffic signs {it}"), place, SIGN));
        if others.len() < sign.shown.len() && !heeded.contains(&sign.id) {
            unused.add("traffic signs with a speed limit", place, LONELY_LIMIT);
        }
    }
    for lanelet in document.lanelets.iter().filter(|it| classes(it).is_empty()) {
        let kind = match (&lanelet.users[..], &lanelet.types[..]) {
            ([], types) => format!("lanelets of the type {}", types.join(" and ")),
            (users, _) => format!("lanelets for the users {}", users.join(" and ")),
        };
        unused.add(&kind, ("lanelet", lanelet.id, lanelet.line), NO_VEHICLES);
    }
}
