//! Lane changes by style, kind and leading incentive, and the accepted gaps.

use laneweave_models::change::INCENTIVES;
use laneweave_sim::{Event, LaneChange, LaneChangeKind, World};
use laneweave_study::Histogram;
use serde::{Deserialize, Serialize};

use super::driving::{names, styles_of, typical};

/// Bins of gaps [m], and of times to collision [s]: their width and number.
const GAPS: (f64, usize) = (5.0, 30);
const TIMES_TO_COLLISION: (f64, usize) = (1.0, 20);
/// Bins of gains of speed [m/s]: the first, their width and number.
const GAINS: (f64, f64, usize) = (-20.0, 1.0, 60);

/// Number of kinds of lane changes.
const KINDS: usize = LaneChangeKind::ALL.len();

/// The name where no incentive was in favour of the change.
const NONE: &str = "none";

/// Counts the lane changes that ended.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Reasons {
    begin: f64,
    style_of: Vec<u16>,
    /// The styles.
    pub styles: Vec<String>,
    /// The incentives of each style's model; an unused one has no name.
    incentives: Vec<[String; INCENTIVES]>,
    /// Completed changes by style, by kind and by the index of the leading incentive; the last index is none.
    completed: Vec<[[u64; INCENTIVES + 1]; KINDS]>,
    /// Aborted changes.
    pub aborted: u64,
    /// Gaps ahead and behind at the begin of the completed changes, where there is a vehicle [m].
    pub gaps: [Histogram; 2],
    /// Times to collision there, where a vehicle closes in [s].
    pub times_to_collision: [Histogram; 2],
    /// Gains of speed that were anticipated when the desire began, by kind [m/s].
    pub gains: [Histogram; KINDS],
}

impl Reasons {
    /// Counts changes from the time `begin` [s] on.
    pub fn new(world: &World, begin: f64) -> Reasons {
        let styles = names(world);
        let incentives = typical(world).map(|it| it.change.row_names().map(String::from)).collect();
        let histograms = |(width, bins)| [(); 2].map(|()| Histogram::new(0.0, width, bins));
        Reasons {
            begin,
            style_of: styles_of(world),
            completed: vec![Default::default(); styles.len()],
            styles,
            incentives,
            aborted: 0,
            gaps: histograms(GAPS),
            times_to_collision: histograms(TIMES_TO_COLLISION),
            gains: [(); KINDS].map(|()| Histogram::new(GAINS.0, GAINS.1, GAINS.2)),
        }
    }

    /// Whether it goes on from `new`, which has seen nothing: the same styles, incentives and bins.
    pub(super) fn fits(&self, new: &Reasons) -> bool {
        let histograms = |it| {
            let Reasons { gaps, times_to_collision, gains, .. }: &Reasons = it;
            gaps.iter().chain(times_to_collision).chain(gains)
        };
        (self.begin, &self.style_of, &self.styles, &self.incentives)
            == (new.begin, &new.style_of, &new.styles, &new.incentives)
            && self.completed.len() == new.completed.len()
            && histograms(self).zip(histograms(new)).all(|(it, new)| it.fits(new))
    }

    /// Observes the events of a step.
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
        let style = usize::from(self.style_of[change.parameters as usize]);
        self.completed[style][place(change.kind)][change.appraisal.leading().unwrap_or(INCENTIVES)] += 1;
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
    pub fn of_style(&self, style: usize, kind: LaneChangeKind) -> u64 {
        self.completed[style][place(kind)].iter().sum()
    }

    /// The incentives of all models, and none.
    pub fn incentives(&self) -> Vec<&str> {
        let mut all: Vec<&str> = Vec::new();
        for name in self.incentives.iter().flatten().filter(|it| !it.is_empty()) {
            if !all.contains(&name.as_str()) {
                all.push(name);
            }
        }
        all.push(NONE);
        all
    }

    /// Completed changes of a kind with that leading incentive.
    pub fn of_incentive(&self, incentive: &str, kind: LaneChangeKind) -> u64 {
        let of_style = |(names, counts): (&[String; INCENTIVES], &[[u64; INCENTIVES + 1]; KINDS])| {
            let named = names.iter().map(String::as_str).chain([NONE]).zip(counts[place(kind)]);
            // A change that a row without a name leads has no incentive.
            let is_it = |name: &str| name == incentive || (name.is_empty() && incentive == NONE);
            named.filter(|(name, _)| is_it(name)).map(|(_, count)| count).sum::<u64>()
        };
        self.incentives.iter().zip(&self.completed).map(of_style).sum()
    }

    /// Completed changes of a kind.
    pub fn of_kind(&self, kind: LaneChangeKind) -> u64 {
        (0..self.styles.len()).map(|it| self.of_style(it, kind)).sum()
    }

    /// All completed changes.
    pub fn total(&self) -> u64 {
        LaneChangeKind::ALL.iter().map(|it| self.of_kind(*it)).sum()
    }
}

fn place(kind: LaneChangeKind) -> usize {
    match kind {
        LaneChangeKind::Discretionary => 0,
        LaneChangeKind::Route => 1,
        LaneChangeKind::Keeping => 2,
    }
}
