//! Estimates along an axis, each with its interval.

use super::axes::Axis;
use super::drawing::{Around, Drawing};
use super::drawn::{Drawn, Values, text, value};
use super::series::{Estimated, curve, key};
use super::sheet::Sheet;

/// Horizontal offset between series at the same place, so that their bars do not hide each other [px].
const STAGGER: f64 = 3.0;

/// Draws series of estimates by name, along axes from zero with these labels. Points that are not finite are left out;
/// several series are staggered by a few pixels.
pub fn estimates(
    sheet: Sheet,
    title: &str,
    [across, upwards]: [&str; 2],
    series: &[(String, Vec<Estimated>)],
) -> Drawn {
    let finite = |(_, points): &(String, Vec<Estimated>)| {
        points.iter().copied().filter(Estimated::is_finite).collect::<Vec<Estimated>>()
    };
    let finite: Vec<Vec<Estimated>> = series.iter().map(finite).collect();
    let all = || finite.iter().flatten();
    let steps = sheet.layout().steps;
    let furthest = all().map(|it| it.at).fold(0.0, f64::max);
    let highest = all().map(|it| it.interval.upper).fold(0.0, f64::max);
    let x = Axis::from_zero(across, furthest, steps[0]);
    let y = Axis::from_zero(upwards, highest, steps[1]);

    let keys = series.iter().enumerate().map(|(index, it)| key(&it.0, index)).collect();
    let mut drawing = Drawing::new(sheet, Around { title, keys, ..Around::default() });
    drawing.axes(&x, &y);
    drawing.frame();
    let plot = drawing.plot;
    let mut values = Values::of(["series", across, upwards, "lower", "upper"]);
    for (index, points) in finite.iter().enumerate() {
        let shift = STAGGER * (index as f64 - 0.5 * (series.len() - 1) as f64);
        let place = |at: f64| plot.across(&x, at) + shift;
        drawing.add(&curve(points, index, place, |value| plot.down(&y, value)));
        for Estimated { at, value: mean, interval } in points {
            let numbers = [*at, *mean, interval.lower, interval.upper].map(value);
            values.row([text(&series[index].0)].into_iter().chain(numbers));
        }
    }
    drawing.finish(values)
}
