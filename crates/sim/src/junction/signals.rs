//! What the traffic lights show: fixed programs depend on the time, actuated ones on the traffic.

use laneweave_network::{ChainIndex, InPlan, LightIndex, LightState, Network, Sign};
use serde::{Deserialize, Serialize};

use crate::junction::actuated_signals::Controller;
use crate::junction::offsets::Offsets;
use crate::state::clock::Clock;
use crate::state::lane::Lane;

/// A vehicle comes to a light if its front is within this distance before the line [m], ours: two seconds at 50 km/h.
const DETECTED_WITHIN: f64 = 30.0;

/// What all traffic lights show.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Signals {
    /// By light.
    shown: Vec<LightState>,
    /// For each light, its last green step before it came to show its present state; the first step if it has not been
    /// green.
    was_green: Vec<u32>,
    /// No fixed program switches before this time [s].
    steady_until: f64,
    controllers: Vec<Controller>,
    /// For each light its detectors; empty where no program needs them.
    detectors: Vec<Vec<Detector>>,
    /// The offsets that users set.
    offsets: Offsets,
    /// The lights that users set, whatever their programs say.
    set: Vec<(LightIndex, LightState)>,
}

/// A stretch of a lane before the line of a light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Detector {
    chain: ChainIndex,
    /// Where it begins and ends [m].
    from: f64,
    to: f64,
}

impl Detector {
    fn is_occupied(&self, lanes: &[Lane]) -> bool {
        let lane = &lanes[self.chain.at()];
        lane.motions().get(lane.ahead_of(self.from)).is_some_and(|it| it.x <= self.to)
    }
}

impl Signals {
    /// The signals of `network` at `clock`.
    pub(crate) fn new(network: &Network, clock: Clock) -> Signals {
        let junctions = &network.junctions;
        let controllers: Vec<Controller> =
            junctions.actuated.iter().map(|it| Controller::of(it, clock)).collect();
        let mut detectors = vec![Vec::new(); junctions.lights.len()];
        let mut asks = vec![false; junctions.lights.len()];
        controllers.iter().flat_map(Controller::lights).for_each(|it| asks[it.at()] = true);
        for chain in (0..network.chains.len() as u32).map(ChainIndex) {
            for stop in &junctions.on(chain).stops {
                let Sign::Light(light) = stop.sign else { continue };
                if asks[light.at()] {
                    detect(network, chain, stop.station, DETECTED_WITHIN, &mut detectors[light.at()]);
                }
            }
        }
        let shown = vec![LightState::Red; junctions.lights.len()];
        let was_green = vec![clock.step; junctions.lights.len()];
        let (offsets, set) = (Offsets::default(), Vec::new());
        let mut signals =
            Signals { shown, was_green, steady_until: 0.0, controllers, detectors, offsets, set };
        signals.show(network, clock);
        signals
    }

    /// Whether they have the same network and programs as `other`, in any state.
    pub(crate) fn fits(&self, other: &Signals, clock: Clock) -> bool {
        let Signals { shown, was_green, steady_until: _, controllers, detectors, offsets, set } = self;
        shown.len() == other.shown.len()
            && was_green.len() == other.was_green.len()
            && was_green.iter().all(|it| *it <= clock.step)
            && detectors == &other.detectors
            && offsets.fit(shown.len())
            && set.iter().all(|(light, _)| light.at() < shown.len())
            && controllers.len() == other.controllers.len()
            && controllers.iter().zip(&other.controllers).all(|(one, other)| one.fits(other, clock))
    }

    /// Number of lights.
    pub(crate) fn count(&self) -> usize {
        self.shown.len()
    }

    /// What a light shows.
    #[inline]
    pub fn shown(&self, light: LightIndex) -> LightState {
        self.shown[light.at()]
    }

    /// Last green step of a light, at `clock`.
    pub(crate) fn green_at(&self, light: LightIndex, clock: Clock) -> u32 {
        if self.shown(light) == LightState::Green { clock.step } else { self.was_green[light.at()] }
    }

    fn show(&mut self, network: &Network, clock: Clock) {
        let Signals { shown, was_green, steady_until, controllers, offsets, set, .. } = self;
        for (was_green, shown) in was_green.iter_mut().zip(&*shown) {
            if *shown == LightState::Green {
                *was_green = clock.step.saturating_sub(1);
            }
        }
        shown.clear();
        shown.extend(network.junctions.show(clock.time()));
        let time = clock.time();
        offsets.show(network, time, shown);
        *steady_until = time + network.junctions.steady_for(time).min(offsets.steady_for(network, time));
        for controller in controllers {
            controller.lights().for_each(|it| shown[it.at()] = controller.shows(it));
        }
        set.iter().for_each(|(light, state)| shown[light.at()] = *state);
    }

    /// Makes a light show a state, whatever its program says; `None`: it follows its program again.
    pub(crate) fn set(
        &mut self,
        network: &Network,
        light: LightIndex,
        shows: Option<LightState>,
        clock: Clock,
    ) {
        self.set.retain(|(it, _)| *it != light);
        self.set.extend(shows.map(|it| (light, it)));
        self.show(network, clock);
    }

    /// What a user makes a light show, if a user does.
    pub(crate) fn user_set(&self, light: LightIndex) -> Option<LightState> {
        self.set.iter().find(|(it, _)| *it == light).map(|(_, state)| *state)
    }

    /// The offset of a plan; of one that comes to a new offset, the new one [s].
    pub(crate) fn offset(&self, plan: InPlan) -> f64 {
        self.offsets.of(plan)
    }

    /// Gives the plan of a light, with cycles of this length [s], another offset [s]. Its phases take longer until it
    /// is there.
    pub(crate) fn set_offset(&mut self, plan: InPlan, cycle: f64, offset: f64) {
        self.offsets.set(plan, cycle, offset);
        // From the next step on its states may change.
        self.steady_until = 0.0;
    }

    /// Updates the lights at `clock`, by the vehicles that are detected on the `lanes`.
    pub(crate) fn switch(&mut self, network: &Network, lanes: &[Lane], clock: Clock) {
        self.offsets.advance(clock.dt);
        let Signals { controllers, detectors, .. } = self;
        for controller in controllers {
            controller
                .advance(clock.step, |light| detectors[light.at()].iter().any(|it| it.is_occupied(lanes)));
        }
        // By rounding, a light may switch a step earlier.
        let may_switch = clock.time() + clock.dt > self.steady_until;
        if may_switch || !self.controllers.is_empty() {
            self.show(network, clock);
        }
    }
}

/// Adds the detectors on the `distance` [m] before `line` [m] on `chain`.
fn detect(network: &Network, chain: ChainIndex, line: f64, distance: f64, detectors: &mut Vec<Detector>) {
    let from = line - distance;
    detectors.push(Detector { chain, from, to: line });
    if from < 0.0 {
        for back in &network.chain(chain).previous {
            detect(network, *back, network.chain(*back).length, -from, detectors);
        }
    }
}
