//! Many observations as points, and their means with intervals, in groups.

use std::collections::BTreeMap;

use super::axes::Axis;
use super::drawing::{Around, Drawing};
use super::drawn::{Drawn, Values, text, value};
use super::series::{Estimated, colour, curve, key};
use super::sheet::Sheet;

/// Size of a point [px].
const POINT: f64 = 3.6;
/// Observations on the same pixel are one point; up to each number of them, the point has this opacity.
const OPACITIES: [(usize, f64); 3] = [(1, 0.55), (4, 0.75), (usize::MAX, 0.95)];

/// A group of observations.
#[derive(Clone, Debug, PartialEq)]
pub struct Scattered {
    /// Its name in the legend, which exists only for several groups.
    pub name: String,
    /// Its observations (x, y).
    pub points: Vec<[f64; 2]>,
    /// Means of them, with their intervals.
    pub means: Vec<Estimated>,
}

/// Draws the points of all groups, and over them the means. Points on the same pixel are one, which is the more
/// opaque the more there are. Both axes begin at zero. Values that are not finite are left out.
pub fn scatter(sheet: Sheet, labels: [&str; 2], groups: &[Scattered]) -> Drawn {
    let groups: Vec<Scattered> = groups.iter().map(finite).collect();
    let points = || groups.iter().flat_map(|it| &it.points);
    let means = || groups.iter().flat_map(|it| &it.means);
    let [across, upwards] = sheet.layout().steps;
    let widest = points().map(|it| it[0]).chain(means().map(|it| it.at)).fold(0.0, f64::max);
    let highest = points().map(|it| it[1]).chain(means().map(|it| it.interval.upper)).fold(0.0, f64::max);
    let x = Axis::from_zero(labels[0], widest, across);
    let y = Axis::from_zero(labels[1], highest, upwards);

    let keys = match &groups[..] {
        [] | [_] => Vec::new(),
        several => several.iter().enumerate().map(|(index, it)| key(&it.name, index)).collect(),
    };
    let mut drawing = Drawing::new(sheet, Around { keys, ..Around::default() });
    drawing.axes(&x, &y);
    let plot = drawing.plot;
    let [across, upwards] = labels;
    let mut values = Values::of(["series", "what", across, upwards, "lower", "upper", "observations"]);
    for (index, group) in groups.iter().enumerate() {
        let place = |[px, py]: [f64; 2]| [plot.across(&x, px), plot.down(&y, py)].map(|it| it.round() as i64);
        let pixels = pixels(&group.points, place);
        for pixel in pixels.values() {
            let [x, y] = pixel.mean().map(value);
            let [name, what] = [text(&group.name), "point".into()];
            values.row([name, what, x, y, String::new(), String::new(), pixel.count.to_string()]);
        }
        let (colour, class) = colour(index);
        drawing.add(&format!(
            "<g fill=\"none\" stroke=\"{colour}\" stroke-width=\"{POINT}\" stroke-linecap=\"round\" class=\"{class}\">{}</g>",
            dots(&pixels)
        ));
    }
    drawing.frame();
    for (index, group) in groups.iter().enumerate().filter(|(_, it)| !it.means.is_empty()) {
        drawing.add(&curve(&group.means, index, |at| plot.across(&x, at), |value| plot.down(&y, value)));
        for Estimated { at, value: mean, interval } in &group.means {
            let [x, y, lower, upper] = [*at, *mean, interval.lower, interval.upper].map(value);
            values.row([text(&group.name), "mean".into(), x, y, lower, upper, String::new()]);
        }
    }
    drawing.finish(values)
}

fn finite(group: &Scattered) -> Scattered {
    let Scattered { name, points, means } = group;
    Scattered {
        name: name.clone(),
        points: points.iter().copied().filter(|it| it.iter().all(|it| it.is_finite())).collect(),
        means: means.iter().copied().filter(Estimated::is_finite).collect(),
    }
}

