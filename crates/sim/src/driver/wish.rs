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
