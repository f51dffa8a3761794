//! An SVG page with a title, a frame, a grid, labelled axes and a legend.
//!
//! The elements have colours, for a file of its own. They also have classes, so that the style sheet of a document
//! can change the colours: `sheet`, `grid`, `frame`, and those of the parts that figures add.

use super::axes::Axis;
use super::drawn::{Drawn, Values};
use super::sheet::{Layout, Sheet};

/// Size of a title [px].
const TITLE_SIZE: f64 = 18.0;
/// From the middle of a text to its base line, in text sizes.
const MIDDLE_TO_BASE: f64 = 0.35;
/// Width of a character, in text sizes: an upper estimate of the mean.
const CHARACTER_WIDTH: f64 = 0.62;
/// Right margin of a column [px].
const MARGIN: f64 = 14.0;
/// Line pitch of a legend beside and above the plot, space for a mark, and between two entries above it [px].
const PITCH: [f64; 2] = [24.0, 19.0];
const MARK: f64 = 18.0;
const BETWEEN: f64 = 16.0;

/// The anchor of a text relative to its point.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// An entry of a legend: a mark around (0, 0) as SVG, and its meaning.
pub(super) struct Key {
    pub(super) mark: String,
    pub(super) text: String,
}

/// The parts around a plot.
#[derive(Default)]
pub(super) struct Around<'a> {
    /// The title; a column has none.
    pub(super) title: &'a str,
    /// The legend.
    pub(super) keys: Vec<Key>,
    /// Space for more to the right of the plot [px].
    pub(super) right: f64,
    /// Width of names to the left of the plot, in place of numbers [px].
    pub(super) names: Option<f64>,
    /// Height of the plot, where it is not the default [px].
    pub(super) height: Option<f64>,
}

/// Edges of a plot [px].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plot {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Plot {
    /// Horizontal place of a value [px].
    pub(super) fn across(&self, axis: &Axis, value: f64) -> f64 {
        self.left + axis.share(value) * (self.right - self.left)
    }

    /// Vertical place of a value [px].
    pub(super) fn down(&self, axis: &Axis, value: f64) -> f64 {
        self.bottom - axis.share(value) * (self.bottom - self.top)
    }
}

/// A page under construction.
pub(super) struct Drawing {
    pub(super) plot: Plot,
    layout: Layout,
    svg: String,
}

/// Approximate width of a text of the usual size in a figure [px].
pub fn text_width(text: &str) -> f64 {
    width(text, Sheet::Page.layout().text)
}

fn width(text: &str, size: f64) -> f64 {
    /// Factor of the width for characters that are wider than most.
    const WIDE: f64 = 1.6;
    let characters = text.chars().map(|it| if "mwMW%".contains(it) { WIDE } else { 1.0 });
    characters.sum::<f64>() * CHARACTER_WIDTH * size
}

impl Drawing {
    pub(super) fn new(sheet: Sheet, around: Around) -> Drawing {
        let layout = sheet.layout();
        let Around { title, keys, right, names, height } = around;
        let left = names.map_or(layout.left, |it| it + layout.upright + 2.0 * MARGIN);
        let whole = layout.left + layout.plot[0];
        let (width, right, places) = match sheet {
            Sheet::Page => {
                let edge = left + layout.plot[0];
                let longest = keys.iter().map(|it| text_width(&it.text) + 60.0).fold(0.0, f64::max);
                (edge + right.max(longest), edge, beside(edge, &keys, layout))
            }
            Sheet::Column => (whole + MARGIN, whole - right, above([layout.left, whole], &keys, layout)),
        };
        let lines = match (sheet, places.last()) {
            (Sheet::Column, Some(last)) => last[1],
            _ => 0.0,
        };
        let top = layout.top + lines;
        let bottom = top + height.unwrap_or(layout.plot[1]);
        let plot = Plot { left, top, right, bottom };
        let mut page = Drawing::open(sheet, [width, bottom + layout.foot], plot);
        if sheet == Sheet::Page {
            // A long title is set smaller rather than cut off.
            let characters = title.chars().count().max(1) as f64;
            let size = TITLE_SIZE.min((width - left) / (characters * CHARACTER_WIDTH));
            let text = escaped(title);
            page.add(&format!("<text x=\"{left}\" y=\"34\" font-size=\"{size:.1}\">{text}</text>"));
        }
        page.keys(&keys, &places);
        page
    }

    /// A column without axes.
    pub(super) fn blank([width, height]: [f64; 2]) -> Drawing {
        let plot = Plot { left: 0.0, top: 0.0, right: width, bottom: height };
        Drawing::open(Sheet::Column, [width, height], plot)
    }

    /// An empty page of this size.
    fn open(sheet: Sheet, [width, height]: [f64; 2], plot: Plot) -> Drawing {
        let layout = sheet.layout();
        let size = layout.text;
        // Within HTML an SVG element needs no namespace.
        let namespace = match sheet {
            Sheet::Page => " xmlns=\"http://www.w3.org/2000/svg\"",
            Sheet::Column => " role=\"img\"",
        };
        let svg = format!(
            "<svg{namespace} viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" \
             font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{size}\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\" class=\"sheet\"/>\n"
        );
        Drawing { plot, layout, svg }
    }

    /// The entries of a legend at their places.
    pub(super) fn keys(&mut self, keys: &[Key], places: &[[f64; 2]]) {
        for (Key { mark, text }, [x, y]) in keys.iter().zip(places) {
            self.add(&format!("<g transform=\"translate({x:.1} {y:.1})\">{mark}</g>"));
            self.text(x + MARK, *y, Anchor::Start, text);
        }
    }

