//! Road networks of SUMO: a small one by hand, and real ones against their own text.

use std::collections::BTreeMap;
use std::fs;

use laneweave_maps::xml::{Element, Visitor, XmlError, walk};
use laneweave_maps::{Map, ReadOptions, RuleKind, load, regulations, sumo};
use laneweave_network::{Class, DrivingSide, Lanelet, LaneletIndex};
use laneweave_test_data::data;

/// A main road of two lanes, of which the left one is for buses, and a minor road that joins it: its movement waits
/// within the junction.
const SMALL: &str = r#"<net version="1.20" lefthand="false">
    <edge id=":J_0" function="internal"><lane id=":J_0_0" index="0" speed="10" length="10" shape="100,0 110,0"/></edge>
    <edge id=":J_1" function="internal"><lane id=":J_1_0" index="0" speed="20" length="10" shape="100,3.2 110,3.2"/></edge>
    <edge id=":J_2" function="internal"><lane id=":J_2_0" index="0" speed="5" length="5" shape="105,-20 105,-15"/></edge>
    <edge id=":J_3" function="internal"><lane id=":J_3_0" index="0" speed="5" length="16" shape="105,-15 106,-5 110,0"/></edge>
    <edge id=":J_w0" function="walkingarea"><lane id=":J_w0_0" index="0" speed="1" length="5" allow="pedestrian" shape="0,9 5,9"/></edge>
    <edge id="main" from="A" to="J" priority="2" type="highway.primary">
        <lane id="main_0" index="0" disallow="tram pedestrian" speed="13.89" length="100" shape="0,0 100,0"/>
        <lane id="main_1" index="1" allow="bus taxi" speed="13.89" length="100" shape="0,3.2 100,3.2" changeRight="bus"/>
        <lane id="main_2" index="2" allow="rail" speed="13.89" length="100" shape="0,6.4 100,6.4"/>
    </edge>
    <edge id="minor" from="B" to="J" priority="1">
        <lane id="minor_0" index="0" speed="27.78" length="80" width="4" shape="105,-100 105,-20"/>
    </edge>
    <edge id="out" from="J" to="C" priority="2" type="highway.motorway">
        <lane id="out_0" index="0" speed="13.89" length="90" shape="110,0 200,0"/>
        <lane id="out_1" index="1" speed="13.89" length="90" shape="110,3.2 200,3.2"/>
    </edge>
    <junction id="J" type="priority" x="105" y="0" incLanes="main_0 main_1 minor_0" intLanes=":J_0_0 :J_1_0 :J_3_0" shape="">
        <request index="0" response="000" foes="100" cont="0"/>
        <request index="1" response="000" foes="000" cont="0"/>
        <request index="2" response="001" foes="001" cont="1"/>
    </junction>
    <connection from="main" to="out" fromLane="0" toLane="0" via=":J_0_0" dir="s" state="M"/>
    <connection from="main" to="out" fromLane="1" toLane="1" via=":J_1_0" dir="s" state="M"/>
    <connection from="minor" to="out" fromLane="0" toLane="0" via=":J_2_0" dir="r" state="m"/>
    <connection from=":J_0" to="out" fromLane="0" toLane="0" dir="s" state="M"/>
    <connection from=":J_1" to="out" fromLane="0" toLane="1" dir="s" state="M"/>
    <connection from=":J_2" to="out" fromLane="0" toLane="0" via=":J_3_0" dir="r" state="m"/>
    <connection from=":J_3" to="out" fromLane="0" toLane="0" dir="r" state="M"/>
</net>"#;

fn read(text: &str) -> Map {
    sumo::read(text.as_bytes(), &ReadOptions::default()).expect("some lanes can be used")
}

fn problems(map: &Map) -> Vec<String> {
    map.problems.iter().map(ToString::to_string).collect()
}

/// Lanelets of the small net, in the order of lanes and then of connections.
const MAIN: usize = 0;
const BUS: usize = 1;
const MINOR: usize = 2;
const OUT: usize = 3;
const OUT_LEFT: usize = 4;
const ON: usize = 5;
const BUS_ON: usize = 6;
const JOIN: usize = 7;

fn at(place: usize) -> Option<LaneletIndex> {
    Some(LaneletIndex(place as u32))
}

