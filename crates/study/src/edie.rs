//! Density, flow and speed by Edie's generalised definitions, over boxes in space and time.
//!
//! Edie (1963), Discussion of traffic stream measurements and definitions. In a box of length L and duration T
//! in which vehicles spend the total time Σt and cover the total distance Σd:
//!
//! k = Σt / (L T),  q = Σd / (L T),  v = Σd / Σt = q / k

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::units::{METRES_PER_KM, SECONDS_PER_HOUR};

/// The observed time: consecutive intervals of equal duration. Events outside are not counted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Window {
    /// Begin of the first interval [s].
    pub from_s: f64,
    /// Duration of an interval [s].
    pub interval_s: f64,
    /// Number of intervals.
    pub intervals: usize,
}

/// Why boxes cannot be laid out.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EdieError {
    /// The window has no begin or no duration.
    #[error("an interval of {interval_s} s from {from_s} s on: not a finite begin and a positive duration")]
    Window {
        /// Its begin [s].
        from_s: f64,
        /// Its duration [s].
        interval_s: f64,
    },
    /// A section has no length.
    #[error("section {section}: length {length_m} m is not a positive number")]
    Length {
        /// Index of the section.
        section: usize,
        /// Its length [m].
        length_m: f64,
    },
}

/// Boxes of road sections × intervals, and the traffic in them.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct EdieGrid {
    window: Window,
    lengths_m: Vec<f64>,
    /// Section by section.
    boxes: Vec<Totals>,
}

/// The traffic in one box.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Totals {
    /// Σt: time spent by all vehicles [s].
    time_s: f64,
    /// Σd: distance covered by all vehicles [m].
    distance_m: f64,
    /// n: lane changes.
    changes: u64,
}

/// The measures of one box. If a section's length is that of all its lanes together, the measures are per lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdieRow {
    /// Index of the section.
    pub section: usize,
    /// Begin of the interval [s].
    pub from_s: f64,
    /// L T: size of the box [km h].
    pub exposure_km_h: f64,
    /// k: density [veh/km].
    pub density_veh_per_km: f64,
    /// q: flow [veh/h].
    pub flow_veh_per_h: f64,
    /// v: space-mean speed [m/s]; unknown where no vehicle was.
    pub speed_mps: Option<f64>,
    /// n: lane changes.
    pub changes: u64,
    /// r = n / (L T): lane-change rate [1/(km h)].
    pub rate_per_km_h: f64,
}

impl EdieGrid {
    /// Empty boxes over sections of the given lengths [m].
    ///
    /// # Errors
    /// If a length or the interval is not a positive number, or the window's begin is not finite.
    pub fn new(lengths_m: Vec<f64>, window: Window) -> Result<EdieGrid, EdieError> {
        let Window { from_s, interval_s, intervals } = window;
        if !(from_s.is_finite() && is_positive(interval_s)) {
            return Err(EdieError::Window { from_s, interval_s });
        }
        if let Some(section) = lengths_m.iter().position(|it| !is_positive(*it)) {
            return Err(EdieError::Length { section, length_m: lengths_m[section] });
        }
        let boxes = vec![Totals::default(); lengths_m.len() * intervals];
        Ok(EdieGrid { window, lengths_m, boxes })
    }

    /// Whether it may be `new` with traffic: the same sections and intervals.
    pub fn fits(&self, new: &EdieGrid) -> bool {
        let laid_out = |it: &EdieGrid| (it.window, it.boxes.len());
        laid_out(self) == laid_out(new) && self.lengths_m == new.lengths_m
    }

    /// Adds a piece of a trajectory: from `time_s` on, a vehicle was on the section for `duration_s` and covered
    /// `distance_m` there. A piece across several intervals is shared as at constant speed.
    ///
    /// # Panics
    /// If there is no such section.
    pub fn add(&mut self, section: usize, time_s: f64, duration_s: f64, distance_m: f64) {
        self.add_all(section, time_s, duration_s, 1, distance_m);
    }

