//! How many vehicles an hour the entrances of a map can take in.

use laneweave_models::Style;
use laneweave_network::Network;
use laneweave_sim::Class;

const SECONDS_PER_HOUR: f64 = 3600.0;

/// Capacity of all entrance lanes together [veh/h] for the mixture of `drivers` (each with its weight) with a share
/// of `trucks`.
///
/// Each driver takes up a lane for at least the time that it takes up in its own densest stream, one over the capacity
/// of its car-following model at the lane's speed limit; the lane's capacity is one over the mean of these times.
/// Who is held up by slower vehicles takes longer, so this is an upper estimate.
pub fn entrance_capacity(network: &Network, drivers: &[(Style, f64)], trucks: f64) -> f64 {
    let limits: Vec<f64> = network
        .entrances
        .iter()
        .flat_map(|gate| &gate.chains)
        .map(|chain| network.chain(*chain).limit(0.0))
        .collect();
    let mut known: Vec<(f64, f64)> = Vec::new();
    let mut capacity = 0.0;
    for limit in limits {
        let lane = match known.iter().find(|(it, _)| *it == limit) {
            Some((_, lane)) => *lane,
            None => {
                let lane = lane_capacity(limit, drivers, trucks);
                known.push((limit, lane));
                lane
            }
        };
        capacity += lane;
    }
    capacity * SECONDS_PER_HOUR
}

/// Capacity of one lane under `limit` [m/s], in veh/s.
fn lane_capacity(limit: f64, drivers: &[(Style, f64)], trucks: f64) -> f64 {
    let total: f64 = drivers.iter().map(|(_, weight)| weight).sum();
    let time = |style: &Style, class: Class| {
        let desired = class.desired_speed(style, limit);
        1.0 / style.follow.capacity(desired, class.body().length)
    };
    let mean_time: f64 = drivers
        .iter()
        .filter(|(_, weight)| *weight > 0.0)
        .map(|(style, weight)| {
            let share = weight / total;
            share * ((1.0 - trucks) * time(style, Class::Car) + trucks * time(style, Class::Truck))
        })
        .sum();
    1.0 / mean_time
}