#[test]
fn lanes_and_connections_become_lanelets() {
    let map = read(SMALL);
    let lanelets = &map.network.lanelets;
    assert_eq!(lanelets.len(), 8);
    let leads = |from: usize| lanelets[from].following.iter().map(|it| it.at()).collect::<Vec<_>>();
    assert_eq!([MAIN, BUS, MINOR].map(leads), [vec![ON], vec![BUS_ON], vec![JOIN]]);
    assert_eq!([ON, BUS_ON, JOIN].map(leads), [vec![OUT], vec![OUT_LEFT], vec![OUT]]);
    let beside = |it: usize| {
        let Lanelet { left, right, adjacent_left, adjacent_right, .. } = &lanelets[it];
        [*left, *right, *adjacent_left, *adjacent_right]
    };
    assert_eq!(beside(MAIN), [at(BUS), None, None, None]);
    assert_eq!(beside(BUS), [None, at(MAIN), None, None]);
    assert_eq!(beside(OUT_LEFT), [None, at(OUT), None, None]);
    assert_eq!(lanelets[BUS].classes.names(), "bus, taxi, emergency");
    assert_eq!(lanelets[BUS_ON].classes, lanelets[BUS].classes);
    assert!(lanelets[MAIN].classes.has(Class::Car) && lanelets[JOIN].classes.has(Class::Truck));
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    assert!(near(lanelets[MAIN].width(50.0), 3.2) && near(lanelets[MINOR].width(50.0), 4.0));
    assert!(near(lanelets[JOIN].width(0.0), 4.0) && near(lanelets[ON].speed_limit, 10.0));
    assert!(lanelets[MAIN].is_in_town && !lanelets[MINOR].is_in_town && !lanelets[OUT].is_in_town);
    // The way of two internal lanes is one.
    assert!(lanelets[JOIN].length() > 20.0 && near(lanelets[JOIN].speed_limit, 5.0));
    assert_eq!(
        problems(&map),
        [
            "edge :J_w0 (line 6): crossings and areas for pedestrians, 1 in all: nobody walks here; leave it so",
            "lane main_2 (line 10): lanes for rail, 1 in all: none of our classes of vehicles may use them, so they are left out; leave it so",
        ]
    );
}

#[test]
fn requests_say_who_gives_way_and_where() {
    let map = read(SMALL);
    let id = |it: usize| map.network.lanelets[it].id;
    let [rule] = &map.rules[..] else { panic!("{:?}", map.rules) };
    assert_eq!(rule.kind, RuleKind::RightOfWay { first: vec![id(ON)], yielding: vec![id(JOIN)] });
    // Its drivers wait where the first internal lane ends.
    assert!(rule.stop_lines[0].iter().all(|it| (it.y + 15.0).abs() < 0.2), "{rule:?}");
    let regulations = regulations(&map);
    assert_eq!(regulations.priorities.len(), 1);
    let stops = SMALL.replace(
        "dir=\"r\" state=\"m\"/>\n    <connection from=\":J_0\"",
        "dir=\"r\" state=\"s\"/>\n    <connection from=\":J_0\"",
    );
    let with_stop = read(&stops);
    assert!(with_stop.rules.iter().any(|it| it.kind == RuleKind::StopSign && it.lanelets == [id(JOIN)]));
}

#[test]
fn traffic_drives_on_the_side_that_the_net_says() {
    assert_eq!(read(SMALL).network.driving_side, DrivingSide::Right);
    let left = read(&SMALL.replace("lefthand=\"false\"", "lefthand=\"true\""));
    assert_eq!(left.network.driving_side, DrivingSide::Left);
}

#[test]
fn what_is_broken_is_named_and_left_out() {
    for (from, to, expected) in [
        (
            "shape=\"0,0 100,0\"",
            "shape=\"0,0 100,O\"",
            "lane main_0 (line 8): its shape is not two points or more",
        ),
        ("speed=\"27.78\"", "speed=\"0\"", "lane minor_0 (line 13): its speed is not above 0"),
        ("width=\"4\"", "width=\"x\"", "lane minor_0 (line 13): its width is not between"),
        (
            "fromLane=\"1\" toLane=\"1\"",
            "fromLane=\"1\" toLane=\"7\"",
            "connection main_1 to out_7 (line 25): the edge out has no lane 7",
        ),
        ("from=\"minor\"", "from=\"miner\"", "connection miner_0 to out_0 (line 26): there is no edge miner"),
        (
            "index=\"2\" response",
            "index=\"two\" response",
            "<request> (line 22): its index is no whole number",
        ),
        (
            "fromLane=\"0\" toLane=\"0\" via=\":J_0_0\"",
            "fromLane=\"-\" toLane=\"0\"",
            "<connection> (line 24): its lanes are not numbers",
        ),
    ] {
        assert!(SMALL.contains(from), "{from}");
        let told = problems(&read(&SMALL.replacen(from, to, 1)));
        assert!(told.iter().any(|it| it.starts_with(expected)), "{expected}: {told:?}");
    }
    let empty = sumo::read(b"<net version='1.20'></net>", &ReadOptions::default()).unwrap_err();
    assert!(empty.to_string().contains("passenger"), "{empty}");
}

