//! Distributions side by side, as the outlines of their histograms.

use super::axes::Axis;
use super::drawing::{Around, Drawing};
use super::series::{colour, dashes, line_key};
use super::sheet::Sheet;
use crate::histogram::Histogram;

/// A distribution.
#[derive(Clone, Copy, Debug)]
pub struct Distributed<'a> {
    /// Its name in the legend; none where it is empty.
    pub name: &'a str,
    /// What was counted.
    pub histogram: &'a Histogram,
}

/// Draws for each distribution the share of all its values [%] that lies in each bin; those beyond the last bin count for
/// the whole, and are not seen. Histograms without a value are left out.
pub fn distribution(sheet: Sheet, labels: [&str; 2], all: &[Distributed]) -> String {
    let all: Vec<&Distributed> = all.iter().filter(|it| it.histogram.total() > 0).collect();
    let ends = |it: &&Distributed| it.histogram.range();
    let from = all.iter().map(|it| ends(it)[0]).fold(f64::INFINITY, f64::min);
    let to = all.iter().map(|it| ends(it)[1]).fold(f64::NEG_INFINITY, f64::max);
    let percent = |it: &Distributed| it.histogram.shares().map(|it| 100.0 * it).collect::<Vec<f64>>();
    let highest = all.iter().flat_map(|it| percent(it)).fold(0.0, f64::max);
    let [across, upwards] = sheet.layout().steps;
    let x = Axis::spanning(labels[0], from, to, across);
    let y = Axis::from_zero(labels[1], highest, upwards);

    let named = all.iter().enumerate().filter(|(_, it)| !it.name.is_empty());
    let keys = named.map(|(index, it)| line_key(it.name, index)).collect();
    let mut drawing = Drawing::new(sheet, Around { keys, ..Around::default() });
    drawing.axes(&x, &y);
    let plot = drawing.plot;
    for (index, it) in all.iter().enumerate() {
        let [mut at, _] = it.histogram.range();
        let mut path = format!("M{:.1} {:.1}", plot.across(&x, at), plot.bottom);
        for share in percent(it) {
            at += it.histogram.width();
            path += &format!("V{:.1}H{:.1}", plot.down(&y, share), plot.across(&x, at));
        }
        path += &format!("V{:.1}", plot.bottom);
        let ((colour, class), dashes) = (colour(index), dashes(index));
        drawing.add(&format!(
            "<g fill=\"none\" stroke=\"{colour}\" class=\"{class}\"><path d=\"{path}\" stroke-width=\"1.6\" \
             stroke-linejoin=\"round\"{dashes}/></g>"
        ));
    }
    drawing.frame();
    drawing.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LABELS: [&str; 2] = ["time headway [s]", "share of samples [%]"];

    #[test]
    fn each_bin_is_as_high_as_its_share() {
        // The plot from (62, 25.5) to (466, 255.5) px; 0 … 4 s, 0 … 50 %.
        let mut histogram = Histogram::new(0.0, 1.0, 4);
        [0.5, 1.5, 1.7, 9.0].into_iter().for_each(|it| histogram.add(it));
        let svg = distribution(Sheet::Column, LABELS, &[Distributed { name: "cars", histogram: &histogram }]);
        let expected = "d=\"M62.0 255.5V140.5H163.0V25.5H264.0V255.5H365.0V255.5H466.0V255.5\"";
        assert!(svg.contains(expected), "{svg}");
        for text in [LABELS[0], LABELS[1], "cars"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
    }

    #[test]
    fn an_empty_distribution_is_left_out() {
        let (empty, mut full) = (Histogram::new(0.0, 1.0, 4), Histogram::new(0.0, 1.0, 4));
        full.add(1.0);
        let [empty, full] =
            [("none", &empty), ("some", &full)].map(|(name, histogram)| Distributed { name, histogram });
        assert_eq!(
            distribution(Sheet::Column, LABELS, &[empty, full]),
            distribution(Sheet::Column, LABELS, &[full])
        );
        assert!(distribution(Sheet::Column, LABELS, &[]).contains("0.2</text>"));
    }
}
