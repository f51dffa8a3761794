//! Time–space diagram: trajectories coloured by speed, lane changes marked.

use super::axes::Axis;
use super::drawing::{Anchor, Around, Drawing, Key, Plot, text_width};
use super::sheet::Sheet;
use crate::trace::{Mark, Sample};
use crate::units::{KMH_PER_MPS, METRES_PER_KM};

/// Coordinates within the plot are whole numbers of this fraction of a pixel: short text, fine enough for print.
const UNITS_PER_PX: f64 = 10.0;
/// Maximum distance of a drawn line from the samples, vertically [px].
const TOLERANCE: f64 = 0.3;
/// Half the size of the cross that marks a lane change [px].
const CROSS: f64 = 2.5;
/// The colour bar: space for it, from the plot to it, its width, and from the plot to its label [px].
const BARS: [Bar; 2] = [
    Bar { room: 112.0, gap: 24.0, width: 18.0, label: 98.0 },
    Bar { room: 66.0, gap: 10.0, width: 12.0, label: 63.0 },
];
/// The legend text of a cross.
const KEY: &str = "lane change";
/// Colours from standstill to the highest speed.
const RAMP: [[f64; 3]; 5] = [
    [140.0, 0.0, 26.0],
    [224.0, 74.0, 32.0],
    [224.0, 164.0, 22.0],
    [66.0, 152.0, 128.0],
    [36.0, 70.0, 150.0],
];

/// Position of a colour bar.
struct Bar {
    room: f64,
    gap: f64,
    width: f64,
    label: f64,
}

/// Draws `trajectories`, each the samples of one vehicle in order of time, coloured by speed [km/h], and a cross at
/// each of the `changes` that lies within their time and road. A vehicle that leaves the lane and comes back has two
/// trajectories. Samples that are not finite are left out.
pub fn time_space(
    sheet: Sheet,
    title: &str,
    trajectories: &[impl AsRef<[Sample]>],
    changes: &[Mark],
) -> String {
    let samples = || trajectories.iter().flat_map(AsRef::as_ref).filter(is_finite);
    let (from_s, to_s) = range(samples().map(|it| it.time_s));
    let (from_km, to_km) = range(samples().map(|it| it.position_m / METRES_PER_KM));
    let [across, upwards] = sheet.layout().steps;
    let x = Axis::spanning("Time [s]", from_s, to_s, across);
    let y = Axis::spanning("Position [km]", from_km, to_km, upwards);
    let fastest = samples().map(|it| it.speed_mps * KMH_PER_MPS).fold(0.0, f64::max);
    let speeds = Axis::from_zero("Speed [km/h]", fastest, 10.0);
    let is_inside = |it: &&Mark| {
        let within = |axis: &Axis, value: f64| (0.0..=1.0).contains(&axis.share(value));
        within(&x, it.time_s) && within(&y, it.position_m / METRES_PER_KM)
    };
    let changes: Vec<&Mark> = changes.iter().filter(is_inside).collect();

    let bar = &BARS[usize::from(sheet == Sheet::Column)];
    let has_key = sheet == Sheet::Column && !changes.is_empty();
    let keys =
        if has_key { vec![Key { mark: crosses_of(&cross(0.0, 0.0)), text: KEY.into() }] } else { vec![] };
    let mut drawing = Drawing::new(sheet, Around { title, keys, right: bar.room, ..Around::default() });
    let plot = drawing.plot;
    drawing.axes(&x, &y);
    // Fast vehicles first, so that a jam lies on top.
    for (class, path) in paths(trajectories, &plot, [&x, &y, &speeds]).iter().enumerate().rev() {
        if !path.is_empty() {
            drawing.add(&in_units(path, &colour(class, classes(&speeds)), 0.9, "speed"));
        }
    }
    let place = |it: &&Mark| cross(plot.across(&x, it.time_s), plot.down(&y, it.position_m / METRES_PER_KM));
    let crosses: String = changes.iter().map(place).collect();
    if !crosses.is_empty() {
        drawing.add(&crosses_of(&crosses));
        if sheet == Sheet::Page {
            drawing.add(&crosses_of(&cross(plot.right - text_width(KEY) - 8.0, plot.top - 12.0)));
            drawing.text(plot.right, plot.top - 12.0, Anchor::End, KEY);
        }
    }
    drawing.frame();
    colour_bar(&mut drawing, &speeds, bar);
    drawing.finish()
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| (low.min(it), high.max(it)))
}

