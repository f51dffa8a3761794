//! One part of a plan on the page, drawn to scale.

use std::fmt::Write as _;

use super::bounds::Bounds;
use super::parts::parts;

/// Longest scale bar, and longest upright one [px].
const LONGEST_BAR: f64 = 160.0;
const HIGHEST_BAR: f64 = 26.0;
/// Space below a part for the scale [px].
const FOOT: f64 = 34.0;
/// Maximum of parts; with more, a plan is drawn as one.
const MOST_PANELS: usize = 8;
/// A point is visible at this distance from the straight line between its neighbours [px].
const VISIBLE: f64 = 0.15;

/// The space for a plan on a page [px].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Space {
    /// Width of the page.
    pub width: f64,
    /// Around panels.
    pub margin: f64,
    /// Where the panels begin.
    pub top: f64,
    /// Maximum height of the panel of a page with one, and of those with several.
    pub heights: [f64; 2],
    /// Minimum extent of a part: a long road without bends is drawn wider than to scale. 0: everything is to scale.
    pub least: f64,
}

/// A part of a plan, and its position on the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Indices of its members.
    pub members: Vec<usize>,
    /// The rectangle around them.
    pub bounds: Bounds,
    /// Upper left corner and width [px].
    left: f64,
    top: f64,
    width: f64,
    /// Pixels per metre, from west to east and from south to north.
    scale: [f64; 2],
}

/// The panels of a plan with these members, one or two side by side, and the position of their lower end [px].
pub fn panels(members: &[Bounds], space: Space) -> (Vec<Panel>, f64) {
    let mut parts = parts(members);
    if parts.len() > MOST_PANELS {
        let all = parts.drain(..).reduce(|(around, mut members), (bounds, others)| {
            members.extend(others);
            (around.with(bounds), members)
        });
        parts.extend(all);
    }
    let columns = parts.len().clamp(1, 2);
    let width = (space.width - space.margin * (1.0 + columns as f64)) / columns as f64;
    let size = [width, space.heights[columns - 1]];
    let mut panels: Vec<Panel> = parts.into_iter().map(|part| Panel::new(part, size, space.least)).collect();
    let mut top = space.top;
    for row in panels.chunks_mut(columns) {
        let height = row.iter().map(Panel::height).fold(0.0, f64::max);
        for (column, panel) in row.iter_mut().enumerate() {
            panel.left = space.margin + column as f64 * (width + space.margin);
            panel.top = top;
        }
        top += height + space.margin;
    }
    (panels, top)
}

impl Panel {
    /// A panel `width` wide and at most `height` high, no part of which is smaller than `least` [px].
    fn new((bounds, members): (Bounds, Vec<usize>), [width, height]: [f64; 2], least: f64) -> Panel {
        let [across, down] = bounds.size().map(|it| it.max(1.0));
        let scale = (width / across).min(height / down);
        let scale = [across, down].map(|it| scale.max(least / it));
        Panel { members, bounds, left: 0.0, top: 0.0, width, scale }
    }

    /// The height that it needs [px].
    fn height(&self) -> f64 {
        self.scale[1] * self.bounds.size()[1] + FOOT
    }

    /// Pixels per metre, from west to east and from south to north.
    pub fn scale(&self) -> [f64; 2] {
        self.scale
    }

    /// The place of a point of the plan [m] on the page [px].
    pub fn place(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        let [across, _] = self.bounds.size();
        let left = self.left + (self.width - self.scale[0] * across) / 2.0;
        (
            left + self.scale[0] * (x - self.bounds.low[0]),
            self.top + self.scale[1] * (self.bounds.high[1] - y),
        )
    }

    /// The places of points along a line, without those that cannot be seen.
    pub fn visible(&self, points: impl IntoIterator<Item = [f64; 2]>) -> Vec<(f64, f64)> {
        let places: Vec<(f64, f64)> = points.into_iter().map(|it| self.place(it)).collect();
        let mut seen: Vec<(f64, f64)> = Vec::new();
        for (index, (x, y)) in places.iter().copied().enumerate() {
            let last = seen.last().copied();
            let straight = last.zip(places.get(index + 1)).map(|((x0, y0), (x1, y1)): ((f64, f64), _)| {
                let (dx, dy) = (x1 - x0, y1 - y0);
                (dx * (y - y0) - dy * (x - x0)).abs() < VISIBLE * dx.hypot(dy)
            });
            if straight != Some(true) {
                seen.push((x, y));
            }
        }
        seen
    }

