//! The road of the paper's figure, and its lanes by their letters.

use laneweave::generate::approach;
use laneweave::maps::regulations;
use laneweave::network::{ChainIndex, DrivingSide, Gate, Network, Side, Symmetry, symmetry};

/// A road beyond the junction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Road {
    Left,
    Straight,
}

/// Maximum distance of the junction's edge from its middle [m].
const JUNCTION: f64 = 20.0;

/// The approach: three lanes, two roads beyond, three exits.
pub(crate) struct Approach {
    pub(crate) network: Network,
    /// Lanes A, B and C.
    pub(crate) lanes: [ChainIndex; 3],
    /// Indices of the exits in the list of destinations: that of the left road, that of the straight road, and the
    /// common one.
    pub(crate) exits: [u16; 3],
}

impl Approach {
    pub(crate) fn drawn() -> Approach {
        let map = approach(DrivingSide::Right).build().expect("a map");
        let network = map.network.clone().regulated(&regulations(&map));
        let [entrance] = &network.entrances[..] else { panic!("one entrance") };
        let a = *entrance.chains.iter().find(|it| network.chain(**it).left.is_empty()).expect("a left lane");
        let right_of = |it: ChainIndex| network.chain(it).beside(Side::Right, 50.0).expect("a lane").chain;
        let (b, c) = (right_of(a), right_of(right_of(a)));
        let end = |gate: &Gate| {
            let centre = &network.chain(gate.chains[0]).centre;
            centre.at(centre.length())
        };
        let exit = |is_it: fn(f64, f64) -> bool| {
            let place = network.exits.iter().position(|it| is_it(end(it).x, end(it).y));
            place.expect("the exit is there") as u16
        };
        let exits = [exit(|_, y| y > 300.0), exit(|_, y| y < -100.0), exit(|x, _| x > 400.0)];
        Approach { lanes: [a, b, c], exits, network }
    }

    /// The road at `x` [m] of a chain; `None` before the junction and within it.
    pub(crate) fn road(&self, chain: ChainIndex, x: f64) -> Option<Road> {
        let at = self.network.chain(chain).centre.at(x);
        if at.y > JUNCTION { Some(Road::Left) } else { (at.x > JUNCTION).then_some(Road::Straight) }
    }

    /// The station on `chain` where it joins `road` beyond the junction [m].
    pub(crate) fn begin_of(&self, road: Road, chain: ChainIndex) -> Option<f64> {
        let metres = 0..self.network.chain(chain).length as u32;
        let first = metres.map(f64::from).find(|it| self.road(chain, *it).is_some())?;
        (self.road(chain, first) == Some(road)).then_some(first)
    }

    /// The chains by which a lane leads to roads: its own, or those after the fork.
    pub(crate) fn across(&self, lane: ChainIndex) -> Vec<ChainIndex> {
        let ends_before = self.road(lane, self.network.chain(lane).length).is_none();
        if ends_before { self.network.chain(lane).following.clone() } else { vec![lane] }
    }

    /// The next sections that a lane leads to.
    fn sections(&self, lane: ChainIndex) -> Vec<Road> {
        let across = self.across(lane);
        let leads_to = |road: &Road| across.iter().any(|it| self.begin_of(*road, *it).is_some());
        [Road::Left, Road::Straight].into_iter().filter(leads_to).collect()
    }
}

#[test]
fn v40_of_the_lanes_of_the_drawn_figure_those_are_symmetric_that_the_paper_says() {
    let it = Approach::drawn();
    let [a, b, c] = it.lanes.map(|lane| it.sections(lane));
    let expected = [vec![Road::Left], vec![Road::Left, Road::Straight], vec![Road::Straight]];
    assert_eq!([&a, &b, &c], expected.each_ref());
    for (here, there, expected) in [
        (&a, &b, Symmetry::Symmetric),
        (&c, &b, Symmetry::Symmetric),
        (&a, &c, Symmetry::Asymmetric),
        (&c, &a, Symmetry::Asymmetric),
        (&b, &a, Symmetry::Asymmetric),
        (&b, &c, Symmetry::Asymmetric),
    ] {
        assert_eq!(symmetry(here, there), expected, "{here:?} to {there:?}");
    }
}
