//! What a driver wants across lanes, as its plan shows it.

use laneweave_network::Side;

use crate::driver::me::Me;
use crate::driver::plan::{Ask, Concern, Request};
use crate::state::lane::{Phase, VehicleId};

/// The side to which a driver wants to change, or to go on changing, after it has decided: its own are among these
/// `requests` and `concerns`. `None` if it keeps its lane, gives up a desired change, or goes back.
pub(crate) fn wish(me: &Me, requests: &[Request], concerns: &[Concern]) -> Option<Side> {
    let asks = |what: fn(&Ask) -> bool| asks(requests, me.motion.id, what);
    match me.driver.phase {
        Phase::Cruises => requests.iter().find_map(|it| match it.ask {
            Ask::Want(want) if it.id == me.motion.id => Some(want.side),
            _ => None,
        }),
        Phase::Wants => {
            let gives_up = concerns.iter().any(|it| it.index as usize == me.spot.index && it.gives_up);
            (!gives_up).then_some(me.lane_change.side)
        }
        Phase::Changes => (!asks(|it| matches!(it, Ask::Abort))).then_some(me.lane_change.side),
        Phase::Aborts => None,
    }
}

/// Whether a vehicle makes a request of this kind.
pub(crate) fn asks(requests: &[Request], id: VehicleId, what: impl Fn(&Ask) -> bool) -> bool {
    requests.iter().any(|it| it.id == id && what(&it.ask))
}

#[cfg(test)]
mod tests {
    use laneweave_generate::{Motorway, motorway};
    use laneweave_network::{ChainIndex, Position};

    use super::*;
    use crate::route::navigate::Navigator;
    use crate::state::some_style::some_style;
    use crate::state::vehicle::Class;
    use crate::view::snapshot::{Across, Seen, Snapshot};

    #[test]
    fn who_changes_lanes_wants_to_go_on_until_it_asks_itself_to_abort() {
        let road = Motorway { lanes: 2, ..Motorway::default() };
        let network = motorway(&road).unwrap().build().unwrap().network;
        let (navigator, styles) = (Navigator::new(&network), [some_style()]);
        let slow = network.chains.iter().position(|it| it.beside(Side::Left, 100.0).is_some()).unwrap();
        let chain = ChainIndex(slow as u32);
        let beside = network.chain(chain).beside(Side::Left, 100.0).unwrap();
        let other = Position { chain: beside.chain, x: beside.across(100.0) };
        let changing = Seen {
            id: 1,
            chain,
            x: 100.0,
            speed: 20.0,
            acceleration: 0.0,
            length: 4.5,
            class: Class::Car,
            parameters: 0,
            desired: 30.0,
            destination: None,
            change: Some(Across { side: Side::Left, progress: 0.3, other }),
        };
        let snapshot = Snapshot::new(&network, [changing]);
        let scene = snapshot.scene(&network, &navigator, &styles);
        let me = Me::at(&scene, snapshot.spot(1).unwrap());
        let abort = |id| Request { urgency: 0.0, id, chain, x: 100.0, ask: Ask::Abort };
        assert_eq!(wish(&me, &[], &[]), Some(Side::Left));
        assert_eq!(wish(&me, &[abort(2)], &[]), Some(Side::Left));
        assert_eq!(wish(&me, &[abort(2), abort(1)], &[]), None);
    }
}
