//! The scale of colours for quantities: the same in all figures, for all eyes, and on light and dark pages.
//!
//! The lightness of the colours rises steadily (viridis, without its lightest fifth, which is faint on white), so that
//! they are in order for colour-blind readers, too, and in print without colours. Each has a class, `c0` to `c9`, by
//! which a style sheet gives it another one on a dark page.

use super::axes::Axis;

/// Colours from the lowest to the highest class.
const COLOURS: [&str; 10] = [
    "#440154", "#482071", "#433d83", "#39568b", "#2f6d8e", "#26838d", "#219989", "#2aad80", "#4ac16d",
    "#7ad151",
];
/// Maximum of classes of a scale.
pub(super) const MOST_CLASSES: f64 = COLOURS.len() as f64;

/// Number of classes of a scale: one between any two ticks.
pub(super) fn classes(scale: &Axis) -> usize {
    ((scale.to / scale.step()).round() as usize).clamp(1, COLOURS.len())
}

/// The class of a value; values beyond the ends belong to the last and to the first one.
pub(super) fn class_of(scale: &Axis, value: f64) -> usize {
    ((value / scale.step()) as usize).min(classes(scale) - 1)
}

/// The colour of a class of so many, and its name in a style sheet.
pub(super) fn colour(class: usize, classes: usize) -> (&'static str, String) {
    let last = COLOURS.len() - 1;
    let place = if classes > 1 { (class * last + (classes - 1) / 2) / (classes - 1) } else { last };
    let place = place.min(last);
    (COLOURS[place], format!("c{place}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_classes_of_every_scale_have_different_colours_from_end_to_end() {
        for classes in 2..=COLOURS.len() {
            let places: Vec<&str> = (0..classes).map(|it| colour(it, classes).0).collect();
            let mut distinct = places.clone();
            distinct.dedup();
            assert_eq!(distinct.len(), classes, "{places:?}");
            assert_eq!((places[0], places[classes - 1]), (COLOURS[0], COLOURS[9]));
        }
    }

    #[test]
    fn a_value_belongs_to_the_class_between_its_ticks() {
        let scale = Axis::from_zero("Speed [km/h]", 50.0, MOST_CLASSES);
        assert_eq!(classes(&scale), 10);
        assert_eq!([0.0, 4.9, 5.0, 49.0, 80.0].map(|it| class_of(&scale, it)), [0, 0, 1, 9, 9]);
    }

    /// Relative luminance after WCAG 2.
    fn luminance(colour: &str) -> f64 {
        let part = |at: usize| {
            let it = f64::from(u8::from_str_radix(&colour[at..at + 2], 16).unwrap()) / 255.0;
            if it <= 0.03928 { it / 12.92 } else { ((it + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
    }

    #[test]
    fn lightness_rises_from_class_to_class() {
        let all = COLOURS.map(luminance);
        assert!(all.windows(2).all(|it| it[0] < it[1]), "{all:?}");
    }
}
