//! The walk along a route, chain by chain, as far as needed.

use laneweave_network::{ChainIndex, Network};

use crate::route::onward::Onward;
use crate::state::previous_lanes::PreviousLanes;

/// A chain on a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Leg {
    pub(crate) chain: ChainIndex,
    /// Distance to its start [m]; negative for the first chain of the walk.
    pub(crate) start: f64,
    /// The chains of the walk before it.
    pub(crate) passed: PreviousLanes,
}

impl Leg {
    /// The chain before it on the route; none for the first chain of the walk.
    #[inline]
    pub(crate) fn before(&self) -> Option<ChainIndex> {
        self.passed.last()
    }
}

/// The chains of a route that start within reach, from the first chain of the walk on.
#[derive(Clone, Debug)]
pub(crate) struct Walk<'a> {
    network: &'a Network,
    onward: &'a Onward,
    table: usize,
    /// The present chain.
    at: Leg,
    has_begun: bool,
    reach: f64,
}

impl<'a> Walk<'a> {
    /// The walk along the route of `table`, from `chain` on, which starts `start` ahead [m].
    #[inline]
    pub(super) fn new(
        network: &'a Network,
        onward: &'a Onward,
        table: usize,
        chain: ChainIndex,
        start: f64,
    ) -> Walk<'a> {
        let at = Leg { chain, start, passed: PreviousLanes::NONE };
        Walk { network, onward, table, at, has_begun: false, reach: f64::INFINITY }
    }

    /// The same walk, limited to its first chain and to chains that start less than `reach` ahead [m].
    #[inline]
    pub(crate) fn within(self, reach: f64) -> Walk<'a> {
        Walk { reach, ..self }
    }

    /// Changes the reach to `reach` [m].
    #[inline]
    pub(crate) fn look_on(&mut self, reach: f64) {
        self.reach = reach;
    }

    /// The present chain.
    #[inline]
    pub(crate) fn at(&self) -> ChainIndex {
        self.at.chain
    }

    /// Distance to the end of the present chain [m].
    #[inline]
    pub(crate) fn end(&self) -> f64 {
        self.at.start + self.network.chain(self.at.chain).length
    }
}

impl Iterator for Walk<'_> {
    type Item = Leg;

    #[inline]
    fn next(&mut self) -> Option<Leg> {
        if !self.has_begun {
            self.has_begun = true;
            return Some(self.at);
        }
        let start = self.end();
        if start >= self.reach {
            return None;
        }
        let chain = self.onward.next(self.network, self.at.chain, self.table)?;
        self.at = Leg { chain, start, passed: self.at.passed.left(self.at.chain) };
        Some(self.at)
    }
}
