//! Whether a batch that is read again fits the run: a log that somebody has changed may name what there is not.

use laneweave_network::Position;

use super::batch::Batch;
use super::frame::Frame;
use super::names::Names;

impl Batch {
    /// Whether all that it names is there.
    pub(super) fn is_sound(&self, names: &Names) -> bool {
        let is_there = |at: &Position| names.has_place(*at);
        match self {
            Batch::Frame(frame) => frame.is_sound(names),
            Batch::LaneChanges(changes) => changes
                .iter()
                .all(|it| names.has_driver(it.parameters) && [it.from, it.to].iter().all(is_there)),
            Batch::Incidents(incidents) => incidents.iter().all(|it| {
                it.driver_parameters.iter().all(|it| names.has_driver(*it)) && it.places.iter().all(is_there)
            }),
            Batch::Trips(trips) => trips.iter().all(|it| {
                let ends = it.end.map(|it| it.at);
                names.has_driver(it.record.parameters)
                    && is_there(&it.record.from)
                    && ends.as_ref().is_none_or(is_there)
            }),
            Batch::Flows(traffic) | Batch::Lanelets(traffic) => {
                traffic.counts.len() == names.network.lanelets.len()
            }
            Batch::Commands(_) | Batch::Mark(_) | Batch::End => true,
        }
    }
}

impl Frame {
    /// Whether all that it names is there, and every vehicle belongs to an instant.
    fn is_sound(&self, names: &Names) -> bool {
        let ends = || self.ends();
        let is_ordered = ends().zip(ends().skip(1)).all(|(one, next)| one <= next);
        is_ordered
            && ends().last().unwrap_or(0) == self.seen().len()
            && self.seen().iter().all(|it| {
                names.has_driver(it.parameters)
                    && names.has_place(Position { chain: it.chain, x: it.motion.x })
                    && it.previous_lanes.known().all(|chain| names.has_place(Position { chain, x: 0.0 }))
            })
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use laneweave_network::{ChainIndex, Point};
    use laneweave_scenario::scenario::{Origin, Scenario, prepare};
    use laneweave_sim::{Class, Incident, IncidentKind};

    use super::*;
    use crate::output::traffic::Traffic;

    #[test]
    fn a_batch_of_places_and_drivers_that_there_are_not_is_not_sound() {
        let map = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps/on_ramp.osm");
        let scenario = Scenario::of_map(map);
        let prepared = prepare(&scenario, &Origin::default()).expect("the map is sound");
        let (names, network) = (Names::of(&prepared.world, &scenario), prepared.world.network());
        let chains = network.chains.len() as u32;
        let drivers = names.styles().count() as u32;
        let incident = |[chain, parameters]: [u32; 2], x| {
            Batch::Incidents(vec![Incident {
                kind: IncidentKind::Overlap,
                time: 1.0,
                vehicles: [1, 2],
                driver_parameters: [0, parameters],
                classes: [Class::Car; 2],
                places: [Position { chain: ChainIndex(chain), x }; 2],
                at: Point::new(0.0, 0.0, 0.0),
                speeds: [0.0; 2],
                depth: 0.1,
            }])
        };
        assert!(incident([chains - 1, drivers - 1], 5.0).is_sound(&names));
        assert!(!incident([chains, 0], 5.0).is_sound(&names));
        assert!(!incident([0, drivers], 5.0).is_sound(&names));
        assert!(!incident([0, 0], f64::NAN).is_sound(&names));
        let mut traffic = Traffic::of(network, 0.0);
        assert!(Batch::Flows(traffic.clone()).is_sound(&names));
        traffic.counts.pop();
        assert!(!Batch::Flows(traffic).is_sound(&names));
        let mut frame = Frame::default();
        frame.sample(&prepared.world);
        assert!(Batch::Frame(frame).is_sound(&names));
    }
}
