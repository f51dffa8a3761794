//! Many observations as points, and their means with intervals.

use std::collections::BTreeMap;

use super::axes::Axis;
use super::drawing::{Around, Drawing, Key};
use super::series::{Estimated, curve, key};
use super::sheet::Sheet;

/// Size of a point [px].
const POINT: f64 = 3.2;
/// Observations on the same pixel are one point; up to so many of them, it is so opaque.
const OPACITIES: [(usize, f64); 3] = [(1, 0.35), (4, 0.6), (usize::MAX, 0.9)];
/// Colour of the points.
const COLOUR: &str = "#6b7480";

/// Draws `points` (x, y), those on the same pixel as one that is the more opaque the more there are, and over them `means`
/// with their intervals; both axes begin at zero. Each has its entry in the legend, if it has any points. What is not finite
/// is left out.
pub fn scatter(
    sheet: Sheet,
    labels: [&str; 2],
    (name, points): (&str, &[[f64; 2]]),
    (mean, means): (&str, &[Estimated]),
) -> String {
    let points: Vec<[f64; 2]> =
        points.iter().copied().filter(|it| it.iter().all(|it| it.is_finite())).collect();
    let means: Vec<Estimated> = means.iter().copied().filter(Estimated::is_finite).collect();
    let [across, upwards] = sheet.layout().steps;
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let widest = most(&mut points.iter().map(|it| it[0]).chain(means.iter().map(|it| it.at)));
    let highest = most(&mut points.iter().map(|it| it[1]).chain(means.iter().map(|it| it.interval.upper)));
    let x = Axis::from_zero(labels[0], widest, across);
    let y = Axis::from_zero(labels[1], highest, upwards);

    let mut keys = Vec::new();
    if !points.is_empty() {
        keys.push(Key { mark: dots("M0 0h0", OPACITIES[1].1), text: name.into() });
    }
    if !means.is_empty() {
        keys.push(key(mean, 0));
    }
    let mut drawing = Drawing::new(sheet, Around { keys, ..Around::default() });
    drawing.axes(&x, &y);
    let plot = drawing.plot;
    let mut pixels: BTreeMap<[i64; 2], usize> = BTreeMap::new();
    for [px, py] in &points {
        let place = [plot.across(&x, *px), plot.down(&y, *py)].map(|it| it.round() as i64);
        *pixels.entry(place).or_default() += 1;
    }
    let mut least = 1;
    for (most, opacity) in OPACITIES {
        let of_class = pixels.iter().filter(|(_, count)| (least..=most).contains(*count));
        let path: String = of_class.map(|([x, y], _)| format!("M{x} {y}h0")).collect();
        if !path.is_empty() {
            drawing.add(&dots(&path, opacity));
        }
        least = most.saturating_add(1);
    }
    drawing.frame();
    if !means.is_empty() {
        drawing.add(&curve(&means, 0, |at| plot.across(&x, at), |value| plot.down(&y, value)));
    }
    drawing.finish()
}

/// Points, as lines of no length with round ends.
fn dots(path: &str, opacity: f64) -> String {
    format!(
        "<path d=\"{path}\" fill=\"none\" stroke=\"{COLOUR}\" stroke-width=\"{POINT}\" stroke-linecap=\"round\" \
         stroke-opacity=\"{opacity}\" class=\"point\"/>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Interval;

    const LABELS: [&str; 2] = ["density [veh/km]", "flow [veh/h]"];

    #[test]
    fn a_point_stands_where_its_values_are_and_several_on_a_pixel_are_one() {
        // The plot from (62, 25.5) to (466, 255.5) px; 0 … 40 veh/km, 0 … 2000 veh/h.
        let points = [[20.0, 990.0], [20.01, 990.2], [40.0, 2000.0], [f64::NAN, 3.0]];
        let svg = scatter(Sheet::Column, LABELS, ("boxes", &points), ("mean", &[]));
        assert!(svg.contains("<path d=\"M466 26h0\"") && svg.contains("<path d=\"M264 142h0\""), "{svg}");
        assert!(svg.contains(">boxes</text>") && !svg.contains(">mean</text>"));
    }

    #[test]
    fn a_mean_stands_with_its_interval() {
        let interval = Interval { lower: 500.0, upper: 2000.0 };
        let mean = Estimated { at: 40.0, value: 1000.0, interval };
        let svg = scatter(Sheet::Column, LABELS, ("boxes", &[[40.0, 1000.0]]), ("mean", &[mean]));
        assert!(svg.contains("d=\"M466.0 198.0V25.5M"), "{svg}");
        assert!(LABELS.iter().all(|it| svg.contains(&format!(">{it}</text>"))));
    }

    #[test]
    fn a_hundred_thousand_points_are_a_small_figure() {
        let place = |i: i32| [f64::from(i % 500), f64::from((i * 37) % 991)];
        let points: Vec<[f64; 2]> = (0..100_000).map(place).collect();
        let bytes = scatter(Sheet::Column, LABELS, ("", &points), ("", &[])).len();
        assert!(bytes < 1_000_000, "{bytes}");
    }
}
