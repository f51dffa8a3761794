//! An SVG page with a title, a frame, a grid and labelled axes.

use super::axes::Axis;

/// Edges of the plot [px].
pub(super) const LEFT: f64 = 84.0;
pub(super) const TOP: f64 = 56.0;
pub(super) const RIGHT: f64 = 804.0;
pub(super) const BOTTOM: f64 = 496.0;
/// Height of the page [px].
const HEIGHT: f64 = 560.0;

const TITLE_SIZE: f64 = 18.0;
const TEXT_SIZE: f64 = 14.0;
/// From the middle of a text to its base line, in text sizes.
const MIDDLE_TO_BASE: f64 = 0.35;
/// Width of a character, in text sizes: an upper estimate of the mean.
const CHARACTER_WIDTH: f64 = 0.62;

/// Where a text stands relative to its point.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A page under construction.
pub(super) struct Drawing {
    svg: String,
}

/// Width that a text of the usual size needs in a figure, about [px].
pub fn text_width(text: &str) -> f64 {
    text.chars().count() as f64 * CHARACTER_WIDTH * TEXT_SIZE
}

/// Horizontal place of a value on the page [px].
pub(super) fn across(axis: &Axis, value: f64) -> f64 {
    LEFT + axis.share(value) * (RIGHT - LEFT)
}

/// Vertical place of a value on the page [px].
pub(super) fn down(axis: &Axis, value: f64) -> f64 {
    BOTTOM - axis.share(value) * (BOTTOM - TOP)
}

impl Drawing {
    /// A page with its title, and `margin` [px] to the right of the plot.
    pub(super) fn new(title: &str, margin: f64) -> Drawing {
        let width = RIGHT + margin;
        let mut page = Drawing {
            svg: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {HEIGHT}\" width=\"{width:.0}\" \
                 height=\"{HEIGHT}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{TEXT_SIZE}\">\n\
                 <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
            ),
        };
        // A long title is set smaller rather than cut off.
        let characters = title.chars().count().max(1) as f64;
        let size = TITLE_SIZE.min((RIGHT + margin - LEFT) / (characters * CHARACTER_WIDTH));
        let text = escaped(title);
        page.add(&format!("<text x=\"{LEFT}\" y=\"34\" font-size=\"{size:.1}\">{text}</text>"));
        page
    }

    /// Grid, frame, ticks and labels of both axes.
    pub(super) fn axes(&mut self, x: &Axis, y: &Axis) {
        let mut grid = String::new();
        for (value, _) in x.ticks() {
            grid += &format!("M{:.1} {TOP}V{BOTTOM}", across(x, value));
        }
        for (value, _) in y.ticks() {
            grid += &format!("M{LEFT} {:.1}H{RIGHT}", down(y, value));
        }
        self.add(&format!("<path d=\"{grid}\" stroke=\"#e2e2e2\" fill=\"none\"/>"));
        for (value, text) in x.ticks() {
            self.text(across(x, value), BOTTOM + 18.0, Anchor::Middle, &text);
        }
        for (value, text) in y.ticks() {
            self.text(LEFT - 8.0, down(y, value), Anchor::End, &text);
        }
        self.text((LEFT + RIGHT) / 2.0, BOTTOM + 44.0, Anchor::Middle, x.label);
        self.upright_text(24.0, y.label);
    }

    /// The frame, to be drawn over the data.
    pub(super) fn frame(&mut self) {
        let (width, height) = (RIGHT - LEFT, BOTTOM - TOP);
        self.add(&format!(
            "<rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#404040\"/>"
        ));
    }

    /// A text whose middle line goes through (x, y) [px].
    pub(super) fn text(&mut self, x: f64, y: f64, anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (y, text) = (y + MIDDLE_TO_BASE * TEXT_SIZE, escaped(text));
        self.add(&format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"));
    }

    /// A text that reads upwards, in the middle of the plot's height.
    pub(super) fn upright_text(&mut self, x: f64, text: &str) {
        let (y, text) = ((TOP + BOTTOM) / 2.0, escaped(text));
        self.add(&format!(
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\">{text}</text>"
        ));
    }

    /// An element as it stands.
    pub(super) fn add(&mut self, element: &str) {
        self.svg += element;
        self.svg.push('\n');
    }

    /// The SVG text.
    pub(super) fn finish(mut self) -> String {
        self.svg += "</svg>\n";
        self.svg
    }
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

    #[test]
    fn no_title_breaks_the_markup() {
        let svg = Drawing::new("a < b & \u{0}c > d", 20.0).finish();
        assert!(svg.contains(">a &lt; b &amp;  c &gt; d</text>"));
    }

    #[test]
    fn the_corners_of_the_plot_are_the_ends_of_the_axes() {
        let axis = Axis::spanning("time [s]", 100.0, 200.0);
        assert_eq!((across(&axis, 100.0), across(&axis, 200.0)), (LEFT, RIGHT));
        assert_eq!((down(&axis, 100.0), down(&axis, 200.0)), (BOTTOM, TOP));
    }
}
