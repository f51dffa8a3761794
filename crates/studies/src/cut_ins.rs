//! Cut-ins by speed: how short the gaps are, and how fast they close.

use std::fmt::Write;

use laneweave_recordings::CutIn;
use laneweave_study::quantile;
use laneweave_study::units::KMH_PER_MPS;
use serde::Serialize;

/// Where classes of speed begin [km/h].
const CLASSES: [f64; 4] = [0.0, 30.0, 60.0, 90.0];
/// The shares of cut-ins that are shorter, and that close faster.
const SHARES: [f64; 3] = [0.01, 0.05, 0.5];
/// Times to collision below this are short [s].
const SHORT: f64 = 3.0;

/// The cut-ins in one class of speed. Fields are added, never renamed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CutInsAt {
    /// Least speed of the follower [km/h]; the class ends where the next one begins.
    pub speed_from_kmh: f64,
    /// How many there were.
    pub cut_ins: usize,
    /// Gaps that 1, 5 and 50 % of them are below [m].
    pub gap_m: Option<[f64; 3]>,
    /// The same of the time in which the follower drives the gap [s].
    pub headway_s: Option<[f64; 3]>,
    /// The inverse times to collision that 1, 5 and 50 % of them are above [1/s]; 0: the gap does not close.
    pub inverse_ttc_per_s: Option<[f64; 3]>,
    /// How many had a time to collision below 3 s.
    pub ttc_below_3s: usize,
}

/// `cut_ins` by the speed of the follower.
pub fn cut_ins_by_speed(cut_ins: &[CutIn]) -> Vec<CutInsAt> {
    let ends = CLASSES.iter().skip(1).copied().chain([f64::INFINITY]);
    CLASSES.iter().zip(ends).map(|(from, end)| of_class(cut_ins, *from, end)).collect()
}

fn of_class(cut_ins: &[CutIn], from: f64, end: f64) -> CutInsAt {
    let of_class: Vec<&CutIn> =
        cut_ins.iter().filter(|it| (from..end).contains(&(it.follower_speed * KMH_PER_MPS))).collect();
    let quantiles = |shares: [f64; 3], of: fn(&CutIn) -> f64| {
        let values: Vec<f64> = of_class.iter().map(|it| of(it)).collect();
        let [one, five, half] =
            shares.map(|it| quantile(&values, it).map(|it| (it * 1000.0).round() / 1000.0));
        Some([one?, five?, half?])
    };
    CutInsAt {
        speed_from_kmh: from,
        cut_ins: of_class.len(),
        gap_m: quantiles(SHARES, |it| it.gap),
        headway_s: quantiles(SHARES, CutIn::headway),
        inverse_ttc_per_s: quantiles(SHARES.map(|it| 1.0 - it), CutIn::inverse_time_to_collision),
        ttc_below_3s: of_class.iter().filter(|it| it.inverse_time_to_collision() * SHORT > 1.0).count(),
    }
}

/// The table in words.
pub(crate) fn write_cut_ins(classes: &[CutInsAt], out: &mut String) -> std::fmt::Result {
    if classes.iter().all(|it| it.cut_ins == 0) {
        return Ok(());
    }
    writeln!(out, "\ncut-ins (a follower within 4 s), and what 1, 5 and 50 % of them are beyond")?;
    writeln!(
        out,
        "  speed [km/h]   cut-ins            gap [m]        headway [s]          1/TTC [1/s]   TTC < 3 s"
    )?;
    let ends = classes.iter().skip(1).map(|it| format!("to {}", it.speed_from_kmh));
    for (it, end) in classes.iter().zip(ends.chain(["and more".to_owned()])) {
        let cells = |values: Option<[f64; 3]>, digits: usize| match values {
            Some([one, five, half]) => format!("{one:.digits$} {five:.digits$} {half:.digits$}"),
            None => String::new(),
        };
        writeln!(
            out,
            "  {:>3} {end:<8} {:9} {:>18} {:>18} {:>20} {:11}",
            it.speed_from_kmh,
            it.cut_ins,
            cells(it.gap_m, 1),
            cells(it.headway_s, 2),
            cells(it.inverse_ttc_per_s, 3),
            it.ttc_below_3s
        )?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut_in(gap: f64, follower_speed: f64, speed: f64) -> CutIn {
        CutIn { vehicle: 1, follower: 2, time: 0.0, gap, follower_speed, speed }
    }

    #[test]
    fn cut_ins_are_counted_by_the_speed_of_the_follower_with_their_quantiles() {
        // 101 gaps from 10 to 110 m behind a follower at 36 km/h, of which the first closes at 5 m/s.
        let mut all: Vec<CutIn> = (0..=100).map(|it| cut_in(10.0 + f64::from(it), 10.0, 12.0)).collect();
        all[0].speed = 5.0;
        all.push(cut_in(20.0, 25.0, 25.0));
        let classes = cut_ins_by_speed(&all);
        assert_eq!(classes.iter().map(|it| it.cut_ins).collect::<Vec<_>>(), [0, 101, 0, 1]);
        assert_eq!(classes[1].gap_m, Some([11.0, 15.0, 60.0]));
        assert_eq!(classes[1].headway_s, Some([1.1, 1.5, 6.0]));
        // One in 101 closes, in 2 s: the value that 1 % are above is the next one.
        assert_eq!(classes[1].inverse_ttc_per_s, Some([0.0, 0.0, 0.0]));
        assert_eq!(classes.iter().map(|it| it.ttc_below_3s).collect::<Vec<_>>(), [0, 1, 0, 0]);
        assert_eq!(classes[0].gap_m, None);
        assert_eq!(classes[3].inverse_ttc_per_s, Some([0.0; 3]));
        let mut text = String::new();
        write_cut_ins(&classes, &mut text).unwrap();
        assert!(text.contains("30 to 60          101     11.0 15.0 60.0"), "{text}");
    }

    #[test]
    fn without_cut_ins_nothing_is_written() {
        let mut text = String::new();
        write_cut_ins(&cut_ins_by_speed(&[]), &mut text).unwrap();
        assert_eq!(text, "");
    }
}
