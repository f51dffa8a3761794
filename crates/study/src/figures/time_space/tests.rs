use super::*;
use proptest::prelude::*;

fn cruise(from_s: f64, duration_s: usize, speed_mps: f64) -> Vec<Sample> {
    let at = |t: f64| Sample { time_s: from_s + t, position_m: speed_mps * t, speed_mps };
    (0..=duration_s).map(|t| at(t as f64)).collect()
}

fn lane<'a>(name: &str, trajectories: &'a [Vec<Sample>], changes: &[Mark]) -> LaneInTime<'a> {
    let trajectories = trajectories.iter().map(Vec::as_slice).collect();
    LaneInTime { name: name.into(), trajectories, changes: changes.to_vec() }
}

/// The diagram of a single lane.
fn alone(title: &str, trajectories: &[Vec<Sample>], changes: &[Mark]) -> Drawn {
    time_space(Sheet::Page, title, &[lane("", trajectories, changes)])
}

#[test]
fn a_steady_drive_is_one_straight_line() {
    // From corner to corner: (84, 496) px to (804, 56) px.
    let svg = alone("", &[cruise(0.0, 100, 20.0)], &[]).svg;
    assert!(svg.contains("d=\"M840 4960l7200-4400\""), "{svg}");
}

#[test]
fn a_vehicle_that_slows_down_changes_its_colour_without_a_gap() {
    let sample = |(time_s, position_m, speed_mps)| Sample { time_s, position_m, speed_mps };
    let halt = [(0.0, 0.0, 30.0), (10.0, 300.0, 30.0), (11.0, 315.0, 0.0), (20.0, 315.0, 0.0)];
    let svg = alone("", &[halt.map(sample).to_vec()], &[]).svg;
    let lines: Vec<&str> = svg.lines().filter(|it| it.contains("scale(0.1)")).collect();
    assert_eq!(lines.len(), 3);
    assert!(lines[0].contains("M840 4960l3600-4190") && lines[0].contains("#7ad151"), "{}", lines[0]);
    assert!(lines[1].contains("M4440 770l360-210"), "{}", lines[1]);
    assert!(lines[2].contains("M4800 560l3240 0") && lines[2].contains("#440154"), "{}", lines[2]);
}

#[test]
fn every_axis_and_the_colour_bar_name_their_unit() {
    let svg = alone("lane 3", &[cruise(0.0, 100, 20.0)], &[]).svg;
    for text in ["lane 3", "Time [s]", "Position [km]", "Speed [km/h]"] {
        assert!(svg.contains(&format!(">{text}</text>")), "{text}");
    }
}

#[test]
fn changes_are_marked_inside_the_diagram_only() {
    let mark = |time_s| Mark { time_s, position_m: 1000.0 };
    let without = alone("", &[cruise(0.0, 100, 20.0)], &[mark(101.0)]).svg;
    let with = alone("", &[cruise(0.0, 100, 20.0)], &[mark(101.0), mark(50.0)]).svg;
    assert!(!without.contains("lane change"));
    assert!(with.contains("lane change") && with.contains("M4415 2735l50 50M4415 2785l50-50"), "{with}");
}

#[test]
fn three_thousand_vehicles_in_stop_and_go_waves_stay_below_three_megabytes() {
    let drive = |vehicle: usize| {
        let mut position_m = 0.0;
        let sample = |second: usize| {
            let time_s = (vehicle + second) as f64;
            let speed_mps = 15.0 + 14.0 * f64::sin(time_s / 40.0 + position_m / 300.0);
            position_m += speed_mps;
            Sample { time_s, position_m, speed_mps }
        };
        (0..300).map(sample).collect()
    };
    let trajectories: Vec<Vec<Sample>> = (0..3000).map(drive).collect();
    let bytes = alone("", &trajectories, &[]).svg.len();
    assert!((100_000..3_000_000).contains(&bytes), "{bytes}");
}

#[test]
fn nothing_to_draw_is_an_empty_diagram() {
    let nowhere = Sample { time_s: f64::NAN, position_m: 0.0, speed_mps: 0.0 };
    assert_eq!(alone("", &[vec![nowhere]], &[]).svg, alone("", &[Vec::new()], &[]).svg);
}

#[test]
fn lanes_share_the_axis_of_time_and_the_scale_of_speeds() {
    let (slow, fast) = ([cruise(0.0, 50, 5.0)], [cruise(50.0, 50, 20.0)]);
    let drawn = time_space(Sheet::Column, "", &[lane("lane 1", &slow, &[]), lane("lane 2", &fast, &[])]);
    let count = |text: &str| drawn.svg.matches(&format!(">{text}</text>")).count();
    assert_eq!(["Time [s]", "Speed [km/h]", "Position [km]", "lane 1", "lane 2"].map(count), [1, 1, 2, 1, 1]);
    // 0 … 80 km/h in eight classes: 18 km/h is the second, and 72 km/h the last one.
    assert!(
        drawn.svg.contains("class=\"line c1\"") && drawn.svg.contains("class=\"line c9\""),
        "{}",
        drawn.svg
    );
    // The first half of the time, from 62 to 231 px; the second half.
    assert!(drawn.svg.contains("d=\"M620 ") && drawn.svg.contains("d=\"M2310 "), "{}", drawn.svg);
}

#[test]
fn the_values_are_the_ends_of_the_lines_that_are_drawn() {
    let changes = [Mark { time_s: 50.0, position_m: 1000.0 }];
    let csv = alone("", &[cruise(0.0, 100, 20.0)], &changes).csv;
    let rows =
        ["lane,line,Time [s],Position [km],Speed [km/h]", ",0,0,0,72", ",0,100,2,72", ",lane change,50,1,"];
    assert_eq!(csv.lines().collect::<Vec<&str>>(), rows);
}

proptest! {
    #[test]
    fn a_thinned_line_stays_close_to_every_point(steps in prop::collection::vec((0.0..3.0, -2.0..2.0), 2..80)) {
        let advance = |at: &mut (f64, f64), step: &(f64, f64)| {
            *at = (at.0 + step.0, at.1 + step.1);
            Some(*at)
        };
        let line: Vec<(f64, f64)> = steps.iter().scan((0.0, 0.0), advance).collect();
        let kept: Vec<(f64, f64)> = thinned(&line).into_iter().map(|it| line[it]).collect();
        for point in &line {
            let is_close = |pair: &[(f64, f64)]| {
                let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
                let share = if x1 > x0 { (point.0 - x0) / (x1 - x0) } else { 0.0 };
                let between = y0 + share * (y1 - y0);
                (x0..=x1).contains(&point.0) && (point.1 - between).abs() <= TOLERANCE + 1e-9
            };
            prop_assert!(kept.windows(2).any(is_close), "{point:?} is far from {kept:?}");
        }
    }
}
