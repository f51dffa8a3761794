//! A series of estimates in a figure: line, error bars, markers, and its entry in the legend.

use super::drawing::Key;
use crate::statistics::Interval;

/// Colours of the series in turn (Okabe and Ito: distinguishable for colour-blind readers, too).
pub(super) const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00"];
/// Radius of a marker, and half the cap of an error bar [px].
const RADIUS: f64 = 4.5;
const CAP: f64 = 4.0;

/// A value with its interval, at its position along the other axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimated {
    /// Its position.
    pub at: f64,
    /// The value.
    pub value: f64,
    /// Its interval.
    pub interval: Interval,
}

impl Estimated {
    pub(super) fn is_finite(&self) -> bool {
        self.at.is_finite() && self.value.is_finite() && self.interval.upper.is_finite()
    }
}

/// Colour of a series, and its class in a style sheet.
pub(super) fn colour(index: usize) -> (&'static str, String) {
    (COLOURS[index % COLOURS.len()], format!("series s{}", index % COLOURS.len()))
}

/// Line, error bars and markers of the series with the given index.
pub(super) fn curve(
    points: &[Estimated],
    index: usize,
    across: impl Fn(f64) -> f64,
    down: impl Fn(f64) -> f64,
) -> String {
    let (mut line, mut bars, mut markers) = (String::new(), String::new(), String::new());
    for Estimated { at, value, interval } in points {
        let centre = across(*at);
        let [middle, low, high] = [*value, interval.lower, interval.upper].map(&down);
        line += &format!("{}{centre:.1} {middle:.1}", if line.is_empty() { 'M' } else { 'L' });
        bars += &upright_bar(centre, [low, high]);
        markers += &marker(centre, middle, index);
    }
    let (colour, class) = colour(index);
    format!(
        "<g fill=\"none\" stroke=\"{colour}\" class=\"{class}\"><path d=\"{line}\" stroke-opacity=\"0.4\"/>\
         <path d=\"{bars}\" stroke-width=\"1.3\"/>\
         <path d=\"{markers}\" fill=\"{colour}\" stroke=\"white\" class=\"dot\"/></g>"
    )
}

/// A vertical error bar with its caps.
fn upright_bar(x: f64, [low, high]: [f64; 2]) -> String {
    let (west, cap) = (x - CAP, 2.0 * CAP);
    format!("M{x:.1} {low:.1}V{high:.1}M{west:.1} {low:.1}h{cap}M{west:.1} {high:.1}h{cap}")
}

/// A horizontal error bar with its caps.
pub(super) fn level_bar(y: f64, [low, high]: [f64; 2]) -> String {
    let (north, cap) = (y - CAP, 2.0 * CAP);
    format!("M{low:.1} {y:.1}H{high:.1}M{low:.1} {north:.1}v{cap}M{high:.1} {north:.1}v{cap}")
}

/// The legend's entry of a series with markers.
pub(super) fn key(text: &str, index: usize) -> Key {
    let (colour, class) = colour(index);
    let mark = format!(
        "<g fill=\"{colour}\" class=\"{class}\"><path d=\"{}\" class=\"dot\"/></g>",
        marker(0.0, 0.0, index)
    );
    Key { mark, text: text.into() }
}

/// The legend's entry of a series that is a line.
pub(super) fn line_key(text: &str, index: usize) -> Key {
    let (colour, class) = colour(index);
    let dashes = dashes(index);
    let mark = format!(
        "<g fill=\"none\" stroke=\"{colour}\" class=\"{class}\"><path d=\"M-8 0H8\" stroke-width=\"2\"{dashes}/></g>"
    );
    Key { mark, text: text.into() }
}

/// Dash patterns of lines, so that series can be distinguished without colours.
pub(super) fn dashes(index: usize) -> &'static str {
    match index % 4 {
        0 => "",
        1 => " stroke-dasharray=\"7 3\"",
        2 => " stroke-dasharray=\"2 2.5\"",
        _ => " stroke-dasharray=\"8 3 2 3\"",
    }
}

/// Circle, square, diamond, triangle, triangle upside down or cross, in turn.
pub(super) fn marker(x: f64, y: f64, index: usize) -> String {
    marker_of(x, y, index, 1.0)
}

/// The larger one of width and height of a marker of the usual size [px].
pub(super) fn extent(index: usize) -> f64 {
    match index % 6 {
        1 => 8.0,
        2 => 11.0,
        3 | 4 => 10.0,
        _ => 2.0 * RADIUS,
    }
}

/// A marker of a size, as a multiple of the usual one.
pub(super) fn marker_of(x: f64, y: f64, index: usize, size: f64) -> String {
    let px = |it: f64| (it * size * 100.0).round() / 100.0;
    let (r, d) = (px(RADIUS), px(2.0 * RADIUS));
    match index % 6 {
        0 => format!("M{:.1} {y:.1}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z", x - r),
        1 => format!("M{:.1} {:.1}h{s}v{s}h-{s}z", x - px(4.0), y - px(4.0), s = px(8.0)),
        2 => format!("M{x:.1} {:.1}l{h} {h}l-{h} {h}l-{h} -{h}z", y - px(5.5), h = px(5.5)),
        3 => format!("M{x:.1} {:.1}l{r} {h}h-{d}z", y - px(5.0), h = px(8.0)),
        4 => format!("M{x:.1} {:.1}l{r} -{h}h-{d}z", y + px(5.0), h = px(8.0)),
        _ => format!(
            "M{:.1} {:.1}h{a}v{a}h{a}v{a}h-{a}v{a}h-{a}v-{a}h-{a}v-{a}h{a}z",
            x - px(1.5),
            y - px(4.5),
            a = px(3.0)
        ),
    }
}