#[test]
fn a_net_without_internal_lanes_has_the_same_ways() {
    let bare: String = SMALL
        .lines()
        .filter(|it| !it.contains("function=\"internal\"") && !it.contains("from=\":"))
        .map(|it| {
            it.replace(" via=\":J_0_0\"", "").replace(" via=\":J_1_0\"", "").replace(" via=\":J_2_0\"", "")
                + "\n"
        })
        .collect();
    let map = read(&bare);
    assert_eq!(map.network.lanelets.len(), 8);
    assert!(map.network.lanelets[JOIN].length() > 15.0);
}

/// The lanes of a net's roads with what lets cars in, and its connections between such lanes.
#[derive(Default)]
struct Text {
    is_road: bool,
    edge: String,
    lanes: BTreeMap<(String, usize), bool>,
    connections: Vec<[(String, usize); 2]>,
}

impl Visitor for Text {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        let [id, function, index, allow] = element.values(["id", "function", "index", "allow"])?;
        let [disallow, from, to] = element.values(["disallow", "from", "to"])?;
        let [from_lane, to_lane] = element.values(["fromLane", "toLane"])?;
        let number = |it: Option<std::borrow::Cow<'_, str>>| it.and_then(|it| it.parse::<usize>().ok());
        match path {
            "edge" => {
                self.is_road = function.is_none();
                self.edge = id.unwrap_or_default().into_owned();
            }
            "edge/lane" if self.is_road => {
                let has = |list: &Option<std::borrow::Cow<'_, str>>| {
                    list.as_ref().map(|it| it.split(' ').any(|it| it == "passenger" || it == "all"))
                };
                let is_for_cars = has(&allow).unwrap_or_else(|| !has(&disallow).unwrap_or(false));
                self.lanes.insert((self.edge.clone(), number(index).expect("an index")), is_for_cars);
            }
            "connection" => {
                let end = |edge: Option<std::borrow::Cow<'_, str>>, lane| {
                    (edge.expect("an edge").into_owned(), number(lane).expect("a lane"))
                };
                self.connections.push([end(from, from_lane), end(to, to_lane)]);
            }
            _ => {}
        }
        Ok(())
    }

    fn close(&mut self, _: &str, _: &str) {}
}

#[test]
fn every_connection_of_real_nets_that_a_car_may_use_is_kept() {
    for file in ["sumo/bologna/joined_buslanes.net.xml", "sumo/badhersfeld/net.net.xml.gz"] {
        let Some(path) = data(file) else { continue };
        let mut bytes = fs::read(&path).expect("it is there");
        if file.ends_with(".gz") {
            let mut unpacked = Vec::new();
            std::io::Read::read_to_end(&mut flate2::read::MultiGzDecoder::new(&bytes[..]), &mut unpacked)
                .expect("it is whole");
            bytes = unpacked;
        }
        let mut text = Text::default();
        walk(&bytes, "net", &mut text).expect("it is XML");
        let usable = |it: &&[(String, usize); 2]| it.iter().all(|end| text.lanes.get(end) == Some(&true));
        let expected = text.connections.iter().filter(usable).count();
        let map = load(&path, &ReadOptions::default()).expect("it is a map");
        let lanelets = &map.network.lanelets;
        let for_cars = |it: &Lanelet| it.classes.has(Class::Car);
        let lanes = text.lanes.values().filter(|it| **it).count();
        // Lanelets are lanes and movements; where lanes touch there is no movement between them.
        let kept: usize = lanelets
            .iter()
            .filter(|it| for_cars(it))
            .map(|it| it.following.iter().filter(|next| for_cars(&lanelets[next.at()])).count())
            .sum();
        let movements = lanelets.iter().filter(|it| for_cars(it)).count() - lanes;
        assert_eq!(kept - movements, expected, "{file}");
        assert!(expected > 400, "{file}: {expected}");
    }
}
