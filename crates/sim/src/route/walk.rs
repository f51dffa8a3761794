//! The walk along a route, chain by chain, as far as somebody looks.

use laneweave_network::{ChainIndex, Network};

use crate::route::onward::Onward;

/// A chain on a route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Leg {
    /// Which.
    pub(crate) chain: ChainIndex,
    /// How far ahead it starts [m]; negative for the chain where the walk begins.
    pub(crate) start: f64,
    /// The chain before it on the route; none where the walk begins.
    pub(crate) before: Option<ChainIndex>,
}

/// The chains of a route that start within reach, from the one where the walk begins on.
#[derive(Clone, Debug)]
pub(crate) struct Walk<'a> {
    network: &'a Network,
    onward: &'a Onward,
    table: usize,
    /// The chain that was come to last.
    at: Leg,
    has_begun: bool,
    reach: f64,
}

impl<'a> Walk<'a> {
    /// The walk of those who drive by `table` on from `chain`, which starts so far ahead [m].
    #[inline]
    pub(super) fn new(
        network: &'a Network,
        onward: &'a Onward,
        table: usize,
        chain: ChainIndex,
        start: f64,
    ) -> Walk<'a> {
        let at = Leg { chain, start, before: None };
        Walk { network, onward, table, at, has_begun: false, reach: f64::INFINITY }
    }

    /// The same, over chains only that start less than `reach` ahead [m], and the one where it begins.
    #[inline]
    pub(crate) fn within(self, reach: f64) -> Walk<'a> {
        Walk { reach, ..self }
    }

    /// Looks so far ahead from now on [m].
    #[inline]
    pub(crate) fn look_on(&mut self, reach: f64) {
        self.reach = reach;
    }

    /// The chain that was come to last.
    #[inline]
    pub(crate) fn at(&self) -> ChainIndex {
        self.at.chain
    }

    /// How far ahead the chain ends that was come to last [m].
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
        self.at = Leg { chain, start, before: Some(self.at.chain) };
        Some(self.at)
    }
}
