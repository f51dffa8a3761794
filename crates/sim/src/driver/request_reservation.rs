//! Drivers who wait at junctions ask for their reservation, or give it back: on the snapshot, for what concerns them
//! alone. Those who may pass are granted reservations one after the other once all have moved, on the state in which it
//! takes effect.

use laneweave_network::{ChainIndex, LightIndex};

use crate::driver::plan::{Outbox, Plan, RequestKind, ReservationRequest, Waiting};
use crate::junction::need::Survey;
use crate::junction::waiting::WaitingPriority;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{lets_go, sight};
use crate::right_of_way::conditions::{Asking, Hindrance, may_pass};
use crate::right_of_way::mergers::are_led_on;
use crate::right_of_way::survey::{sections, survey};
use crate::right_of_way::turns::turns;
use crate::state::clock::Clock;
use crate::state::standstill::STANDS;
use crate::view::scene::{Scene, Spot};

/// Who has waited at a light for so long [s], through a green, did not get the room that it needs: it comes first to it
/// (ours; as long as drivers are patient elsewhere).
const STARVES: f64 = 45.0;

/// The drivers of a lane who wait at a junction and may pass ask for their reservations.
pub(crate) fn request_reservations(
    scene: &Scene,
    clock: Clock,
    chain: ChainIndex,
    plan: &Plan,
    outbox: &mut Outbox,
) {
    let Outbox { returns, reservation_requests, .. } = outbox;
    for (index, from) in returns.drain(..) {
        let motion = &scene.motions(chain)[index as usize];
        let what = RequestKind::Revoke(from);
        reservation_requests.push(ReservationRequest {
            since: clock.step,
            id: motion.id,
            chain,
            x: motion.x,
            what,
        });
    }
    // At a light there is nothing to ask for, but by who starves there.
    let has_to_ask = |it: &&Waiting| !it.is_held || clock.since(it.since) > STARVES;
    for waiting in plan.waiting.iter().filter(has_to_ask) {
        let spot = Spot { chain, index: waiting.index as usize };
        let motion = scene.motion(spot);
        let applicant = Applicant::at(scene, spot);
        if !surveyed(scene, &applicant, &mut outbox.survey) {
            continue;
        }
        let asking = Asking::of(&applicant, waiting.since, clock);
        match may_pass(scene, &applicant, &outbox.survey, asking) {
            Ok(()) => outbox.reservation_requests.push(ReservationRequest {
                since: waiting.since,
                id: motion.id,
                chain,
                x: motion.x,
                what: RequestKind::Pass,
            }),
            Err(Hindrance::Others) => {
                outbox.priorities.extend(turns(scene, &applicant, &outbox.survey.holds, asking.priority));
            }
            Err(hindrance @ (Hindrance::Space | Hindrance::Roundabout)) => {
                if !asking.priority.is_patient {
                    request_space(scene, spot, asking.priority, outbox);
                }
                if hindrance == Hindrance::Space && motion.speed < STANDS {
                    let Waiting { since, id, .. } = *waiting;
                    outbox.blocked.push(ReservationRequest {
                        since,
                        id,
                        chain,
                        x: motion.x,
                        what: RequestKind::Pass,
                    });
                }
            }
            Err(Hindrance::Light) if starves(scene, asking, &outbox.survey) => {
                survey_at(scene, &applicant, |_, _| false, &mut outbox.survey);
                request_space(scene, spot, asking.priority, outbox);
            }
            Err(Hindrance::Light | Hindrance::Sign) => {}
        }
    }
}

/// Whether who waits at a light has waited for long, and was not let go by a green in the meantime.
fn starves(scene: &Scene, asking: Asking, survey: &Survey) -> bool {
    let Asking { priority, waited, clock } = asking;
    let was_green = |light| scene.signals.green_at(light, clock) > priority.since;
    waited > STARVES && survey.lights.last().is_some_and(|it| was_green(it.0))
}

/// The driver at `spot`, who has surveyed its way, claims room there. Who comes onto a ring from outside does not stop
/// it.
fn request_space(scene: &Scene, spot: Spot, priority: WaitingPriority, outbox: &mut Outbox) {
    let Outbox { survey, space_requests, roundabouts, .. } = outbox;
    let way = [spot.chain, survey.section.chain];
    if scene.reservations.roundabouts.is_entered(way) {
        roundabouts.push((way, priority));
    } else {
        let sections = sections(scene, scene.viewpoint(spot), survey);
        space_requests.extend(sections.map(|it| (it, priority, survey.needed)));
    }
}

/// Surveys what an applicant needs next. Returns whether there is something, and nobody before it waits there.
pub(crate) fn surveyed(scene: &Scene, applicant: &Applicant, out: &mut Survey) -> bool {
    let is_held = |light, at| !lets_go(scene, light, at, applicant.speed);
    survey_at(scene, applicant, is_held, out) && are_led_on(scene, applicant, out)
}

/// Surveys what an applicant needs next, up to a light where it `is_held`. Returns whether there is something.
fn survey_at(
    scene: &Scene,
    applicant: &Applicant,
    is_held: impl Fn(LightIndex, f64) -> bool,
    out: &mut Survey,
) -> bool {
    let granted = applicant.reservation.map_or(0.0, |it| it.left().max(0.0));
    survey(scene, applicant, [granted, sight(applicant.speed)], is_held, out)
}
