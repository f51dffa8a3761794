//! Drivers at junctions request reservations, or revoke their own. Requests are made on the snapshot, each for one
//! driver alone. Once all vehicles have moved, reservations are granted one after the other, on the state in which
//! they take effect.

use laneweave_network::{ChainIndex, LightIndex};

use crate::driver::plan::{Outbox, Plan, RequestKind, ReservationRequest, Waiting};
use crate::junction::need::Survey;
use crate::junction::waiting_priority::WaitingPriority;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{lets_go, sight};
use crate::right_of_way::may_pass::{Asking, PassHindrance, may_pass};
use crate::right_of_way::mergers::are_led_on;
use crate::right_of_way::survey::{sections, survey};
use crate::right_of_way::turns::turns;
use crate::state::clock::Clock;
use crate::state::standstill::STANDS;
use crate::view::scene::{Scene, Spot};

/// A driver who has waited at a light this long, through a green, did not get the storage space that it needs [s]. It
/// then comes first to that space (ours; as long as drivers are patient elsewhere).
const STARVES: f64 = 45.0;

/// Adds the requests of the drivers of a lane who wait at a junction, but not for a light. Whoever may not pass yet may
/// do so once all have moved.
pub(crate) fn request_reservations(
    scene: &Scene,
    clock: Clock,
    chain: ChainIndex,
    plan: &Plan,
    outbox: &mut Outbox,
) {
    revoke(scene, clock, chain, outbox);
    // A driver who waits at a light has nothing to request, unless it has waited too long.
    let has_to_ask = |it: &&Waiting| !it.is_held || clock.since(it.since) > STARVES;
    for waiting in plan.waiting.iter().filter(has_to_ask) {
        let spot = Spot { chain, index: waiting.index as usize };
        let motion = scene.motion(spot);
        let applicant = Applicant::at(scene, spot);
        let is_held = |light, at| !lets_go(scene, light, at, applicant.speed);
        if !survey_at(scene, &applicant, is_held, &mut outbox.survey) {
            continue;
        }
        let asking = Asking::of(&applicant, waiting.since, clock);
        let Waiting { since, id, .. } = *waiting;
        let request = ReservationRequest { since, id, chain, x: motion.x, what: RequestKind::Pass };
        if !are_led_on(scene, &applicant, &outbox.survey) {
            // In an endless stream somebody always waits in front. Long after its patience the driver goes first.
            if asking.waited > STARVES + applicant.style.yielding.patience {
                outbox.priorities.extend(turns(scene, &applicant, &outbox.survey, asking.priority));
            }
            outbox.reservation_requests.push(request);
            continue;
        }
        match may_pass(scene, &applicant, &outbox.survey, asking) {
            Ok(()) => outbox.reservation_requests.push(request),
            Err(PassHindrance::Others) => {
                outbox.priorities.extend(turns(scene, &applicant, &outbox.survey, asking.priority));
                outbox.reservation_requests.push(request);
            }
            Err(hindrance @ (PassHindrance::Space | PassHindrance::Roundabout)) => {
                if !asking.priority.is_patient {
                    request_space(scene, spot, asking.priority, hindrance, outbox);
                }
                if hindrance == PassHindrance::Space && motion.speed < STANDS {
                    outbox.blocked.push(request);
                }
                outbox.reservation_requests.push(request);
            }
            Err(PassHindrance::Light) if starves(scene, asking, &outbox.survey) => {
                survey_at(scene, &applicant, |_, _| false, &mut outbox.survey);
                request_space(scene, spot, asking.priority, PassHindrance::Light, outbox);
            }
            Err(PassHindrance::Blocked | PassHindrance::Sign) => outbox.reservation_requests.push(request),
            Err(PassHindrance::Light) => {}
        }
    }
}

/// Adds the requests of the drivers of a lane who return reservations.
fn revoke(scene: &Scene, clock: Clock, chain: ChainIndex, outbox: &mut Outbox) {
    let Outbox { returns, reservation_requests, .. } = outbox;
    let request = |(index, from): (u32, f64)| {
        let motion = &scene.motions(chain)[index as usize];
        let what = RequestKind::Revoke(from);
        ReservationRequest { since: clock.step, id: motion.id, chain, x: motion.x, what }
    };
    reservation_requests.extend(returns.drain(..).map(request));
}