    /// The path along points as SVG, without those that cannot be seen.
    pub fn path(&self, points: impl IntoIterator<Item = [f64; 2]>) -> String {
        let mut path = String::new();
        for (x, y) in self.visible(points) {
            // Writing to a string never fails.
            let _ = write!(path, "{}{x:.1} {y:.1}", if path.is_empty() { "M" } else { "L" });
        }
        path
    }

    /// A bar of round length below the right of the part as SVG; where the scales differ also an upright one below its
    /// left.
    pub fn bar(&self) -> String {
        let length = round_length(self.scale[0], LONGEST_BAR);
        let end = self.left + self.width;
        let (x, y) = (end - length * self.scale[0], self.top + self.height() - 14.0);
        let (tick, base) = (y - 5.0, y + 14.0);
        let level = format!(
            "<path d=\"M{x:.1} {tick:.1}V{y:.1}H{end:.1}V{tick:.1}\" fill=\"none\" stroke=\"black\"/>\
             <text x=\"{end:.1}\" y=\"{base:.1}\" text-anchor=\"end\">{length} m</text>\n"
        );
        if self.scale[0] == self.scale[1] {
            return level;
        }
        let (left, low) = (self.left, self.top + self.height() - 2.0);
        let upright = round_length(self.scale[1], HIGHEST_BAR);
        let high = low - upright * self.scale[1];
        let (cap, text, middle) = (left + 5.0, left + 10.0, (low + high) / 2.0 + 5.0);
        level
            + &format!(
                "<path d=\"M{cap:.1} {low:.1}H{left:.1}V{high:.1}H{cap:.1}\" fill=\"none\" stroke=\"black\"/>\
                 <text x=\"{text:.1}\" y=\"{middle:.1}\">{upright} m</text>\n"
            )
    }
}

/// The longest round length of a bar [m] at this scale [px/m] that is not longer than this [px].
fn round_length(scale: f64, longest: f64) -> f64 {
    let metres = [5000.0, 2000.0, 1000.0, 500.0, 200.0, 100.0, 50.0, 20.0, 10.0, 5.0, 2.0];
    metres.into_iter().find(|it| it * scale <= longest).unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACE: Space =
        Space { width: 480.0, margin: 14.0, top: 50.0, heights: [400.0, 300.0], least: 60.0 };

    fn only(size: [f64; 2], space: Space) -> (Panel, f64) {
        let (mut panels, bottom) = panels(&[Bounds { low: [0.0; 2], high: size }], space);
        (panels.remove(0), bottom)
    }

    #[test]
    fn a_part_is_to_scale_and_has_its_bar_below() {
        // 452 px for 226 m; 100 m high: 200 px, and 34 px for the bar.
        let (panel, bottom) = only([226.0, 100.0], SPACE);
        assert_eq!(panel.scale(), [2.0, 2.0]);
        assert_eq!((panel.place([0.0, 100.0]), panel.place([226.0, 0.0])), ((14.0, 50.0), (466.0, 250.0)));
        assert_eq!(bottom, 50.0 + 234.0 + 14.0);
        assert!(panel.bar().contains(">50 m<") && panel.bar().contains("M366.0 265.0V270.0H466.0V265.0"));
    }

    #[test]
    fn a_long_road_is_wider_than_to_scale_and_says_so_with_a_second_bar() {
        let (panel, _) = only([4520.0, 12.0], SPACE);
        assert_eq!(panel.scale(), [0.1, 5.0]);
        assert!(panel.bar().contains(">1000 m<") && panel.bar().contains(">5 m<"), "{}", panel.bar());
        let (panel, _) = only([4520.0, 12.0], Space { least: 0.0, ..SPACE });
        assert_eq!(panel.scale(), [0.1, 0.1]);
        assert_eq!(panel.bar().matches("<text").count(), 1);
    }

    #[test]
    fn points_on_a_straight_line_are_left_out() {
        let (panel, _) = only([226.0, 100.0], SPACE);
        let line = [[0.0, 0.0], [50.0, 0.01], [100.0, 0.0], [100.0, 50.0]];
        assert_eq!(panel.path(line), "M14.0 250.0L214.0 250.0L214.0 150.0");
    }
}
