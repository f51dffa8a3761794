//! Trips that begin and end on one lanelet: they are counted, but left out of means, because they show nothing of
//! traffic.

use laneweave_network::Position;
use laneweave_sim::{Counts, Event, World};
use serde::{Deserialize, Serialize};

/// The trips within one lanelet so far, with their part of the counters of all trips.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ShortTrips {
    /// Their number.
    pub count: u64,
    duration: f64,
    planned: u64,
    delay: f64,
    stops: u64,
}

/// Means over the completed trips, without those within one lanelet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TripMeans {
    /// Time on the map [s].
    pub duration: Option<f64>,
    /// Delay beyond the time on a free road, over the trips that had a distance to drive [s].
    pub delay: Option<f64>,
    /// Number of stops.
    pub stops: Option<f64>,
}

impl ShortTrips {
    /// Counts the trips that were completed in the last step.
    pub fn observe(&mut self, world: &World) {
        for event in world.events() {
            let Event::Left { duration, chain, motion, trip: Some(trip), .. } = event else { continue };
            let network = world.network();
            let x = motion.x.min(network.chain(*chain).length);
            let id = |at: Position| network.lanelet_at(at).0.id;
            if id(trip.from) != id(Position::new(*chain, x)) {
                continue;
            }
            self.count += 1;
            self.duration += duration;
            self.stops += u64::from(trip.stops);
            if let Some(free) = trip.free_time {
                self.planned += 1;
                // Free times are counted in tenths of a second.
                self.delay += duration - (10.0 * free).round() / 10.0;
            }
        }
    }

    /// The means over the other trips of `counts`.
    pub fn means_without(&self, counts: &Counts) -> TripMeans {
        let mean = |sum: f64, count: u64| (count > 0).then(|| sum / count as f64);
        let left = counts.left - self.count;
        TripMeans {
            duration: mean(counts.trip_time - self.duration, left),
            delay: mean(counts.delay - self.delay, counts.planned - self.planned),
            stops: mean((counts.stops - self.stops) as f64, left),
        }
    }
}