/// Whether a driver has waited at a light for long, and could not go during a green in the meantime.
fn starves(scene: &Scene, asking: Asking, survey: &Survey) -> bool {
    let Asking { priority, waited, clock } = asking;
    let was_green = |light| scene.signals.green_at(light, clock) > priority.since;
    waited > STARVES && survey.lights.last().is_some_and(|it| was_green(it.0))
}

/// Requests space for the driver at `spot`, who has surveyed its route, and has met a `hindrance`. A driver who enters
/// a roundabout does not stop the traffic on it, but gets a waiting priority there instead: those who come later to
/// any entry let it go first, whether the roundabout is full, or there is no space where this driver enters it.
fn request_space(
    scene: &Scene,
    spot: Spot,
    priority: WaitingPriority,
    hindrance: PassHindrance,
    outbox: &mut Outbox,
) {
    let Outbox { survey, space_requests, roundabouts, .. } = outbox;
    let way = [spot.chain, survey.section.chain];
    if !scene.reservations.roundabouts.is_entered(way) {
        let sections = sections(scene, scene.viewpoint(spot), survey);
        space_requests.extend(sections.map(|it| (it, priority, survey.needed)));
    } else if hindrance != PassHindrance::Light {
        roundabouts.push((way, priority));
    }
}

/// Surveys what an applicant needs next. Returns whether it needs something, and no vehicle waits in front of it
/// there.
pub(crate) fn surveyed(scene: &Scene, applicant: &Applicant, out: &mut Survey) -> bool {
    let is_held = |light, at| !lets_go(scene, light, at, applicant.speed);
    survey_at(scene, applicant, is_held, out) && are_led_on(scene, applicant, out)
}

/// Surveys what an applicant needs next, up to a light where it `is_held`. Returns whether it needs something.
fn survey_at(
    scene: &Scene,
    applicant: &Applicant,
    is_held: impl Fn(LightIndex, f64) -> bool,
    out: &mut Survey,
) -> bool {
    let granted = applicant.reservation.map_or(0.0, |it| it.left().max(0.0));
    survey(scene, applicant, [granted, sight(scene, applicant.from.chain, applicant.speed)], is_held, out)
}

#[cfg(test)]
mod tests {
    use laneweave_generate::own_maps;

    use super::*;
    use crate::right_of_way::survey::tests::{regulated, standing};
    use crate::route::navigate::Navigator;
    use crate::state::some_style::some_style;
    use crate::view::snapshot::{Seen, Snapshot};

    #[test]
    fn who_waits_to_enter_a_roundabout_gets_a_priority_there_and_none_while_the_light_is_red() {
        let (_, drawing) = own_maps().unwrap().into_iter().find(|it| it.0 == "roundabout.osm").unwrap();
        let network = regulated(&drawing);
        let (navigator, styles) = (Navigator::new(&network), [some_style()]);
        // It stands at the line of an entry.
        let entry = network.entrances[0].chains[0];
        let line = network.junctions.on(entry).stops.last().unwrap().station;
        let truck = Seen { chain: entry, x: line - 1.0, destination: Some(0), ..standing() };
        let snapshot = Snapshot::new(&network, [truck]);
        let (scene, spot) = (snapshot.scene(&network, &navigator, &styles), snapshot.spot(1).unwrap());
        let mut outbox = Outbox::default();
        assert!(surveyed(&scene, &Applicant::at(&scene, spot), &mut outbox.survey));
        let way = [entry, outbox.survey.section.chain];
        assert!(scene.reservations.roundabouts.is_entered(way), "{way:?}");
        let priority = WaitingPriority { is_patient: false, since: 7, id: 1, is_long: true };
        for (hindrance, noted) in
            [(PassHindrance::Space, 1), (PassHindrance::Roundabout, 1), (PassHindrance::Light, 0)]
        {
            request_space(&scene, spot, priority, hindrance, &mut outbox);
            assert_eq!(
                outbox.roundabouts.drain(..).collect::<Vec<_>>(),
                vec![(way, priority); noted],
                "{hindrance:?}"
            );
            assert!(outbox.space_requests.is_empty());
        }
    }
}
