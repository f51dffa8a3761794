//! Requests that concern other lanes are granted one after the other, the most urgent first. Of two drivers who want
//! one gap exactly one goes, in any order of requests and on any thread.

use laneweave_models::Concentration;
use laneweave_network::Position;

use crate::driver::attention::concentration;
use crate::driver::gap::gap;
use crate::driver::plan::{Ask, Request, Want};
use crate::junction::reservations::NO_RESERVATION;
use crate::junction::state::JunctionState;
use crate::record::events::LaneChange;
use crate::record::log::Log;
use crate::route::roads::Roads;
use crate::state::lane::{Counterpart, DriverState, Entry, Kinematics, LaneChangeState, Phase};
use crate::state::previous_lanes::PreviousLanes;
use crate::state::traffic::Traffic;
use crate::step::work::Work;
use crate::view::scene::{Scene, Spot};

/// Grants the requests that can be granted.
pub(crate) fn resolve(
    roads: &Roads,
    traffic: &mut Traffic,
    junctions: &JunctionState,
    log: &mut Log,
    work: &mut Work,
) {
    let mut resolving = Resolving { roads, traffic, junctions, log };
    let requests = &mut work.outbox().requests;
    requests.sort_unstable_by(|a, b| {
        b.urgency.total_cmp(&a.urgency).then(a.id.cmp(&b.id)).then(a.ask.rank().cmp(&b.ask.rank()))
    });
    for request in requests.drain(..) {
        if let Some(index) = resolving.traffic.lane(request.chain).find(request.id, request.x) {
            resolving.grant(Spot { chain: request.chain, index }, &request);
        }
    }
}

/// What resolving a request changes, and what it depends on.
struct Resolving<'a> {
    roads: &'a Roads,
    traffic: &'a mut Traffic,
    junctions: &'a JunctionState,
    log: &'a mut Log,
}

