//! How many vehicles an hour the entrances of a map can take in.

use laneweave_models::Style;
use laneweave_models::follow::{CarFollowing, Pace};
use laneweave_network::Network;
use laneweave_sim::{Class, Demand, Fleet, Place};

const SECONDS_PER_HOUR: f64 = 3600.0;

/// Capacity of the lanes of all origins of `demand` together [veh/h], for the mixture of `drivers`, each with its weight.
///
/// Each driver takes up a lane for at least some time; the lane's capacity is one over the mean of these times. At a gate
/// it is the time that it takes up in its own densest stream, one over the capacity of its car-following model at
/// the lane's speed limit; at a kerb the time in which it makes room for the next on an empty road.
/// Who is held up by slower vehicles takes longer, so this is an upper estimate.
pub fn entrance_capacity(network: &Network, demand: &Demand, drivers: &[(Style, f64)]) -> f64 {
    let mut known: Vec<((bool, f64), f64)> = Vec::new();
    let mut capacity = 0.0;
    for place in demand.origins.iter().map(|it| &it.place) {
        let (is_gate, station) = match place {
            Place::Gate(_) => (true, 0.0),
            Place::Kerb(kerb) => (false, kerb.station),
        };
        for chain in place.chains() {
            let limit = network.chain(*chain).limit(station);
            let key = (is_gate, limit);
            let lane = match known.iter().find(|(it, _)| *it == key) {
                Some((_, lane)) => *lane,
                None => {
                    let time = if is_gate { time_in_stream } else { time_to_make_room };
                    let lane = lane_capacity(limit, drivers, &demand.fleet, time);
                    known.push((key, lane));
                    lane
                }
            };
            capacity += lane;
        }
    }
    capacity * SECONDS_PER_HOUR
}

/// Time [s] that a driver takes up in its own densest stream under `limit` [m/s].
fn time_in_stream(style: &Style, class: Class, limit: f64) -> f64 {
    let desired = class.desired_speed(style, limit);
    1.0 / style.follow.capacity(desired, class.body().length)
}

/// Time [s] in which a driver who starts from rest under `limit` [m/s] has left room for another of its kind.
fn time_to_make_room(style: &Style, class: Class, limit: f64) -> f64 {
    let free = Pace::new(0.0, class.desired_speed(style, limit));
    let acceleration = style.follow.acceleration(free, None).min(class.strength());
    (2.0 * (class.body().length + style.safety.min_gap) / acceleration).sqrt()
}

/// Capacity of one lane under `limit` [m/s], in veh/s, of drivers who take it up for `time` each.
fn lane_capacity(
    limit: f64,
    drivers: &[(Style, f64)],
    fleet: &Fleet,
    time: fn(&Style, Class, f64) -> f64,
) -> f64 {
    let total: f64 = drivers.iter().map(|(_, weight)| weight).sum();
    let mean_time: f64 = drivers
        .iter()
        .filter(|(_, weight)| *weight > 0.0)
        .map(|(style, weight)| {
            let of_class = |(class, share): (Class, f64)| share * time(style, class, limit);
            weight / total * fleet.shares().into_iter().map(of_class).sum::<f64>()
        })
        .sum();
    1.0 / mean_time
}