    /// Grid, ticks and labels of both axes.
    pub(super) fn axes(&mut self, x: &Axis, y: &Axis) {
        self.grid(Some(x), Some(y));
        self.texts_across(x);
        self.texts_upwards(y);
    }

    /// The grid of one or both axes.
    pub(super) fn grid(&mut self, x: Option<&Axis>, y: Option<&Axis>) {
        let Plot { left, top, right, bottom } = self.plot;
        let mut grid = String::new();
        if let Some(y) = y {
            for (value, _) in y.ticks() {
                grid += &format!("M{left} {:.1}H{right}", self.plot.down(y, value));
            }
        }
        if let Some(x) = x {
            for (value, _) in x.ticks() {
                grid += &format!("M{:.1} {top}V{bottom}", self.plot.across(x, value));
            }
        }
        self.add(&format!("<path d=\"{grid}\" stroke=\"#e2e2e2\" fill=\"none\" class=\"grid\"/>"));
    }

    /// Ticks and label of the axis across.
    pub(super) fn texts_across(&mut self, x: &Axis) {
        let Plot { left, right, bottom, .. } = self.plot;
        let [ticks, label] = self.layout.below;
        for (value, text) in x.ticks() {
            self.text(self.plot.across(x, value), bottom + ticks, Anchor::Middle, &text);
        }
        self.text((left + right) / 2.0, bottom + label, Anchor::Middle, &x.label);
    }

    /// Ticks and label of the axis upwards.
    pub(super) fn texts_upwards(&mut self, y: &Axis) {
        for (value, text) in y.ticks() {
            let at = self.plot.down(y, value);
            self.text(self.plot.left - 8.0, at, Anchor::End, &text);
        }
        self.upright_text(self.layout.upright, &y.label);
    }

    /// The frame, to be drawn over the data.
    pub(super) fn frame(&mut self) {
        let Plot { left, top, right, bottom } = self.plot;
        let (width, height) = (right - left, bottom - top);
        self.add(&format!(
            "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#404040\" \
             class=\"frame\"/>"
        ));
    }

    /// A text whose middle line goes through (x, y) [px].
    pub(super) fn text(&mut self, x: f64, y: f64, anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (y, text) = (y + MIDDLE_TO_BASE * self.layout.text, escaped(text));
        self.add(&format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"));
    }

    /// A text that reads upwards, in the middle of the plot's height.
    pub(super) fn upright_text(&mut self, x: f64, text: &str) {
        let (y, text) = ((self.plot.top + self.plot.bottom) / 2.0, escaped(text));
        self.add(&format!(
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\">{text}</text>"
        ));
    }

    /// An element as given.
    pub(super) fn add(&mut self, element: &str) {
        self.svg += element;
        self.svg.push('\n');
    }

    /// The figure, which shows these values.
    pub(super) fn finish(mut self, values: Values) -> Drawn {
        self.svg += "</svg>\n";
        Drawn { svg: self.svg, csv: values.finish() }
    }
}

/// Places of the marks of a legend to the right of a plot's edge, one below the other.
fn beside(edge: f64, keys: &[Key], layout: Layout) -> Vec<[f64; 2]> {
    (0..keys.len()).map(|it| [edge + 24.0, layout.top + PITCH[0] * (it as f64 + 0.5)]).collect()
}

/// Places of the marks of a legend above a plot, in lines from one edge to the other.
pub(super) fn above([left, edge]: [f64; 2], keys: &[Key], layout: Layout) -> Vec<[f64; 2]> {
    let first = left + 0.5 * MARK;
    let (mut x, mut y) = (first, 0.5 * PITCH[1] + 4.0);
    let place = |key: &Key| {
        let needed = MARK + width(&key.text, layout.text);
        if x > first && x + needed > edge {
            (x, y) = (first, y + PITCH[1]);
        }
        let here = [x, y];
        x += needed + BETWEEN;
        here
    };
    keys.iter().map(place).collect()
}

/// Text as XML holds it; control characters, which it cannot hold, become spaces.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            _ if character.is_control() || matches!(character, '\u{fffe}' | '\u{ffff}') => safe.push(' '),
            _ => safe.push(character),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(text: &str) -> Key {
        Key { mark: String::new(), text: text.into() }
    }

    #[test]
    fn no_title_breaks_the_markup() {
        let around = Around { title: "a < b & \u{0}c > d", right: 20.0, ..Around::default() };
        let svg = Drawing::new(Sheet::Page, around).finish(Values::of([])).svg;
        assert!(svg.contains(">a &lt; b &amp;  c &gt; d</text>"));
    }

    #[test]
    fn the_corners_of_the_plot_are_the_ends_of_the_axes() {
        let axis = Axis::spanning("time [s]", 100.0, 200.0, 10.0);
        let plot = Drawing::new(Sheet::Page, Around::default()).plot;
        assert_eq!((plot.across(&axis, 100.0), plot.across(&axis, 200.0)), (84.0, 804.0));
        assert_eq!((plot.down(&axis, 100.0), plot.down(&axis, 200.0)), (496.0, 56.0));
    }

    #[test]
    fn a_column_has_its_legend_above_the_plot_in_as_many_lines_as_it_needs() {
        let plot = |keys: Vec<Key>| Drawing::new(Sheet::Column, Around { keys, ..Around::default() }).plot;
        assert_eq!(plot(vec![]), Plot { left: 62.0, top: 14.0, right: 466.0, bottom: 244.0 });
        // Two entries of 18 + 161 px fit beside each other, a third does not.
        let twenty = || key("twenty characters so");
        assert_eq!(plot(vec![twenty(), twenty()]).top, 27.5);
        assert_eq!(plot(vec![twenty(), twenty(), twenty()]).top, 46.5);
    }
}
