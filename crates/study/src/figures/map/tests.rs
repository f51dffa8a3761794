use super::*;

/// A lanelet from `x` on that is `length` long and 4 m wide [m].
fn lanelet(name: &str, x: f64, length: f64) -> Area {
    let outline = vec![[x, 4.0], [x + length, 4.0], [x + length, 0.0], [x, 0.0]];
    Area { name: name.into(), outline }
}

fn three() -> Vec<Area> {
    vec![lanelet("1", 0.0, 100.0), lanelet("2", 100.0, 100.0), lanelet("3", 200.0, 26.0)]
}

fn speeds(on_top: OnTop) -> Shading {
    let values = vec![Some(50.0), None, Some(10.0)];
    Shading::of(&three(), ["Mean speed", "km/h", "no vehicle"], on_top, values)
}

fn marks(number: usize) -> Marks {
    let mark = MarkAt { area: "1".into(), at: [113.0, 2.0], value: 12.5, weight: 1.0 };
    Marks {
        kind: "route-driven".into(),
        key: format!("route-driven ({number})"),
        quantity: "time [s]".into(),
        series: 1,
        largest: 1.0,
        marks: vec![mark; number],
    }
}

#[test]
fn a_lanelet_has_the_colour_of_its_value_and_says_it() {
    let svg = map(&three(), Some(&speeds(OnTop::Lowest)), &[]).svg;
    // 0 … 50 km/h in ten classes; 452 px for 226 m, and 70 px for 4 m, from (14, 74) px on.
    let fast = "<g transform=\"scale(0.1)\" fill=\"#7ad151\" stroke=\"#7ad151\" stroke-width=\"4\" class=\"lane c9\">\
                <path d=\"M140 740l2000 0l0 700l-2000 0z\"><title>lanelet 1: 50 km/h</title></path></g>";
    assert!(svg.contains(fast), "{svg}");
    assert!(svg.contains(
        "class=\"road\"><path d=\"M2140 740l2000 0l0 700l-2000 0z\"><title>lanelet 2: no vehicle</title>"
    ));
    assert!(svg.contains(">Mean speed [km/h]</text>") && svg.contains(">no vehicle</text>"));
}

#[test]
fn the_legend_of_many_classes_has_fewer_numbers() {
    let svg = map(&three(), Some(&speeds(OnTop::Lowest)), &[]).svg;
    let shown = |text: &str| svg.contains(&format!(">{text}</text>"));
    assert_eq!(svg.matches("class=\"area").count(), 10);
    assert_eq!(["0", "5", "10", "40", "45", "50"].map(shown), [true, false, true, true, false, true]);
}

#[test]
fn what_matters_lies_on_top() {
    let order = |on_top: OnTop| {
        let svg = map(&three(), Some(&speeds(on_top)), &[]).svg;
        ["lanelet 1:", "lanelet 2:", "lanelet 3:"].map(|it| svg.find(it).unwrap())
    };
    let [fast, none, slow] = order(OnTop::Lowest);
    assert!(none < fast && fast < slow);
    let [fast, none, slow] = order(OnTop::Highest);
    assert!(none < slow && slow < fast);
}

#[test]
fn what_matters_has_the_colour_that_stands_out() {
    let colour = |on_top: OnTop, lanelet: &str| {
        let svg = map(&three(), Some(&speeds(on_top)), &[]).svg;
        let group = svg.split("<g ").find(|it| it.contains(lanelet)).unwrap().to_owned();
        group.split("class=\"lane ").nth(1).unwrap()[..2].to_owned()
    };
    assert_eq!([OnTop::Lowest, OnTop::Highest].map(|it| colour(it, "lanelet 1:")), ["c9", "c0"]);
    assert_eq!([OnTop::Lowest, OnTop::Highest].map(|it| colour(it, "lanelet 3:")), ["c2", "c7"]);
}

#[test]
fn the_data_of_a_map_are_the_values_that_it_shows() {
    let csv = map(&three(), Some(&speeds(OnTop::Lowest)), &[marks(1)]).csv;
    let rows = [
        "what,lanelet,x_m,y_m,quantity,value",
        "lanelet,1,,,Mean speed [km/h],50",
        "lanelet,2,,,Mean speed [km/h],",
        "lanelet,3,,,Mean speed [km/h],10",
        "route-driven,1,113.0,2.0,time [s],12.5",
    ];
    assert_eq!(csv.lines().collect::<Vec<&str>>(), rows);
}

#[test]
fn a_short_lanelet_with_an_extreme_value_does_not_take_the_scale() {
    let areas = vec![lanelet("1", 0.0, 100.0), lanelet("2", 100.0, 1.0)];
    let values = vec![Some(20.0), Some(500.0)];
    let shading = Shading::of(&areas, ["Density", "veh/km", "empty"], OnTop::Highest, values);
    let svg = map(&areas, Some(&shading), &[]).svg;
    assert!(svg.contains(">20+</text>") && svg.contains("lanelet 2: 500 veh/km"), "{svg}");
}

#[test]
fn marks_lie_at_their_places_in_the_shape_and_the_colour_of_their_kind() {
    let svg = map(&three(), None, &[marks(1)]).svg;
    // Half way across: (240, 70) px.
    let mark = "class=\"series s1\"><path d=\"M237.6 67.6h4.8v4.8h-4.8z\" class=\"dot\"><title>route-driven, lanelet 1: \
                time [s] 12.5</title></path></g>";
    assert!(svg.contains(mark) && svg.contains(">route-driven (1)</text>"), "{svg}");
    // The legend's mark, and one for all: none lies on another one.
    let many = map(&three(), None, &[marks(101)]).svg;
    assert_eq!((many.matches("h8v8h-8z").count(), many.matches("<title>").count()), (2, 1), "{many}");
    assert!(many.contains("<title>route-driven: 101</title>"), "{many}");
}

#[test]
fn a_map_without_lanelets_and_one_without_values_can_be_drawn() {
    assert!(map(&[], None, &[]).svg.ends_with("</svg>\n"));
    let shading = Shading::of(&three(), ["Density", "veh/km", "empty"], OnTop::Highest, vec![None; 3]);
    let svg = map(&three(), Some(&shading), &[]).svg;
    assert!(svg.contains(">empty</text>") && !svg.contains("class=\"area"), "{svg}");
}