/// Number of speed classes: one between any two ticks of the colour bar.
fn classes(speeds: &Axis) -> usize {
    (speeds.to / speeds.step()).round() as usize
}

/// Mixed from the two nearest colours of the scale.
fn colour(class: usize, classes: usize) -> String {
    let place = class as f64 / (classes.max(2) - 1) as f64 * (RAMP.len() - 1) as f64;
    let lower = (place as usize).min(RAMP.len() - 2);
    let share = place - lower as f64;
    let mixed = [0, 1, 2].map(|i| (RAMP[lower][i] + share * (RAMP[lower + 1][i] - RAMP[lower][i])).round());
    format!("#{:02x}{:02x}{:02x}", mixed[0] as u8, mixed[1] as u8, mixed[2] as u8)
}

fn is_finite(it: &&Sample) -> bool {
    it.time_s.is_finite() && it.position_m.is_finite() && it.speed_mps.is_finite()
}

/// One path for each class of speed, with all lines in it.
fn paths(trajectories: &[impl AsRef<[Sample]>], plot: &Plot, [x, y, speeds]: [&Axis; 3]) -> Vec<String> {
    let mut paths = vec![String::new(); classes(speeds)];
    let last = paths.len() - 1;
    for trajectory in trajectories.iter().map(AsRef::as_ref) {
        let samples: Vec<&Sample> = trajectory.iter().filter(is_finite).collect();
        let class = |pair: &[&Sample]| {
            let speed = 0.5 * (pair[0].speed_mps + pair[1].speed_mps) * KMH_PER_MPS;
            ((speed / speeds.step()) as usize).min(last)
        };
        let point = |it: &Sample| (plot.across(x, it.time_s), plot.down(y, it.position_m / METRES_PER_KM));
        let mut begin = 0;
        while begin + 1 < samples.len() {
            let here = class(&samples[begin..begin + 2]);
            let pairs = samples[begin..].windows(2).take_while(|pair| class(pair) == here).count();
            let run: Vec<(f64, f64)> = samples[begin..=begin + pairs].iter().map(|it| point(it)).collect();
            append(&mut paths[here], &thinned(&run));
            begin += pairs;
        }
    }
    paths
}

