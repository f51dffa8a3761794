//! What the traffic lights show: fixed programs by the time, others by who comes.

use laneweave_network::{ChainIndex, LightIndex, LightState, Network, Sign};
use serde::{Deserialize, Serialize};

use crate::junction::controller::Controller;
use crate::state::clock::Clock;
use crate::state::lane::Lane;

/// Whose front is nearer to the line of a light comes to it [m], ours: at 50 km/h two seconds.
const DETECTED_WITHIN: f64 = 30.0;

/// What all traffic lights show.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Signals {
    /// By light.
    shown: Vec<LightState>,
    /// By light the last step in which it was green before the one in which it came to show what it shows; the
    /// beginning if there was none yet.
    was_green: Vec<u32>,
    /// Until then no fixed program switches [s].
    steady_until: f64,
    controllers: Vec<Controller>,
    /// By light where those are who come to it; empty where nobody asks.
    detectors: Vec<Vec<Detector>>,
}

/// A stretch of a lane before the line of a light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Detector {
    chain: ChainIndex,
    /// From where to where [m].
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
    /// Those of `network` at `clock`.
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
        let mut signals = Signals { shown, was_green, steady_until: 0.0, controllers, detectors };
        signals.show(network, clock);
        signals
    }

    /// Whether they are those of the same network and programs, whatever they show.
    pub(crate) fn fits(&self, other: &Signals, clock: Clock) -> bool {
        let Signals { shown, was_green, steady_until: _, controllers, detectors } = self;
        shown.len() == other.shown.len()
            && was_green.len() == other.was_green.len()
            && was_green.iter().all(|it| *it <= clock.step)
            && detectors == &other.detectors
            && controllers.len() == other.controllers.len()
            && controllers.iter().zip(&other.controllers).all(|(one, other)| one.fits(other, clock))
    }

    /// How many lights there are.
    pub(crate) fn count(&self) -> usize {
        self.shown.len()
    }

    /// What a light shows.
    #[inline]
    pub fn shown(&self, light: LightIndex) -> LightState {
        self.shown[light.at()]
    }

    /// Step in which a light was green last, as seen at `clock`.
    pub(crate) fn green_at(&self, light: LightIndex, clock: Clock) -> u32 {
        if self.shown(light) == LightState::Green { clock.step } else { self.was_green[light.at()] }
    }

    fn show(&mut self, network: &Network, clock: Clock) {
        let Signals { shown, was_green, steady_until, controllers, .. } = self;
        for (was_green, shown) in was_green.iter_mut().zip(&*shown) {
            if *shown == LightState::Green {
                *was_green = clock.step - 1;
            }
        }
        shown.clear();
        shown.extend(network.junctions.show(clock.time()));
        *steady_until = clock.time() + network.junctions.steady_for(clock.time());
        for controller in controllers {
            controller.lights().for_each(|it| shown[it.at()] = controller.shows(it));
        }
    }

    /// Shows what is shown from `clock` on, by who is detected on the `lanes`.
    pub(crate) fn switch(&mut self, network: &Network, lanes: &[Lane], clock: Clock) {
        let Signals { controllers, detectors, .. } = self;
        for controller in controllers {
            controller
                .advance(clock.step, |light| detectors[light.at()].iter().any(|it| it.is_occupied(lanes)));
        }
        // Rounding may make a light switch a step sooner.
        let may_switch = clock.time() + clock.dt > self.steady_until;
        if may_switch || !self.controllers.is_empty() {
            self.show(network, clock);
        }
    }
}

/// Adds the lanes on `distance` [m] before `line` [m] on `chain`.
fn detect(network: &Network, chain: ChainIndex, line: f64, distance: f64, detectors: &mut Vec<Detector>) {
    let from = line - distance;
    detectors.push(Detector { chain, from, to: line });
    if from < 0.0 {
        for back in &network.chain(chain).previous {
            detect(network, *back, network.chain(*back).length, -from, detectors);
        }
    }
}
