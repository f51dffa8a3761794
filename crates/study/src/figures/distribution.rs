//! Distributions side by side, as the outlines of their histograms.

use super::axes::Axis;
use super::drawing::{Around, Drawing};
use super::drawn::{Drawn, Values, text, value};
use super::series::{colour, dashes, line_key};
use super::sheet::Sheet;
use crate::histogram::Histogram;

/// A distribution.
#[derive(Clone, Copy, Debug)]
pub struct Distributed<'a> {
    /// Its name in the legend; empty: none.
    pub name: &'a str,
    /// What was counted.
    pub histogram: &'a Histogram,
}

/// The scale of the shares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Upwards {
    /// Linear, from zero on.
    Linear,
    /// Logarithmic, so that rare values are visible, too; empty bins stand at the bottom.
    Logarithmic,
}

/// Minimum share on a logarithmic axis [%].
const LEAST_SHARE: f64 = 0.001;

/// Draws for each distribution the share of all its values [%] that lies in each bin. Values outside the bins count
/// for the whole, but are not drawn. Histograms without a value are left out.
pub fn distribution(sheet: Sheet, labels: [&str; 2], upwards: Upwards, all: &[Distributed]) -> Drawn {
    let all: Vec<&Distributed> = all.iter().filter(|it| it.histogram.total() > 0).collect();
    let ends = |it: &&Distributed| it.histogram.range();
    let from = all.iter().map(|it| ends(it)[0]).fold(f64::INFINITY, f64::min);
    let to = all.iter().map(|it| ends(it)[1]).fold(f64::NEG_INFINITY, f64::max);
    let percent = |it: &Distributed| it.histogram.shares().map(|it| 100.0 * it).collect::<Vec<f64>>();
    let shares: Vec<f64> = all.iter().flat_map(|it| percent(it)).filter(|it| *it > 0.0).collect();
    let highest = shares.iter().copied().fold(0.0, f64::max);
    let layout = sheet.layout();
    let x = Axis::spanning(labels[0], from, to, layout.steps[0]);
    let y = match upwards {
        Upwards::Linear => Axis::from_zero(labels[1], highest, layout.steps[1]),
        Upwards::Logarithmic => {
            let lowest = shares.iter().copied().fold(f64::INFINITY, f64::min);
            Axis::decades(labels[1], lowest.max(LEAST_SHARE), highest)
        }
    };

    let named = all.iter().enumerate().filter(|(_, it)| !it.name.is_empty());
    let keys = named.map(|(index, it)| line_key(it.name, index)).collect();
    let mut drawing = Drawing::new(sheet, Around { keys, ..Around::default() });
    drawing.axes(&x, &y);
    let plot = drawing.plot;
    let mut values = Values::of(["series", labels[0], "to", labels[1]]);
    for (index, it) in all.iter().enumerate() {
        let [mut at, _] = it.histogram.range();
        let mut path = format!("M{:.1} {:.1}", plot.across(&x, at), plot.bottom);
        for share in percent(it) {
            let from = at;
            at += it.histogram.width();
            let cells = [from, at, share].map(value);
            values.row([text(it.name)].into_iter().chain(cells));
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
    drawing.finish(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LABELS: [&str; 2] = ["time headway [s]", "share of samples [%]"];

    #[test]
    fn each_bin_is_as_high_as_its_share() {
        // The plot from (62, 27.5) to (466, 257.5) px; 0 … 4 s, 0 … 50 %.
        let mut histogram = Histogram::new(0.0, 1.0, 4);
        [0.5, 1.5, 1.7, 9.0].into_iter().for_each(|it| histogram.add(it));
        let svg = distribution(
            Sheet::Column,
            LABELS,
            Upwards::Linear,
            &[Distributed { name: "cars", histogram: &histogram }],
        )
        .svg;
        let expected = "d=\"M62.0 257.5V142.5H163.0V27.5H264.0V257.5H365.0V257.5H466.0V257.5\"";
        assert!(svg.contains(expected), "{svg}");
        for text in [LABELS[0], LABELS[1], "cars"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
    }

    #[test]
    fn what_is_rare_is_seen_on_a_logarithmic_axis() {
        // 1 … 100 %: a half is 0.849485 of the height of 230 px, from 244 px upwards.
        let mut histogram = Histogram::new(0.0, 1.0, 4);
        [0.5, 1.5].into_iter().for_each(|it| histogram.add(it));
        let only = Distributed { name: "", histogram: &histogram };
        let svg = distribution(Sheet::Column, LABELS, Upwards::Logarithmic, &[only]).svg;
        assert!(
            svg.contains("d=\"M62.0 244.0V83.2H163.0V83.2H264.0V244.0H365.0V244.0H466.0V244.0\""),
            "{svg}"
        );
    }

    #[test]
    fn an_empty_distribution_is_left_out() {
        let (empty, mut full) = (Histogram::new(0.0, 1.0, 4), Histogram::new(0.0, 1.0, 4));
        full.add(1.0);
        let [empty, full] =
            [("none", &empty), ("some", &full)].map(|(name, histogram)| Distributed { name, histogram });
        assert_eq!(
            distribution(Sheet::Column, LABELS, Upwards::Linear, &[empty, full]).svg,
            distribution(Sheet::Column, LABELS, Upwards::Linear, &[full]).svg
        );
        assert!(distribution(Sheet::Column, LABELS, Upwards::Linear, &[]).svg.contains("0.2</text>"));
    }
}
