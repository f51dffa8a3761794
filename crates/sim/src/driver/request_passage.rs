//! Drivers who wait at junctions ask for their passage, or give it back: on the snapshot, for what concerns them alone.
//! Those who may pass are given passages one after the other once all have moved, on the state in which it takes
//! effect.

use laneweave_network::{ChainIndex, LightIndex};

use crate::driver::plan::{Outbox, PassageRequest, Plan, RequestKind, Waiting};
use crate::junction::claim::Claim;
use crate::junction::need::Survey;
use crate::right_of_way::applicant::Applicant;
use crate::right_of_way::approach::{lets_go, sight};
use crate::right_of_way::conditions::{Asking, Hindrance, may_pass};
use crate::right_of_way::mergers::are_led_on;
use crate::right_of_way::survey::{refuges, survey};
use crate::right_of_way::turns::turns;
use crate::state::clock::Clock;
use crate::state::standstill::STANDS;
use crate::view::scene::{Scene, Spot};

/// Who has waited at a light for so long [s], through a green, did not get the room that it needs: it comes first to it
/// (ours; as long as drivers are patient elsewhere).
const STARVES: f64 = 45.0;

/// The drivers of a lane who wait at a junction and may pass ask for their passages.
pub(crate) fn request_passages(
    scene: &Scene,
    clock: Clock,
    chain: ChainIndex,
    plan: &Plan,
    outbox: &mut Outbox,
) {
    let Outbox { returns, passage_requests, .. } = outbox;
    for (index, from) in returns.drain(..) {
        let motion = &scene.motions(chain)[index as usize];
        let what = RequestKind::GiveBack(from);
        passage_requests.push(PassageRequest { since: clock.step, id: motion.id, chain, x: motion.x, what });
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
            Ok(()) => outbox.passage_requests.push(PassageRequest {
                since: waiting.since,
                id: motion.id,
                chain,
                x: motion.x,
                what: RequestKind::Pass,
            }),
            Err(Hindrance::Others) => {
                outbox.claims.extend(turns(scene, &applicant, &outbox.survey.holds, asking.claim));
            }
            Err(hindrance @ (Hindrance::Room | Hindrance::Ring)) => {
                if !asking.claim.is_patient {
                    claim_room(scene, spot, asking.claim, outbox);
                }
                if hindrance == Hindrance::Room && motion.speed < STANDS {
                    let Waiting { since, id, .. } = *waiting;
                    outbox.blocked.push(PassageRequest {
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
                claim_room(scene, spot, asking.claim, outbox);
            }
            Err(Hindrance::Light | Hindrance::Sign) => {}
        }
    }
}

/// Whether who waits at a light has waited for long, and was not let go by a green in the meantime.
fn starves(scene: &Scene, asking: Asking, survey: &Survey) -> bool {
    let Asking { claim, waited, clock } = asking;
    let was_green = |light| scene.signals.green_at(light, clock) > claim.since;
    waited > STARVES && survey.lights.last().is_some_and(|it| was_green(it.0))
}

/// The driver at `spot`, who has surveyed its way, claims room there. Who comes onto a ring from outside does not stop
/// it.
fn claim_room(scene: &Scene, spot: Spot, claim: Claim, outbox: &mut Outbox) {
    let Outbox { survey, wants, rings, .. } = outbox;
    let way = [spot.chain, survey.refuge.chain];
    if scene.passages.rings.is_entered(way) {
        rings.push((way, claim));
    } else {
        let refuges = refuges(scene, scene.viewpoint(spot), survey);
        wants.extend(refuges.map(|it| (it, claim, survey.needed)));
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
    let granted = applicant.passage.map_or(0.0, |it| it.left().max(0.0));
    survey(scene, applicant, [granted, sight(applicant.speed)], is_held, out)
}
