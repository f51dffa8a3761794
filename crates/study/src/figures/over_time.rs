//! Quantities over time.

use super::axes::Axis;
use super::drawing::{Around, Drawing};
use super::drawn::{Drawn, Values, text, value};
use super::series::{colour, dashes, line_key};
use super::sheet::Sheet;

/// A quantity over time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeLine {
    /// Its name in the legend.
    pub name: String,
    /// Its values at their times [s], in order.
    pub points: Vec<[f64; 2]>,
}

/// Draws lines over time [s]; what is not finite is left out.
pub fn over_time(sheet: Sheet, label: &str, lines: &[TimeLine]) -> Drawn {
    let finite = || lines.iter().flat_map(|it| &it.points).filter(|it| it.iter().all(|it| it.is_finite()));
    let from = finite().map(|it| it[0]).fold(f64::INFINITY, f64::min);
    let to = finite().map(|it| it[0]).fold(f64::NEG_INFINITY, f64::max);
    let [across, upwards] = sheet.layout().steps;
    let x = Axis::spanning("Time [s]", from, to, across);
    let y = Axis::from_zero(label, finite().map(|it| it[1]).fold(0.0, f64::max), upwards);

    let keys = lines.iter().enumerate().map(|(index, it)| line_key(&it.name, index)).collect();
    let mut drawing = Drawing::new(sheet, Around { keys, ..Around::default() });
    drawing.axes(&x, &y);
    let plot = drawing.plot;
    let mut values = Values::of(["series", "Time [s]", label]);
    for (index, line) in lines.iter().enumerate() {
        let mut path = String::new();
        for [time, quantity] in line.points.iter().filter(|it| it.iter().all(|it| it.is_finite())) {
            let command = if path.is_empty() { 'M' } else { 'L' };
            path += &format!("{command}{:.1} {:.1}", plot.across(&x, *time), plot.down(&y, *quantity));
            values.row([text(&line.name), value(*time), value(*quantity)]);
        }
        let ((colour, class), dashes) = (colour(index), dashes(index));
        drawing.add(&format!(
            "<g fill=\"none\" stroke=\"{colour}\" class=\"{class}\"><path d=\"{path}\" stroke-width=\"1.6\" \
             stroke-linejoin=\"round\"{dashes}/></g>"
        ));
    }
    drawing.frame();
    drawing.finish(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_goes_from_value_to_value() {
        // The plot from (62, 27.5) to (466, 257.5) px; 100 … 200 s, 0 … 50 vehicles.
        let points = vec![[100.0, 0.0], [150.0, f64::NAN], [150.0, 25.0], [200.0, 50.0]];
        let svg =
            over_time(Sheet::Column, "Vehicles", &[TimeLine { name: "on the road".into(), points }]).svg;
        assert!(svg.contains("d=\"M62.0 257.5L264.0 142.5L466.0 27.5\""), "{svg}");
        for text in ["Time [s]", "Vehicles", "on the road"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
    }
}
