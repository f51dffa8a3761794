//! What recorded drivers could choose in each second, as numbers only.

use std::ops::Range;

/// Number of covariates of gap acceptance, without the intercept.
pub const GAP_TERMS: usize = 4;

/// Most possible desired speeds of a driver.
pub const MOST_NODES: usize = 8;

/// A row has no intercept of a place of this kind.
pub const NO_STRATUM: u32 = u32::MAX;

/// Drivers with their seconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Design {
    /// Number of terms of G that are fitted.
    pub terms: usize,
    /// Number of possible desired speeds of each driver.
    pub nodes: usize,
    /// Number of places with an intercept of their own.
    pub strata: usize,
    /// The terms: by row, by node, by term. A row is one side in one second.
    pub values: Vec<f64>,
    /// Covariates of gap acceptance, by row.
    pub gaps: Vec<[f64; GAP_TERMS]>,
    /// For each row its intercepts: of a wider and of a narrower place.
    pub places: Vec<[u32; 2]>,
    /// The drivers.
    pub drivers: Vec<Driver>,
}

/// A driver.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Driver {
    /// The chances of its desired speeds.
    pub chances: Vec<f64>,
    /// Its rows.
    pub rows: Range<usize>,
    /// Its spells, for each possible phase of its decisions.
    pub phases: Vec<Vec<Spell>>,
}

/// A time in which a driver could begin a change, up to the begin of one or up to the end of what was seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spell {
    /// For each second the rows of both sides; `None` where the driver could not change.
    pub seconds: Vec<[Option<u32>; 2]>,
    /// The side of the change that began in the last second.
    pub changed_to: Option<usize>,
}

impl Design {
    /// The terms of a row with a desired speed.
    pub fn row(&self, row: usize, node: usize) -> &[f64] {
        let from = (row * self.nodes + node) * self.terms;
        &self.values[from..from + self.terms]
    }

    /// Number of changes.
    pub fn changes(&self) -> usize {
        let spells = self.drivers.iter().filter_map(|it| it.phases.first()).flatten();
        spells.filter(|it| it.changed_to.is_some()).count()
    }

    /// Number of seconds, in one phase.
    pub fn seconds(&self) -> usize {
        let spells = self.drivers.iter().filter_map(|it| it.phases.first()).flatten();
        spells.map(|it| it.seconds.len()).sum()
    }

    /// The root mean square of each term about its mean, over all rows; 1 where it never differs.
    pub fn scales(&self) -> Vec<f64> {
        let count = (self.values.len() / self.terms.max(1)) as f64;
        let columns = (0..self.terms).map(|it| self.values.iter().skip(it).step_by(self.terms));
        let scale = |column: &mut dyn Iterator<Item = &f64>| {
            let (sum, squares) = column.fold((0.0, 0.0), |(sum, squares), it| (sum + it, squares + it * it));
            let variance = squares / count - sum / count * (sum / count);
            if variance > 1e-18 { variance.sqrt() } else { 1.0 }
        };
        columns.map(|mut it| scale(&mut it)).collect()
    }
}
