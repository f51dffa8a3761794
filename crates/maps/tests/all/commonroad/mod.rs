//! CommonRoad maps: a small one made for the test, broken ones, and real ones if they are available.

mod map;
mod real;
mod robustness;

use laneweave_maps::{Map, MapError, ReadOptions, commonroad};

/// Two lanes to the east (11 and 12 on the left, 21 and 22 on the right), one to the west (31) on their left,
/// and a sidewalk (41) on their right. The line between 11 and 21 is dashed, that between 12 and 22 solid.
pub(crate) fn two_lanes() -> String {
    let lane = |id: i64, from: f64, to: f64, right: f64, marks: [&str; 2], inside: &str| {
        let bound = |name: &str, y: f64, mark: &str| {
            let point = |x: f64| format!("<point><x>{x}</x><y>{y}</y></point>");
            let mark =
                if mark.is_empty() { mark.into() } else { format!("<lineMarking>{mark}</lineMarking>") };
            format!("<{name}>{}{}{mark}</{name}>", point(from), point(to))
        };
        let left = right + if to > from { 3.5 } else { -3.5 };
        let (left, right) = (bound("leftBound", left, marks[0]), bound("rightBound", right, marks[1]));
        format!("<lanelet id='{id}'>{left}{right}{inside}</lanelet>\n")
    };
    let beside = |left: &str, right: &str| {
        let one = |name: &str, it: &str| match it.split_once(' ') {
            Some((id, direction)) => format!("<{name} ref='{id}' drivingDir='{direction}'/>"),
            None => String::new(),
        };
        one("adjacentLeft", left) + &one("adjacentRight", right)
    };
    let mut text = String::from("<commonRoad commonRoadVersion='2020a' benchmarkID='ZAM_Own-1_1_T-1'>\n");
    text += &lane(
        11,
        0.0,
        100.0,
        3.5,
        ["solid", "dashed"],
        &format!("<successor ref='12'/>{}<laneletType>urban</laneletType>", beside("31 opposite", "21 same")),
    );
    text += &lane(
        12,
        100.0,
        200.0,
        3.5,
        ["", "solid"],
        &format!("<predecessor ref='11'/>{}<laneletType>interstate</laneletType>", beside("", "22 same")),
    );
    text += &lane(
        21,
        0.0,
        100.0,
        0.0,
        ["dashed", ""],
        &format!("<successor ref='22'/>{}<trafficSignRef ref='9'/>", beside("11 same", "41 same")),
    );
    text += &lane(
        22,
        100.0,
        200.0,
        0.0,
        ["", "curb"],
        &format!("<predecessor ref='21'/>{}<speedLimit>10</speedLimit>", beside("12 same", "")),
    );
    text += &lane(31, 100.0, 0.0, 10.5, ["", ""], &beside("11 opposite", ""));
    text += &lane(
        41,
        0.0,
        100.0,
        -3.5,
        ["", ""],
        &format!("<laneletType>sidewalk</laneletType>{}", beside("21 same", "")),
    );
    text += "<trafficSign id='9'><trafficSignElement><trafficSignID>R2-1</trafficSignID>\
             <additionalValue>20</additionalValue></trafficSignElement></trafficSign>\n</commonRoad>\n";
    text
}

pub(crate) fn read(text: &str) -> Result<Map, MapError> {
    commonroad::read(text.as_bytes(), &ReadOptions::default())
}

/// The problems of a map with two lanes, beside the one that nobody drives on the sidewalk.
pub(crate) fn problems(map: &Map) -> Vec<String> {
    let all = map.problems.iter().map(ToString::to_string);
    all.filter(|it| !it.contains("lanelets of the type sidewalk, 1 in all")).collect()
}

/// A lanelet of 10 m from `x` whose inside is `inside`.
pub(crate) fn short(id: usize, x: f64, inside: &str) -> String {
    let bound = |y: f64| {
        let point = |x: f64| format!("<point><x>{x}</x><y>{y}</y></point>");
        point(x) + &point(x + 10.0)
    };
    let (left, right) = (bound(3.0), bound(0.0));
    format!(
        "<lanelet id='{id}'><leftBound>{left}</leftBound><rightBound>{right}</rightBound>{inside}</lanelet>"
    )
}