impl Resolving<'_> {
    fn scene(&self) -> Scene<'_> {
        Scene::of(self.roads, self.traffic, self.junctions)
    }

    fn grant(&mut self, spot: Spot, request: &Request) {
        let lane = self.traffic.lane(spot.chain);
        let (phase, progress) =
            (lane.drivers()[spot.index].phase, lane.lane_change_states()[spot.index].progress);
        match request.ask {
            Ask::Want(want) if phase == Phase::Cruises => self.begin_to_want(spot, request, &want),
            Ask::Change if phase == Phase::Wants => self.begin_to_change(spot),
            Ask::LetIn { follower, chain, x, gap, speed } => {
                let since = lane.lane_change_states()[spot.index].since;
                let found = self.traffic.lane(chain).find(follower, x);
                let sees_it = |index: &usize| {
                    let behind = Spot { chain, index: *index };
                    let scene = self.scene();
                    let motion = scene.motion(behind);
                    // Who stands there keeps others from leaving a junction.
                    let is_in_the_way = scene.takes_kept_space(chain, motion.x, motion.rear());
                    self.has_seen(behind, since)
                        && !scene.has_reservation(behind, f64::from(gap))
                        && !is_in_the_way
                };
                if let Some(index) = found.filter(sees_it) {
                    let (_, driver, lane_change) = self.traffic.lane_mut(chain).entry_mut(index);
                    // Of two drivers who want in before it, the nearer one comes first.
                    if driver.phase == Phase::Cruises && gap < lane_change.lets_in.0 {
                        lane_change.lets_in = (gap, speed);
                        driver.needs_full_update = true;
                    }
                }
            }
            // A vehicle that has crossed the line in the meantime goes on.
            Ask::Abort if phase == Phase::Changes && progress < 0.5 => self.turn_back(spot),
            _ => {}
        }
    }

    /// Whether the driver at `spot` has seen a signal that was set in step `since`. An inattentive driver sees the
    /// lane beside as it was when it last considered lanes.
    fn has_seen(&self, spot: Spot, since: u32) -> bool {
        let lane = self.traffic.lane(spot.chain);
        let (id, driver) = (lane.motions()[spot.index].id, &lane.drivers()[spot.index]);
        let attention = &self.roads.style(driver.parameters).attention;
        match concentration(attention, self.roads.random(), id, self.traffic.clock().time()) {
            Concentration::Concentrated => true,
            // Its last consideration is at most one epoch before the next, which is due.
            Concentration::Inattentive => {
                since + self.traffic.clock().steps(attention.inattentive.epoch) <= driver.due
            }
        }
    }

    fn begin_to_want(&mut self, spot: Spot, request: &Request, want: &Want) {
        let step = self.traffic.clock().step;
        let (motion, driver, lane_change) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        driver.phase = Phase::Wants;
        lane_change.side = want.side;
        lane_change.kind = want.kind;
        lane_change.since = step;
        lane_change.urgency = request.urgency;
        lane_change.gain = want.appraisal.gain as f32;
        let here = Position::new(spot.chain, motion.x);
        lane_change.record = self.log.keep_change(LaneChange {
            vehicle: motion.id,
            parameters: driver.parameters,
            class: driver.class,
            started: 0.0,
            time: 0.0,
            duration: 0.0,
            from: here,
            to: here,
            side: want.side,
            kind: want.kind,
            speed: motion.speed,
            speed_gain: f64::from(want.speed_gain),
            appraisal: want.appraisal,
            gap_ahead: f64::INFINITY,
            gap_behind: f64::INFINITY,
            ttc_ahead: f64::INFINITY,
            ttc_behind: f64::INFINITY,
            is_completed: false,
        });
    }

    /// Inserts a shadow into the target lane, if the gap is still acceptable.
    fn begin_to_change(&mut self, spot: Spot) {
        let scene = self.scene();
        let lane_change = scene.lanes[spot.chain.at()].lane_change_states()[spot.index];
        // A vehicle that has just been granted a reservation keeps its lane.
        if scene.has_reservation(spot, f64::NEG_INFINITY) {
            return;
        }
        let Some(gap) = gap(&scene, spot, lane_change.side) else { return };
        if gap.is_coming || gap.accepted(&scene, spot, self.traffic.clock()).is_err() {
            return;
        }
        let speed = scene.motion(spot).speed;
        let urgency = gap.urgency_on_road(&scene, spot, speed).unwrap_or(lane_change.urgency);
        let [gap_ahead, gap_behind, ttc_ahead, ttc_behind] = gap.measures(&scene, spot);
        let headway_relaxation = gap.headway_relaxation(&scene, spot) as f32;
        let clock = self.traffic.clock();
        let record = self.log.change_mut(lane_change.record);
        *record =
            LaneChange { started: clock.time(), gap_ahead, gap_behind, ttc_ahead, ttc_behind, ..*record };
        let lane = self.traffic.lane_mut(spot.chain);
        let (motion, driver, lane_change) = lane.entry_mut(spot.index);
        motion.headway_relaxation = headway_relaxation;
        driver.phase = Phase::Changes;
        lane_change.progress = 0.0;
        lane_change.urgency = urgency;
        lane_change.since = clock.step;
        let (x, stretch) = (gap.x, gap.scale as f32);
        lane_change.counterpart = Some(Counterpart { chain: gap.chain, x, stretch });
        let Entry { motion, driver, lane_change } = lane.entry(spot.index);
        let shadow = Entry {
            motion: Kinematics { x, ..motion },
            driver: DriverState { is_shadow: true, needs_full_update: false, ..driver },
            lane_change: LaneChangeState {
                counterpart: Some(Counterpart { chain: spot.chain, x: motion.x, stretch: 1.0 }),
                stretch,
                previous_lanes: PreviousLanes::NONE,
                last_place: f64::INFINITY,
                lets_in: LaneChangeState::NOBODY,
                minds_offside: false,
                reservation: NO_RESERVATION,
                ..lane_change
            },
        };
        self.traffic.insert(gap.chain, shadow);
    }

    /// Makes both entries of a vehicle go back.
    fn turn_back(&mut self, spot: Spot) {
        let (motion, driver, lane_change) = self.traffic.lane_mut(spot.chain).entry_mut(spot.index);
        driver.phase = Phase::Aborts;
        let (id, counterpart) = (motion.id, lane_change.counterpart);
        let Some(counterpart) = counterpart else { return };
        let lane = self.traffic.lane_mut(counterpart.chain);
        if let Some(index) = lane.find(id, counterpart.x) {
            lane.entry_mut(index).1.phase = Phase::Aborts;
        }
    }
}

impl Ask {
    fn rank(&self) -> u8 {
        match self {
            Ask::Abort => 0,
            Ask::Change => 1,
            Ask::Want(_) => 2,
            Ask::LetIn { .. } => 3,
        }
    }
}
