//! Time and memory grow with a file, not with the square of its size.
//!
//! Nothing here looks at a clock: the files are so large that work which grew with the square would take minutes to
//! hours, and gigabytes.

use laneweave_maps::{Map, MapError, ReadOptions, commonroad, lanelet2};

/// A lane 10 m long between the ways 11 and 12, and more.
fn lane_and(more: &str) -> String {
    format!(
        "<osm><node id='1' x='0' y='0'/><node id='2' x='10' y='0'/>\
         <node id='3' x='0' y='4'/><node id='4' x='10' y='4'/>\
         <way id='11'><nd ref='1'/><nd ref='2'/></way><way id='12'><nd ref='3'/><nd ref='4'/></way>{}{more}</osm>",
        lanelet(21, 12, 11, "")
    )
}

fn lanelet(id: usize, left: i64, right: i64, more: &str) -> String {
    format!(
        "<relation id='{id}'><member type='way' ref='{left}' role='left'/>\
         <member type='way' ref='{right}' role='right'/>{more}<tag k='type' v='lanelet'/></relation>\n"
    )
}

fn read(text: &str) -> Result<Map, MapError> {
    lanelet2::read(text.as_bytes(), &ReadOptions::default())
}

#[test]
fn a_line_is_drawn_for_no_more_than_32_rules() {
    let refers = "<member type='way' ref='11' role='refers'/>";
    let rule = |id: usize, times: usize| {
        format!(
            "<relation id='{id}'>{}<tag k='type' v='regulatory_element'/><tag k='subtype' v='speed_limit'/>\
             </relation>",
            refers.repeat(times)
        )
    };
    let map = read(&lane_and(&(rule(31, 30) + &rule(32, 12)))).unwrap();
    assert_eq!(map.rules.iter().map(|it| it.signs.len()).collect::<Vec<_>>(), [30, 2]);
    let problems: Vec<String> = map.problems.iter().map(ToString::to_string).collect();
    assert_eq!(
        problems,
        [
            "regulatory element 32 (line 2): 10 of its refers are ways that 32 others already use, so they are ignored; use each \
          way once",
            "regulatory element 31 (line 2): regulatory elements of the subtype speed_limit, 2 in all: no lanelet refers to it, so it \
             has no effect; add it as regulatory_element to the lanelets of that limit"
        ]
    );
}

#[test]
fn a_border_is_drawn_for_no_more_than_32_crosswalks() {
    let crosswalks: String =
        (100..140).map(|id| lanelet(id, 12, 11, "<tag k='subtype' v='crosswalk'/>")).collect();
    let map = read(&lane_and(&crosswalks)).unwrap();
    assert_eq!((map.contents.crosswalks.len(), map.contents.counts["lanelet crosswalk"]), (32, 40));
    assert_eq!(map.problems.len(), 9);
    assert_eq!(
        map.problems[1].to_string(),
        "lanelet 132 (line 34): 32 others share a border of this crosswalk, so it is not drawn; \
         delete lanelets that were drawn twice"
    );
}

#[test]
fn a_long_border_that_thousands_share_is_read_once() {
    let nodes: String = (0..30_000).map(|id| format!("<node id='{}' x='{id}' y='9'/>", 100 + id)).collect();
    for last in ["", "<nd ref='-7'/>"] {
        let border: String = (0..30_000).map(|id| format!("<nd ref='{}'/>", 100 + id)).collect();
        let lanelets: String = (100..30_100).map(|id| lanelet(id, 13, 11, "")).collect();
        let text = lane_and(&format!("{nodes}<way id='13'>{border}{last}</way>{lanelets}"));
        let map = read(&text).unwrap();
        assert_eq!((map.network.lanelets.len(), map.problems.len()), (1, 30_000));
    }
}

#[test]
fn a_long_speed_limit_rule_that_a_lanelet_names_thousands_of_times_is_read_once() {
    let rule = format!(
        "<relation id='31'>{}<tag k='subtype' v='speed_limit'/></relation>",
        "<member type='way' ref='11' role='refers'/>".repeat(60_000)
    );
    let named = "<member type='relation' ref='31' role='regulatory_element'/>".repeat(60_000);
    let map = read(&lane_and(&(rule + &lanelet(22, 11, 12, &named)))).unwrap();
    assert_eq!(map.network.lanelets[1].speed_limit, 50.0 / 3.6);
}

#[test]
fn thousands_of_lanelets_read_the_thousands_of_tags_of_their_scenario_once() {
    let line = |name: &str, y: usize| {
        let point = |x: usize| format!("<point><x>{x}</x><y>{y}</y></point>");
        format!("<{name}>{}{}</{name}>", point(0), point(9))
    };
    let lanelet = |id: usize| {
        format!(
            "<lanelet id='{id}'>{}{}</lanelet>",
            line("leftBound", 5 * id + 4),
            line("rightBound", 5 * id)
        )
    };
    let lanelets: String = (0..20_000).map(lanelet).collect();
    let text = format!("<commonRoad tags='{}'>{lanelets}</commonRoad>", "odd ".repeat(500_000));
    let map = commonroad::read(text.as_bytes(), &ReadOptions::default()).unwrap();
    assert!(map.network.lanelets.iter().all(|it| it.speed_limit == 50.0 / 3.6));
}
