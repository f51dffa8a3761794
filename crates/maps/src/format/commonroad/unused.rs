//! Elements of CommonRoad that traffic does not use.

use std::borrow::Cow;

use crate::unused::Meaning;

const LIGHT: Meaning = (
    "they are not read from CommonRoad, so nobody stops for them",
    "draw the map as Lanelet2 if its lights matter",
);
const STOP_LINE: Meaning = (
    "they are not read from CommonRoad, so nobody stops there for a sign or a light",
    "draw the map as Lanelet2 if its stop lines matter",
);
const INTERSECTION: Meaning = (
    "they are not read: who goes first follows from the lanelets, as where no sign stands",
    "draw the map as Lanelet2, with rules right_of_way, if its priorities matter",
);
const PLANNING: Meaning = (
    "a task for one planned vehicle is no part of the traffic",
    "leave it so, or drive that vehicle as an external one (library)",
);
const ELEMENT: Meaning =
    ("this element is not read", "leave it so, or say what it means by lanelets and signs");
/// The kind of an element that traffic does not use, by its path; its name; and what follows.
pub(super) fn element(path: &str) -> Option<(Cow<'static, str>, &'static str, Meaning)> {
    Some(match path {
        // Moving obstacles are a recording.
        "location" | "scenarioTags" | "dynamicObstacle" => return None,
        "trafficLight" => ("traffic lights".into(), "traffic light", LIGHT),
        "lanelet/stopLine" => ("stop lines".into(), "stop line of lanelet", STOP_LINE),
        "intersection" => ("intersections".into(), "intersection", INTERSECTION),
        "planningProblem" => ("planning problems".into(), "planning problem", PLANNING),
        other => (format!("elements <{other}>").into(), "element", ELEMENT),
    })
}
