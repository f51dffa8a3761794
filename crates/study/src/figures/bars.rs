//! Horizontal bars: values of named rows with their intervals.

use super::axes::Axis;
use super::drawing::{Anchor, Around, Drawing};
use super::drawn::{Drawn, Values, text, value};
use super::series::{Estimated, colour, key, level_bar, marker};
use super::sheet::Sheet;

/// Height of a bar with its margin, and margin between rows [px].
const PITCH: f64 = 18.0;
const BETWEEN: f64 = 14.0;
/// Minimum height of a plot, so that the label of its rows fits [px].
const LEAST_HEIGHT: f64 = 150.0;
/// Height of a bar [px].
const HEIGHT: f64 = 9.0;

/// A row: one bar for each series.
#[derive(Clone, Debug, PartialEq)]
pub struct BarRow {
    /// Its name.
    pub name: String,
    /// One value for each series; values that are not finite are left out. The position of an estimate does not
    /// count.
    pub values: Vec<Estimated>,
}

/// Draws rows of bars from zero, each with its interval, one below the other. `labels` are those of the values and of
/// the rows.
pub fn bars(sheet: Sheet, labels: [&str; 2], series: &[&str], rows: &[BarRow]) -> Drawn {
    /// Longer names are shortened.
    const LONGEST: usize = 20;
    let short = |it: &BarRow| -> String {
        let is_long = it.name.chars().count() > LONGEST;
        it.name
            .chars()
            .take(if is_long { LONGEST - 1 } else { LONGEST })
            .chain(is_long.then_some('…'))
            .collect()
    };
    let names: Vec<String> = rows.iter().map(short).collect();
    let finite = || rows.iter().flat_map(|it| &it.values).filter(|it| it.is_finite());
    let layout = sheet.layout();
    let longest = names.iter().map(|it| it.chars().count()).max().unwrap_or(0) as f64 * layout.text * 0.56;
    let low = finite().map(|it| it.interval.lower).fold(0.0, f64::min);
    let high = finite().map(|it| it.interval.upper).fold(0.0, f64::max);
    let x = Axis::around_zero(labels[0], [low, high], layout.steps[0]);
    let pitch = BETWEEN + PITCH * series.len() as f64;
    let around = Around {
        keys: if series.len() > 1 {
            series.iter().enumerate().map(|(index, it)| key(it, index)).collect()
        } else {
            Vec::new()
        },
        names: Some(longest),
        height: Some(LEAST_HEIGHT.max(pitch * rows.len() as f64)),
        ..Around::default()
    };
    let mut drawing = Drawing::new(sheet, around);
    let plot = drawing.plot;
    drawing.grid(Some(&x), None);
    drawing.texts_across(&x);
    drawing.upright_text(layout.upright, labels[1]);
    let pitch = (plot.bottom - plot.top) / rows.len().max(1) as f64;
    for (number, (row, name)) in rows.iter().zip(&names).enumerate() {
        let middle = plot.top + pitch * (number as f64 + 0.5);
        drawing.text(plot.left - 8.0, middle, Anchor::End, name);
        for (index, it) in row.values.iter().enumerate().filter(|(_, it)| it.is_finite()) {
            let y = middle + PITCH * (index as f64 - 0.5 * (series.len() as f64 - 1.0));
            drawing.add(&bar(it, index, y, |value| plot.across(&x, value)));
        }
    }
    drawing.frame();
    drawing.finish(values(labels, series, rows))
}

/// A row for each bar.
fn values(labels: [&str; 2], series: &[&str], rows: &[BarRow]) -> Values {
    let mut values = Values::of([labels[1], "series", labels[0], "lower", "upper"]);
    for row in rows {
        for (name, it) in series.iter().zip(&row.values).filter(|(_, it)| it.is_finite()) {
            let numbers = [it.value, it.interval.lower, it.interval.upper].map(value);
            values.row([text(&row.name), text(name)].into_iter().chain(numbers));
        }
    }
    values
}

fn bar(it: &Estimated, index: usize, y: f64, across: impl Fn(f64) -> f64) -> String {
    let (zero, end) = (across(0.0), across(it.value));
    let (left, top, width) = (zero.min(end), y - 0.5 * HEIGHT, (end - zero).abs());
    let whiskers = level_bar(y, [it.interval.lower, it.interval.upper].map(&across));
    let ((colour, class), dot) = (colour(index), marker(end, y, index));
    format!(
        "<g fill=\"none\" stroke=\"{colour}\" class=\"{class}\">\
         <rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{HEIGHT}\" fill=\"{colour}\" stroke=\"none\" \
         fill-opacity=\"0.3\" class=\"bar\"/><path d=\"{whiskers}\" stroke-width=\"1.3\"/>\
         <path d=\"{dot}\" fill=\"{colour}\" stroke=\"white\" class=\"dot\"/></g>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::Interval;

    const LABELS: [&str; 2] = ["lane changes [1/(veh km)]", "Style"];

    fn row(name: &str, value: f64) -> BarRow {
        let interval = Interval { lower: value - 1.0, upper: value + 1.0 };
        BarRow { name: name.into(), values: vec![Estimated { at: 0.0, value, interval }] }
    }

    #[test]
    fn a_bar_ends_at_its_value_between_the_ends_of_its_interval() {
        // Names of 4 characters: the plot from 14 + 28 + 29.12 = 71.12 px to 466 px; 0 … 4; two rows of 75 px from 14
        // px on.
        let svg = bars(Sheet::Column, LABELS, &["all"], &[row("a & b", 3.0), row("c", 1.0)]).svg;
        assert!(svg.contains(">a &amp; b</text>") && svg.contains(">Style</text>"), "{svg}");
        let rect = "<rect x=\"78.4\" y=\"47.0\" width=\"290.7\" height=\"9\"";
        assert!(svg.contains(rect), "{svg}");
        assert!(svg.contains("d=\"M272.2 51.5H466.0M272.2 47.5v8M466.0 47.5v8\""), "{svg}");
    }

    #[test]
    fn a_bar_below_zero_reaches_to_the_left_within_the_frame() {
        let svg = bars(Sheet::Column, LABELS, &["all"], &[row("a", 2.0), row("c", -1.0)]).svg;
        let ends: Vec<f64> = svg
            .match_indices("<rect x=\"")
            .filter_map(|(at, found)| svg[at + found.len()..].split('"').next()?.parse().ok())
            .collect();
        assert!(ends.len() >= 2 && ends.iter().all(|it| *it >= 0.0), "{svg}");
        assert!(svg.contains(">−2</text>") || svg.contains(">-2</text>"), "{svg}");
    }

    #[test]
    fn a_long_name_is_shortened_and_a_value_that_is_not_known_left_out() {
        let svg =
            bars(Sheet::Column, LABELS, &["all"], &[row("a name that is by far too long", f64::NAN)]).svg;
        assert!(svg.contains(">a name that is by f…</text>") && !svg.contains("class=\"bar\""), "{svg}");
    }
}
