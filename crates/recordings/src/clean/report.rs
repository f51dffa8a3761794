//! The findings of the cleaning.

use std::fmt;

/// What was corrected in, or cut out of, a recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CleaningReport {
    /// States in the recording before.
    pub states: usize,
    /// Tracks with an impossible length or width for their class: the usual ones were taken.
    pub sizes: Finding,
    /// States with a number that is not finite: left out.
    pub not_finite: Finding,
    /// Further states of a track in one frame: left out.
    pub duplicates: Finding,
    /// Single states off the path: left out.
    pub outliers: Finding,
    /// Jumps of the path: the track was split.
    pub jumps: Finding,
    /// Gaps of more than 1 s: the track was split.
    pub long_gaps: Finding,
    /// States that were interpolated over shorter gaps.
    pub interpolated: Finding,
    /// First and last positions of vehicles that were seen only in part: taken from the motion after and before them.
    pub partly_seen: Finding,
    /// Speeds that contradict the positions by more than 5 m/s: taken from smoothed positions.
    pub speeds: Finding,
    /// Headings that contradict the motion by more than 45°: taken from it.
    pub headings: Finding,
}

/// How often a problem was found, and where first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Finding {
    /// How often.
    pub count: usize,
    /// The first few.
    pub examples: Vec<Example>,
}

/// A place in a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Example {
    /// Id of the track.
    pub track: i64,
    /// Time [s].
    pub time: f64,
}

impl Finding {
    /// Maximum of stored examples.
    const EXAMPLES: usize = 5;

    fn add(&mut self, example: Example) {
        self.count += 1;
        if self.examples.len() < Finding::EXAMPLES {
            self.examples.push(example);
        }
    }
}

impl CleaningReport {
    /// Each finding with its name.
    pub fn findings(&self) -> [(&'static str, &Finding); 10] {
        [
            ("implausible sizes, replaced", &self.sizes),
            ("states that are not finite, left out", &self.not_finite),
            ("duplicate states of a frame, left out", &self.duplicates),
            ("states off the path, left out", &self.outliers),
            ("jumps; tracks were split there", &self.jumps),
            ("gaps of more than 1 s; tracks were split there", &self.long_gaps),
            ("missing states, interpolated", &self.interpolated),
            ("places where vehicles were seen only in part, replaced", &self.partly_seen),
            ("speeds that contradict the positions, replaced", &self.speeds),
            ("headings that contradict the motion, replaced", &self.headings),
        ]
    }
}

impl fmt::Display for CleaningReport {
    /// One line for each kind that was found.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} states", self.states)?;
        for (name, finding) in self.findings().into_iter().filter(|(_, it)| it.count > 0) {
            write!(f, "\n{} {name}:", finding.count)?;
            for (number, example) in finding.examples.iter().enumerate() {
                let comma = if number == 0 { "" } else { "," };
                write!(f, "{comma} track {} at {:.2} s", example.track, example.time)?;
            }
            if finding.count > finding.examples.len() {
                write!(f, ", …")?;
            }
        }
        Ok(())
    }
}

/// The report, while one track adds to it.
pub(super) struct Noted<'a> {
    pub(super) report: &'a mut CleaningReport,
    pub(super) track: i64,
    pub(super) step: f64,
}

impl Noted<'_> {
    /// Adds one case in `frame` to the finding that `of` selects.
    pub(super) fn add(&mut self, of: impl FnOnce(&mut CleaningReport) -> &mut Finding, frame: i64) {
        let example = Example { track: self.track, time: frame as f64 * self.step };
        of(self.report).add(example);
    }
}