/// The fewest points of a line, found in one pass, that stay within the tolerance of all. From a kept point, a cone
/// narrows with each further point; the point before the first one outside is kept.
fn thinned(line: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = line.first().copied().into_iter().collect();
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    for pair in line.windows(2) {
        let mut anchor = kept[kept.len() - 1];
        let slope = |from: (f64, f64), to: (f64, f64)| (to.1 - from.1) / (to.0 - from.0);
        let fits = pair[1].0 > anchor.0 && (least..=most).contains(&slope(anchor, pair[1]));
        if !fits && pair[0] != anchor {
            anchor = pair[0];
            kept.push(anchor);
            (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        if pair[1].0 > anchor.0 {
            let width = TOLERANCE / (pair[1].0 - anchor.0);
            least = least.max(slope(anchor, pair[1]) - width);
            most = most.min(slope(anchor, pair[1]) + width);
        }
    }
    if line.len() > 1 {
        kept.push(line[line.len() - 1]);
    }
    kept
}

/// Appends a line to a path, in whole units from point to point.
fn append(path: &mut String, line: &[(f64, f64)]) {
    let mut here = (0, 0);
    for (index, point) in line.iter().enumerate() {
        let there = ((point.0 * UNITS_PER_PX).round() as i64, (point.1 * UNITS_PER_PX).round() as i64);
        let (right, down) = (there.0 - here.0, there.1 - here.1);
        path.push(if index == 0 { 'M' } else { 'l' });
        path.push_str(itoa::Buffer::new().format(right));
        // A minus sign separates as well as a space does.
        if down >= 0 {
            path.push(' ');
        }
        path.push_str(itoa::Buffer::new().format(down));
        here = there;
    }
}

/// The style of crosses.
fn crosses_of(path: &str) -> String {
    in_units(path, "black", 1.2, "mark")
}

/// A cross around (x, y) [px], in units.
fn cross(x: f64, y: f64) -> String {
    let mut path = String::new();
    append(&mut path, &[(x - CROSS, y - CROSS), (x + CROSS, y + CROSS)]);
    append(&mut path, &[(x - CROSS, y + CROSS), (x + CROSS, y - CROSS)]);
    path
}

/// A path of whole units, `width` [px] wide.
fn in_units(path: &str, colour: &str, width: f64, class: &str) -> String {
    format!(
        "<path transform=\"scale({})\" d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{:.0}\" \
         stroke-linejoin=\"round\" class=\"{class}\"/>",
        1.0 / UNITS_PER_PX,
        width * UNITS_PER_PX
    )
}

fn colour_bar(drawing: &mut Drawing, speeds: &Axis, bar: &Bar) {
    let Plot { top, right, bottom, .. } = drawing.plot;
    let classes = classes(speeds);
    let (left, width, height) = (right + bar.gap, bar.width, (bottom - top) / classes as f64);
    for class in 0..classes {
        let (y, fill) = (bottom - (class + 1) as f64 * height, colour(class, classes));
        drawing.add(&format!(
            "<rect x=\"{left}\" y=\"{y:.1}\" width=\"{width}\" height=\"{height:.1}\" fill=\"{fill}\" \
             class=\"speed\"/>"
        ));
    }
    for (speed, text) in speeds.ticks() {
        let at = drawing.plot.down(speeds, speed);
        drawing.text(left + width + 6.0, at, Anchor::Start, &text);
    }
    drawing.upright_text(right + bar.label, &speeds.label);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cruise(from_s: f64, duration_s: usize, speed_mps: f64) -> Vec<Sample> {
        let at = |t: f64| Sample { time_s: from_s + t, position_m: speed_mps * t, speed_mps };
        (0..=duration_s).map(|t| at(t as f64)).collect()
    }

    #[test]
    fn a_steady_drive_is_one_straight_line() {
        // From corner to corner: (84, 496) px to (804, 56) px.
        let svg = time_space(Sheet::Page, "", &[cruise(0.0, 100, 20.0)], &[]);
        assert!(svg.contains("d=\"M840 4960l7200-4400\""), "{svg}");
    }

    #[test]
    fn a_vehicle_that_slows_down_changes_its_colour_without_a_gap() {
        let sample = |(time_s, position_m, speed_mps)| Sample { time_s, position_m, speed_mps };
        let halt = [(0.0, 0.0, 30.0), (10.0, 300.0, 30.0), (11.0, 315.0, 0.0), (20.0, 315.0, 0.0)];
        let svg = time_space(Sheet::Page, "", &[halt.map(sample).to_vec()], &[]);
        let lines: Vec<&str> = svg.lines().filter(|it| it.contains("scale(0.1)")).collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[0].contains("M840 4960l3600-4190") && lines[0].contains("#244696"), "{}", lines[0]);
        assert!(lines[1].contains("M4440 770l360-210"), "{}", lines[1]);
        assert!(lines[2].contains("M4800 560l3240 0") && lines[2].contains("#8c001a"), "{}", lines[2]);
    }

    #[test]
    fn every_axis_and_the_colour_bar_name_their_unit() {
        let svg = time_space(Sheet::Page, "lane 3", &[cruise(0.0, 100, 20.0)], &[]);
        for text in ["lane 3", "Time [s]", "Position [km]", "Speed [km/h]"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
    }

    #[test]
    fn changes_are_marked_inside_the_diagram_only() {
        let mark = |time_s| Mark { time_s, position_m: 1000.0 };
        let without = time_space(Sheet::Page, "", &[cruise(0.0, 100, 20.0)], &[mark(101.0)]);
        let with = time_space(Sheet::Page, "", &[cruise(0.0, 100, 20.0)], &[mark(101.0), mark(50.0)]);
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
        let bytes = time_space(Sheet::Page, "", &trajectories, &[]).len();
        assert!((100_000..3_000_000).contains(&bytes), "{bytes}");
    }

    #[test]
    fn nothing_to_draw_is_an_empty_diagram() {
        let nowhere = Sample { time_s: f64::NAN, position_m: 0.0, speed_mps: 0.0 };
        assert_eq!(
            time_space(Sheet::Page, "", &[vec![nowhere]], &[]),
            time_space(Sheet::Page, "", &[Vec::new()], &[])
        );
    }

    proptest! {
        #[test]
        fn a_thinned_line_stays_close_to_every_point(steps in prop::collection::vec((0.0..3.0, -2.0..2.0), 2..80)) {
            let advance = |at: &mut (f64, f64), step: &(f64, f64)| {
                *at = (at.0 + step.0, at.1 + step.1);
                Some(*at)
            };
            let line: Vec<(f64, f64)> = steps.iter().scan((0.0, 0.0), advance).collect();
            let kept = thinned(&line);
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
}
