//! Lane changes by style, kind and leading incentive, and the gaps that were taken.

use laneweave_models::change::{Appraisal, INCENTIVES, Mcdm};
use laneweave_sim::{Event, Kind, LaneChange, World};
use laneweave_study::Histogram;

use super::driving::{names, styles_of};

/// Bins of gaps [m], and of times to collision [s]: their width and number.
const GAPS: (f64, usize) = (5.0, 30);
const TIMES_TO_COLLISION: (f64, usize) = (1.0, 20);
/// Bins of gains of speed [m/s]: the first, their width and number.
const GAINS: (f64, f64, usize) = (-20.0, 1.0, 60);

/// Counts the lane changes that are over.
#[derive(Clone, Debug)]
pub struct Reasons {
    begin: f64,
    style_of: Vec<u16>,
    /// The styles.
    pub styles: Vec<String>,
    /// Completed changes by style, by kind and by the place of the leading incentive, the last of which is none.
    completed: Vec<[[u64; INCENTIVES + 1]; 2]>,
    /// Changes that were called off.
    pub aborted: u64,
    /// Gaps ahead and behind at the begin of the completed changes, where anybody is there [m].
    pub gaps: [Histogram; 2],
    /// Times to collision there, where somebody closes in [s].
    pub times_to_collision: [Histogram; 2],
    /// Gains of speed that were anticipated when the desire came, by kind [m/s].
    pub gains: [Histogram; 2],
}

impl Reasons {
    /// Of changes from the time `begin` [s] on.
    pub fn new(world: &World, begin: f64) -> Reasons {
        let styles = names(world);
        let histograms = |(width, bins)| [(); 2].map(|()| Histogram::new(0.0, width, bins));
        Reasons {
            begin,
            style_of: styles_of(world.demand()),
            completed: vec![Default::default(); styles.len()],
            styles,
            aborted: 0,
            gaps: histograms(GAPS),
            times_to_collision: histograms(TIMES_TO_COLLISION),
            gains: [(); 2].map(|()| Histogram::new(GAINS.0, GAINS.1, GAINS.2)),
        }
    }

    /// Looks at what happened in a step.
    pub fn observe(&mut self, world: &World) {
        for event in world.events() {
            if let Event::LaneChange(change) = event
                && change.time >= self.begin
            {
                self.count(change);
            }
        }
    }

    fn count(&mut self, change: &LaneChange) {
        if !change.is_completed {
            self.aborted += 1;
            return;
        }
        let style = usize::from(self.style_of[change.character as usize]);
        self.completed[style][place(change.kind)][leading(&change.appraisal)] += 1;
        self.gains[place(change.kind)].add(change.speed_gain);
        let add = |histogram: &mut Histogram, value: f64| {
            if value.is_finite() {
                histogram.add(value);
            }
        };
        for (side, gap) in [change.gap_ahead, change.gap_behind].into_iter().enumerate() {
            add(&mut self.gaps[side], gap);
        }
        for (side, time) in [change.ttc_ahead, change.ttc_behind].into_iter().enumerate() {
            add(&mut self.times_to_collision[side], time);
        }
    }

    /// Completed changes of a kind by a style.
    pub fn of_style(&self, style: usize, kind: Kind) -> u64 {
        self.completed[style][place(kind)].iter().sum()
    }

    /// Completed changes of a kind with the leading incentive at a place in [`Reasons::INCENTIVES`].
    pub fn of_incentive(&self, incentive: usize, kind: Kind) -> u64 {
        self.completed.iter().map(|it| it[place(kind)][incentive]).sum()
    }

    /// Completed changes of a kind.
    pub fn of_kind(&self, kind: Kind) -> u64 {
        (0..self.styles.len()).map(|it| self.of_style(it, kind)).sum()
    }

    /// All completed changes.
    pub fn total(&self) -> u64 {
        self.of_kind(Kind::Discretionary) + self.of_kind(Kind::Route)
    }

    /// The incentives, and none.
    pub const INCENTIVES: [&str; INCENTIVES + 1] = {
        let mut names = ["none"; INCENTIVES + 1];
        let mut place = 0;
        while place < INCENTIVES {
            names[place] = Mcdm::NAMES[place];
            place += 1;
        }
        names
    };
}

fn place(kind: Kind) -> usize {
    match kind {
        Kind::Discretionary => 0,
        Kind::Route => 1,
    }
}

/// The place of the incentive with the largest μY, if it is above 0, or else that of none.
fn leading(appraisal: &Appraisal) -> usize {
    let products = appraisal.rows.iter().map(|it| it.weight * it.earning).enumerate();
    // Of equal ones the first leads.
    let largest = products.filter(|(_, it)| *it > 0.0).reduce(|a, b| if b.1 > a.1 { b } else { a });
    largest.map_or(INCENTIVES, |(place, _)| place)
}

#[cfg(test)]
mod tests {
    use laneweave_models::change::Row;

    use super::*;

    #[test]
    fn the_incentive_with_the_largest_product_of_yield_and_weight_leads() {
        let of = |rows: [(f64, f64); INCENTIVES]| {
            let rows = rows.map(|(weight, earning)| Row { earning, weight });
            Reasons::INCENTIVES[leading(&Appraisal { rows, gain: 0.0, theta: 0.0 })]
        };
        assert_eq!(of([(0.2, 0.5), (0.1, 3.0), (1.0, -4.0), (0.0, 9.0), (0.9, 0.1)]), "route");
        assert_eq!(of([(0.2, 0.5), (0.1, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]), "speed");
        assert_eq!(of([(0.2, -0.5), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]), "none");
    }
}
