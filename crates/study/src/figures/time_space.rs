//! Time–space diagrams: trajectories coloured by speed, lane changes marked.

use super::axes::Axis;
use super::colours::{MOST_CLASSES, class_of, classes, colour};
use super::drawing::{Anchor, Around, Drawing, Key, Plot, text_width};
use super::drawn::{Drawn, Values, text, value};
use super::lines::{UNITS_PER_PX, append, in_px};
use super::sheet::Sheet;
use crate::trace::{Mark, Sample};
use crate::units::{KMH_PER_MPS, METRES_PER_KM};

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
/// Space for the name of a lane above its panel [px], and the height of a panel where there are several, as a share of
/// that of a single one.
const NAME: f64 = 26.0;
const SEVERAL: f64 = 0.75;

/// A lane of a diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct LaneInTime<'a> {
    /// Its name, which is shown where there are several.
    pub name: String,
    /// Its trajectories, each the samples of one vehicle in order of time. A vehicle that leaves the lane and comes
    /// back has two.
    pub trajectories: Vec<&'a [Sample]>,
    /// Lane changes onto it and off it.
    pub changes: Vec<Mark>,
}

/// Position of a colour bar.
struct Bar {
    room: f64,
    gap: f64,
    width: f64,
    label: f64,
}

/// Draws each lane in a panel, one below the other, with one axis of time and one scale of colours for the speed
/// [km/h]; and a cross at each lane change that lies within the time and the lane of its panel. Samples that are not
/// finite are left out.
pub fn time_space(sheet: Sheet, title: &str, lanes: &[LaneInTime]) -> Drawn {
    let samples = || lanes.iter().flat_map(samples);
    let layout = sheet.layout();
    let [across, upwards] = layout.steps;
    let (from_s, to_s) = range(samples().map(|it| it.time_s));
    let x = Axis::spanning("Time [s]", from_s, to_s, across);
    let fastest = samples().map(|it| it.speed_mps * KMH_PER_MPS).fold(0.0, f64::max);
    let speeds = Axis::from_zero("Speed [km/h]", fastest, MOST_CLASSES);
    let name = if lanes.len() > 1 { NAME } else { 0.0 };
    let height = layout.plot[1] * if lanes.len() > 1 { SEVERAL } else { 1.0 };
    let steps = if lanes.len() > 1 { upwards * SEVERAL } else { upwards };
    let panels: Vec<Panel> = lanes.iter().map(|it| Panel::of(it, x.clone(), steps)).collect();

    let bar = &BARS[usize::from(sheet == Sheet::Column)];
    let has_changes = panels.iter().any(|it| !it.changes.is_empty());
    let has_key = sheet == Sheet::Column && has_changes;
    let keys =
        if has_key { vec![Key { mark: crosses_of(&cross(0.0, 0.0)), text: KEY.into() }] } else { vec![] };
    let whole = (name + height) * lanes.len().max(1) as f64;
    let around = Around { title, keys, right: bar.room, height: Some(whole), ..Around::default() };
    let mut drawing = Drawing::new(sheet, around);
    let whole = drawing.plot;
    if has_changes && sheet == Sheet::Page {
        drawing.add(&crosses_of(&cross(whole.right - text_width(KEY) - 8.0, whole.top - 12.0)));
        drawing.text(whole.right, whole.top - 12.0, Anchor::End, KEY);
    }
    let mut values = Values::of(["lane", "line", &x.label, "Position [km]", &speeds.label]);
    for (number, panel) in panels.iter().enumerate() {
        let top = whole.top + name + (name + height) * number as f64;
        drawing.plot = Plot { top, bottom: top + height, ..whole };
        if name > 0.0 {
            drawing.text(whole.left, top - 0.5 * NAME, Anchor::Start, &panel.lane.name);
        }
        drawing.grid(Some(&x), Some(&panel.y));
        drawing.texts_upwards(&panel.y);
        panel.draw(&mut drawing, &speeds, &mut values);
    }
    drawing.texts_across(&x);
    drawing.plot = Plot { top: whole.top + name, ..whole };
    colour_bar(&mut drawing, &speeds, bar);
    drawing.finish(values)
}

/// The samples of a lane that are finite.
fn samples<'a>(lane: &'a LaneInTime<'a>) -> impl Iterator<Item = &'a Sample> {
    lane.trajectories.iter().flat_map(|it| it.iter()).filter(is_finite)
}

/// The panel of a lane.
struct Panel<'a> {
    lane: &'a LaneInTime<'a>,
    x: Axis,
    y: Axis,
    /// The lane changes within it.
    changes: Vec<&'a Mark>,
}

