//! A quantity of areas as colours, and its legend.

use super::super::axes::Axis;
use super::super::colours::{MOST_CLASSES, class_of, classes, colour};
use super::super::drawing::{Anchor, Drawing};
use super::super::drawn::{Values, text, value};
use super::super::escaped;
use super::Area;

/// The colour of an area without a value.
pub(super) const NONE: &str = "#cdd2d8";
/// Height of the legend with and without numbers; position and size of its bar; place of its numbers [px].
const HEIGHTS: [f64; 2] = [62.0, 44.0];
const BAR: [f64; 2] = [28.0, 12.0];
const WIDTH: f64 = 300.0;
const NUMBERS: f64 = 52.0;
/// Maximum of numbers below the bar; width of a digit, and the least space between two numbers [px].
const MOST_NUMBERS: usize = 7;
const DIGIT: f64 = 7.3;
const BETWEEN: f64 = 3.0;
/// The scale reaches up to the value that this share of the ground does not exceed: a few short lanelets with extreme
/// values would else leave one colour to all others. Ours.
const SHARE: f64 = 0.98;

/// The areas that matter: where areas overlap, as at junctions, they lie on top, and their colours are those that
/// stand out from the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnTop {
    /// Those with the highest values.
    Highest,
    /// Those with the lowest values.
    Lowest,
}

/// A quantity of each area, as its colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Shading {
    unit: String,
    none: String,
    on_top: OnTop,
    values: Vec<Option<f64>>,
    scale: Axis,
    /// Whether there are values beyond the scale.
    is_open: bool,
}

impl Shading {
    /// The `quantity` of all `areas` in its `unit`, and what it means if an area has no value.
    pub fn of(
        areas: &[Area],
        [quantity, unit, none]: [&str; 3],
        on_top: OnTop,
        values: Vec<Option<f64>>,
    ) -> Shading {
        let mut known: Vec<(f64, f64)> = areas
            .iter()
            .zip(&values)
            .filter_map(|(area, it)| Some((it.filter(|it| it.is_finite())?, size(area))))
            .collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let wanted = SHARE * known.iter().map(|it| it.1).sum::<f64>();
        let mut so_far = 0.0;
        let reaching = known.iter().find(|it| {
            so_far += it.1;
            so_far >= wanted
        });
        let high = reaching.or(known.last()).map_or(0.0, |it| it.0);
        let scale = Axis::from_zero(&format!("{quantity} [{unit}]"), high, MOST_CLASSES);
        let is_open = known.last().is_some_and(|it| it.0 > scale.to);
        let [unit, none] = [unit, none].map(String::from);
        Shading { unit, none, on_top, values, scale, is_open }
    }

    fn value(&self, area: usize) -> Option<f64> {
        self.values.get(area).copied().flatten().filter(|it| it.is_finite())
    }

    /// The order in which an area is drawn: the same for those of one colour, and 0 for those without a value.
    pub(super) fn rank(&self, area: usize) -> usize {
        match (self.value(area).map(|it| class_of(&self.scale, it)), self.on_top) {
            (None, _) => 0,
            (Some(class), OnTop::Highest) => 1 + class,
            (Some(class), OnTop::Lowest) => classes(&self.scale) - class,
        }
    }

    /// The colour of an area, and its classes in a style sheet.
    pub(super) fn colour(&self, area: usize) -> (&'static str, String) {
        match self.value(area) {
            None => (NONE, "road".into()),
            Some(it) => {
                let (colour, class) = self.colour_of(class_of(&self.scale, it));
                (colour, format!("lane {class}"))
            }
        }
    }

    /// The colour of a class of the scale.
    fn colour_of(&self, class: usize) -> (&'static str, String) {
        let classes = classes(&self.scale);
        match self.on_top {
            OnTop::Lowest => colour(class, classes),
            OnTop::Highest => colour(classes - 1 - class, classes),
        }
    }

    /// What an area says when it is pointed at.
    pub(super) fn title(&self, area: usize, name: &str) -> String {
        let what = match self.value(area) {
            None => self.none.clone(),
            Some(it) => format!("{} {}", value((it * 10.0).round() / 10.0), self.unit),
        };
        escaped(&format!("lanelet {name}: {what}"))
    }

    /// A row for each area.
    pub(super) fn list(&self, areas: &[Area], values: &mut Values) {
        for (number, area) in areas.iter().enumerate() {
            let known = self.value(number).map_or(String::new(), value);
            let nowhere = String::new();
            values.row([
                "lanelet".into(),
                text(&area.name),
                nowhere.clone(),
                nowhere,
                text(&self.scale.label),
                known,
            ]);
        }
    }

    fn has_values(&self) -> bool {
        (0..self.values.len()).any(|it| self.value(it).is_some())
    }

    /// The height of the legend [px].
    pub(super) fn height(&self) -> f64 {
        HEIGHTS[usize::from(!self.has_values())]
    }

    /// The legend, from `left` on.
    pub(super) fn draw_key(&self, drawing: &mut Drawing, left: f64) {
        let has_values = self.has_values();
        let has_none = (0..self.values.len()).any(|it| self.value(it).is_none());
        let classes = classes(&self.scale);
        let [top, height] = BAR;
        drawing.text(left, top - 12.0, Anchor::Start, &self.scale.label);
        if has_values {
            let width = WIDTH / classes as f64;
            for class in 0..classes {
                let (x, (fill, name)) = (left + class as f64 * width, self.colour_of(class));
                drawing.add(&format!(
                    "<rect x=\"{x:.1}\" y=\"{top}\" width=\"{width:.1}\" height=\"{height}\" fill=\"{fill}\" class=\"area {name}\"/>"
                ));
            }
            // With many classes every second or third one has its number, and always the last one. The first number
            // stands half its width to the right.
            let ticks = self.scale.ticks();
            let widest = ticks.iter().map(|it| it.1.len()).max().unwrap_or(0) as f64 * DIGIT;
            let most = MOST_NUMBERS.min((WIDTH / (1.5 * widest + BETWEEN)) as usize);
            let every = (1..=classes).find(|it| classes.is_multiple_of(*it) && classes / it <= most);
            for (number, (at, text)) in ticks.iter().enumerate().step_by(every.unwrap_or(classes)) {
                let x = left + WIDTH * self.scale.share(*at);
                let is_last = number + 1 == ticks.len();
                let text = if is_last && self.is_open { format!("{text}+") } else { text.clone() };
                let anchor = if number == 0 { Anchor::Start } else { Anchor::Middle };
                drawing.text(x, NUMBERS, anchor, &text);
            }
        }
        if has_none {
            let x = if has_values { left + WIDTH + 24.0 } else { left };
            drawing.add(&format!(
                "<rect x=\"{x}\" y=\"{top}\" width=\"{height}\" height=\"{height}\" fill=\"{NONE}\" class=\"road\"/>"
            ));
            drawing.text(x + 18.0, top + 0.5 * height, Anchor::Start, &self.none);
        }
    }
}

/// The size of an area [m²].
fn size(area: &Area) -> f64 {
    let corners = &area.outline;
    let next = corners.iter().cycle().skip(1);
    let twice: f64 = corners.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum();
    0.5 * twice.abs()
}