    /// The same for `vehicles` that were on the section at the same time and covered `distance_m` together.
    ///
    /// # Panics
    /// If there is no such section.
    pub fn add_all(&mut self, section: usize, time_s: f64, duration_s: f64, vehicles: u32, distance_m: f64) {
        let begin = self.in_intervals(time_s);
        let end = begin + duration_s / self.window.interval_s;
        if !(begin.is_finite() && end.is_finite() && end > begin && distance_m.is_finite()) {
            return;
        }
        let duration_s = f64::from(vehicles) * duration_s;
        let first = begin.max(0.0) as usize;
        if begin >= 0.0 && end <= (first + 1) as f64 && first < self.window.intervals {
            // Like most pieces, it lies within one interval.
            let totals = self.totals(section, first);
            totals.time_s += duration_s;
            totals.distance_m += distance_m;
            return;
        }
        let beyond = end.min(self.window.intervals as f64).ceil() as usize;
        for interval in first..beyond {
            let share = (end.min((interval + 1) as f64) - begin.max(interval as f64)) / (end - begin);
            let totals = self.totals(section, interval);
            totals.time_s += share * duration_s;
            totals.distance_m += share * distance_m;
        }
    }

    /// Counts a lane change on the section at `time_s`.
    ///
    /// # Panics
    /// If there is no such section.
    pub fn change(&mut self, section: usize, time_s: f64) {
        let at = self.in_intervals(time_s);
        if at >= 0.0 && at < self.window.intervals as f64 {
            self.totals(section, at as usize).changes += 1;
        }
    }

    /// The measures of all boxes, the empty ones too: section by section, in order of time.
    pub fn rows(&self) -> impl Iterator<Item = EdieRow> + '_ {
        let cells = (0..self.lengths_m.len())
            .flat_map(|section| (0..self.window.intervals).map(move |interval| (section, interval)));
        cells.zip(&self.boxes).map(|((section, interval), totals)| self.row(section, interval, totals))
    }

    fn row(&self, section: usize, interval: usize, totals: &Totals) -> EdieRow {
        let Window { from_s, interval_s, .. } = self.window;
        let size_m_s = self.lengths_m[section] * interval_s;
        let exposure_km_h = size_m_s / (METRES_PER_KM * SECONDS_PER_HOUR);
        EdieRow {
            section,
            from_s: from_s + interval as f64 * interval_s,
            exposure_km_h,
            density_veh_per_km: totals.time_s / size_m_s * METRES_PER_KM,
            flow_veh_per_h: totals.distance_m / size_m_s * SECONDS_PER_HOUR,
            speed_mps: (totals.time_s > 0.0).then(|| totals.distance_m / totals.time_s),
            changes: totals.changes,
            rate_per_km_h: totals.changes as f64 / exposure_km_h,
        }
    }

    fn totals(&mut self, section: usize, interval: usize) -> &mut Totals {
        &mut self.boxes[section * self.window.intervals + interval]
    }

    /// Time since the window's begin, in intervals.
    fn in_intervals(&self, time_s: f64) -> f64 {
        (time_s - self.window.from_s) / self.window.interval_s
    }
}

fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const MINUTES: Window = Window { from_s: 0.0, interval_s: 60.0, intervals: 10 };

    fn rows(grid: &EdieGrid) -> Vec<EdieRow> {
        grid.rows().collect()
    }

    #[test]
    fn ten_vehicles_that_cross_a_section_at_20_mps_are_a_flow_of_600_and_a_density_of_25_thirds() {
        // Each spends 25 s on 500 m of a box of 500 m × 60 s.
        let mut grid = EdieGrid::new(vec![500.0], MINUTES).unwrap();
        (0..10).for_each(|i| grid.add(0, f64::from(i), 25.0, 500.0));
        let row = rows(&grid)[0];
        assert_eq!(row.flow_veh_per_h, 600.0);
        assert!((row.density_veh_per_km - 25.0 / 3.0).abs() < 1e-12);
        assert_eq!(row.speed_mps, Some(20.0));
    }

    #[test]
    fn standing_vehicles_are_density_without_flow() {
        let mut grid = EdieGrid::new(vec![250.0], MINUTES).unwrap();
        (0..30).for_each(|_| grid.add(0, 0.0, 60.0, 0.0));
        let row = rows(&grid)[0];
        assert_eq!((row.density_veh_per_km, row.flow_veh_per_h, row.speed_mps), (120.0, 0.0, Some(0.0)));
    }

    #[test]
    fn fifty_changes_on_half_a_kilometre_in_ten_minutes_are_600_per_km_and_hour() {
        let window = Window { from_s: 0.0, interval_s: 600.0, intervals: 1 };
        let mut grid = EdieGrid::new(vec![500.0], window).unwrap();
        (0..50).for_each(|i| grid.change(0, f64::from(i)));
        assert_eq!(rows(&grid)[0].changes, 50);
        assert!((rows(&grid)[0].rate_per_km_h - 600.0).abs() < 1e-9);
    }

    #[test]
    fn a_piece_across_a_boundary_is_shared_by_time() {
        let mut grid = EdieGrid::new(vec![1000.0, 1000.0], MINUTES).unwrap();
        grid.add(1, 45.0, 60.0, 1200.0);
        let of_section: Vec<EdieRow> = rows(&grid)[10..].to_vec();
        assert_eq!(of_section[0].density_veh_per_km, 0.25);
        assert_eq!(of_section[0].flow_veh_per_h, 18.0);
        assert_eq!(of_section[1].density_veh_per_km, 0.75);
        assert_eq!(of_section[1].flow_veh_per_h, 54.0);
        assert!(rows(&grid)[..10].iter().all(|it| it.density_veh_per_km == 0.0 && it.speed_mps.is_none()));
    }

    #[test]
    fn what_happens_outside_the_window_is_cut_off() {
        let window = Window { from_s: 600.0, interval_s: 60.0, intervals: 2 };
        let mut grid = EdieGrid::new(vec![1000.0], window).unwrap();
        grid.add(0, 540.0, 240.0, 2400.0);
        grid.add(0, 0.0, 600.0, 6000.0);
        grid.add(0, 720.0, 60.0, 600.0);
        for time_s in [599.9, 600.0, 719.9, 720.0, f64::NAN] {
            grid.change(0, time_s);
        }
        let rows = rows(&grid);
        assert_eq!(rows.iter().map(|it| it.from_s).collect::<Vec<_>>(), [600.0, 660.0]);
        assert_eq!(rows.iter().map(|it| it.changes).collect::<Vec<_>>(), [1, 1]);
        assert!(rows.iter().all(|it| it.density_veh_per_km == 1.0 && it.flow_veh_per_h == 36.0));
    }

    #[test]
    fn a_section_without_length_is_refused_by_its_index() {
        let error = EdieGrid::new(vec![10.0, 0.0], MINUTES).unwrap_err();
        assert_eq!(error.to_string(), "section 1: length 0 m is not a positive number");
        assert!(EdieGrid::new(vec![10.0], Window { interval_s: f64::NAN, ..MINUTES }).is_err());
    }

    proptest! {
        #[test]
        fn no_vehicle_time_and_no_distance_is_lost(
            pieces in prop::collection::vec((0.0..400.0, 0.1..200.0, 0.0..5000.0), 1..30),
        ) {
            let mut grid = EdieGrid::new(vec![800.0], MINUTES).unwrap();
            for (time_s, duration_s, distance_m) in &pieces {
                grid.add(0, *time_s, *duration_s, *distance_m);
            }
            let time_s: f64 = grid.rows().map(|it| it.density_veh_per_km * 0.8 * 60.0).sum();
            let distance_m: f64 = grid.rows().map(|it| it.flow_veh_per_h / 60.0 * 800.0).sum();
            prop_assert!((time_s - pieces.iter().map(|it| it.1).sum::<f64>()).abs() < 1e-6);
            prop_assert!((distance_m - pieces.iter().map(|it| it.2).sum::<f64>()).abs() < 1e-6);
        }
    }
}