impl<'a> Panel<'a> {
    fn of(lane: &'a LaneInTime<'a>, x: Axis, steps: f64) -> Panel<'a> {
        let (from_km, to_km) = range(samples(lane).map(|it| it.position_m / METRES_PER_KM));
        let y = Axis::spanning("Position [km]", from_km, to_km, steps);
        let within = |axis: &Axis, value: f64| (0.0..=1.0).contains(&axis.share(value));
        let is_inside = |it: &&Mark| within(&x, it.time_s) && within(&y, it.position_m / METRES_PER_KM);
        let changes = lane.changes.iter().filter(is_inside).collect();
        Panel { lane, x, y, changes }
    }

    fn draw(&self, drawing: &mut Drawing, speeds: &Axis, values: &mut Values) {
        let Panel { lane, x, y, changes } = self;
        // Fast vehicles first, so that a jam lies on top.
        for (class, path) in self.paths(&drawing.plot, speeds, values).iter().enumerate().rev() {
            if !path.is_empty() {
                let (colour, class) = colour(class, classes(speeds));
                drawing.add(&line(path, colour, 0.9, &format!("line {class}")));
            }
        }
        let plot = drawing.plot;
        let crosses: String = changes
            .iter()
            .map(|it| cross(plot.across(x, it.time_s), plot.down(y, it.position_m / METRES_PER_KM)))
            .collect();
        if !crosses.is_empty() {
            drawing.add(&crosses_of(&crosses));
        }
        for it in changes {
            let cells = [value(it.time_s), kilometres(it.position_m), String::new()];
            values.row([text(&lane.name), text(KEY)].into_iter().chain(cells));
        }
        drawing.frame();
    }

    /// One path for each class of speed, with all lines in it; a row of values for each of their points.
    fn paths(&self, plot: &Plot, speeds: &Axis, values: &mut Values) -> Vec<String> {
        let mut paths = vec![String::new(); classes(speeds)];
        let name = text(&self.lane.name);
        for (number, trajectory) in self.lane.trajectories.iter().enumerate() {
            let samples: Vec<&Sample> = trajectory.iter().filter(is_finite).collect();
            let class = |pair: &[&Sample]| {
                class_of(speeds, 0.5 * (pair[0].speed_mps + pair[1].speed_mps) * KMH_PER_MPS)
            };
            let point = |it: &Sample| {
                (plot.across(&self.x, it.time_s), plot.down(&self.y, it.position_m / METRES_PER_KM))
            };
            let mut begin = 0;
            while begin + 1 < samples.len() {
                let here = class(&samples[begin..begin + 2]);
                let pairs = samples[begin..].windows(2).take_while(|pair| class(pair) == here).count();
                let run = &samples[begin..=begin + pairs];
                let places: Vec<(f64, f64)> = run.iter().map(|it| point(it)).collect();
                let kept = thinned(&places);
                append(&mut paths[here], &kept.iter().map(|it| places[*it]).collect::<Vec<_>>());
                // The first point of a run is the last one of the run before.
                for it in kept.iter().filter(|it| **it > 0 || begin == 0).map(|it| run[*it]) {
                    let cells = [value(it.time_s), kilometres(it.position_m), speed(it.speed_mps)];
                    values.row([name.clone(), number.to_string()].into_iter().chain(cells));
                }
                begin += pairs;
            }
        }
        paths
    }
}

/// A position as a cell [km], to the metre.
fn kilometres(position_m: f64) -> String {
    value(position_m.round() / METRES_PER_KM)
}

/// A speed as a cell [km/h], to a tenth.
fn speed(speed_mps: f64) -> String {
    value((speed_mps * KMH_PER_MPS * 10.0).round() / 10.0)
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| (low.min(it), high.max(it)))
}

fn is_finite(it: &&Sample) -> bool {
    it.time_s.is_finite() && it.position_m.is_finite() && it.speed_mps.is_finite()
}

/// The fewest points of a line, found in one pass, that stay within the tolerance of all; their numbers. From a kept
/// point, a cone narrows with each further point; the point before the first one outside is kept.
fn thinned(line: &[(f64, f64)]) -> Vec<usize> {
    let mut kept: Vec<usize> = if line.is_empty() { vec![] } else { vec![0] };
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    for (number, pair) in line.windows(2).enumerate() {
        let mut anchor = line[kept[kept.len() - 1]];
        let slope = |from: (f64, f64), to: (f64, f64)| (to.1 - from.1) / (to.0 - from.0);
        let fits = pair[1].0 > anchor.0 && (least..=most).contains(&slope(anchor, pair[1]));
        if !fits && pair[0] != anchor {
            anchor = pair[0];
            kept.push(number);
            (least, most) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        if pair[1].0 > anchor.0 {
            let width = TOLERANCE / (pair[1].0 - anchor.0);
            least = least.max(slope(anchor, pair[1]) - width);
            most = most.min(slope(anchor, pair[1]) + width);
        }
    }
    if line.len() > 1 {
        kept.push(line.len() - 1);
    }
    kept
}

/// The style of crosses.
fn crosses_of(path: &str) -> String {
    line(path, "black", 1.2, "mark")
}

/// A cross around (x, y) [px], in units.
fn cross(x: f64, y: f64) -> String {
    let mut path = String::new();
    append(&mut path, &[(x - CROSS, y - CROSS), (x + CROSS, y + CROSS)]);
    append(&mut path, &[(x - CROSS, y + CROSS), (x + CROSS, y - CROSS)]);
    path
}

/// A path of whole units, `width` [px] wide.
fn line(path: &str, colour: &str, width: f64, class: &str) -> String {
    format!(
        "<path {} d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{:.0}\" stroke-linejoin=\"round\" \
         class=\"{class}\"/>",
        in_px(),
        width * UNITS_PER_PX
    )
}

fn colour_bar(drawing: &mut Drawing, speeds: &Axis, bar: &Bar) {
    let Plot { top, right, bottom, .. } = drawing.plot;
    let classes = classes(speeds);
    let (left, width, height) = (right + bar.gap, bar.width, (bottom - top) / classes as f64);
    for class in 0..classes {
        let (y, (fill, class)) = (bottom - (class + 1) as f64 * height, colour(class, classes));
        drawing.add(&format!(
            "<rect x=\"{left}\" y=\"{y:.1}\" width=\"{width}\" height=\"{height:.1}\" fill=\"{fill}\" \
             class=\"area {class}\"/>"
        ));
    }
    for (speed, text) in speeds.ticks() {
        let at = drawing.plot.down(speeds, speed);
        drawing.text(left + width + 6.0, at, Anchor::Start, &text);
    }
    drawing.upright_text(right + bar.label, &speeds.label);
}

#[cfg(test)]
mod tests;