/// The observations on a pixel.
#[derive(Clone, Copy, Default)]
struct Pixel {
    count: usize,
    sums: [f64; 2],
}

impl Pixel {
    /// Their mean, which is the observation itself where there is one.
    fn mean(&self) -> [f64; 2] {
        self.sums.map(|it| it / self.count as f64)
    }
}

/// Observations by the pixel at which they are drawn.
fn pixels(points: &[[f64; 2]], place: impl Fn([f64; 2]) -> [i64; 2]) -> BTreeMap<[i64; 2], Pixel> {
    let mut pixels: BTreeMap<[i64; 2], Pixel> = BTreeMap::new();
    for point in points {
        let pixel = pixels.entry(place(*point)).or_default();
        pixel.count += 1;
        pixel.sums.iter_mut().zip(point).for_each(|(sum, it)| *sum += it);
    }
    pixels
}

/// Points at pixels, as lines of no length, grouped by the number of observations at each.
fn dots(pixels: &BTreeMap<[i64; 2], Pixel>) -> String {
    let mut least = 1;
    let mut dots = String::new();
    for (most, opacity) in OPACITIES {
        let of_class = pixels.iter().filter(|(_, it)| (least..=most).contains(&it.count));
        let path: String = of_class.map(|([x, y], _)| format!("M{x} {y}h0")).collect();
        if !path.is_empty() {
            dots += &format!("<path d=\"{path}\" stroke-opacity=\"{opacity}\"/>");
        }
        least = most.saturating_add(1);
    }
    dots
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Interval;

    const LABELS: [&str; 2] = ["density [veh/km]", "flow [veh/h]"];

    fn group(points: &[[f64; 2]], means: &[Estimated]) -> Scattered {
        Scattered { name: "a & b".into(), points: points.to_vec(), means: means.to_vec() }
    }

    #[test]
    fn a_point_stands_where_its_values_are_and_several_on_a_pixel_are_one() {
        // The plot from (62, 14) to (466, 244) px; 0 … 40 veh/km, 0 … 2000 veh/h.
        let points = [[20.0, 990.0], [20.01, 990.2], [40.0, 2000.0], [f64::NAN, 3.0]];
        let svg = scatter(Sheet::Column, LABELS, &[group(&points, &[])]).svg;
        assert!(svg.contains("<path d=\"M466 14h0\" stroke-opacity=\"0.55\"/>"), "{svg}");
        assert!(svg.contains("<path d=\"M264 130h0\" stroke-opacity=\"0.75\"/>"), "{svg}");
    }

    #[test]
    fn a_mean_stands_with_its_interval() {
        let interval = Interval { lower: 500.0, upper: 2000.0 };
        let mean = Estimated { at: 40.0, value: 1000.0, interval };
        let svg = scatter(Sheet::Column, LABELS, &[group(&[[40.0, 1000.0]], &[mean])]).svg;
        assert!(svg.contains("d=\"M466.0 186.5V14.0M"), "{svg}");
        assert!(LABELS.iter().all(|it| svg.contains(&format!(">{it}</text>"))));
    }

    #[test]
    fn groups_are_named_where_there_are_several() {
        let one = group(&[[1.0, 1.0]], &[]);
        assert!(!scatter(Sheet::Column, LABELS, std::slice::from_ref(&one)).svg.contains("a &amp; b"));
        assert!(scatter(Sheet::Column, LABELS, &[one.clone(), one]).svg.contains(">a &amp; b</text>"));
    }

    #[test]
    fn a_hundred_thousand_points_are_a_small_figure() {
        let place = |i: i32| [f64::from(i % 500), f64::from((i * 37) % 991)];
        let points: Vec<[f64; 2]> = (0..100_000).map(place).collect();
        let bytes = scatter(Sheet::Column, LABELS, &[group(&points, &[])]).svg.len();
        assert!((100_000..1_000_000).contains(&bytes), "{bytes}");
    }
}
