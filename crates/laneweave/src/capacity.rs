//! How many vehicles an hour the entrances of a map can take in.

use laneweave_models::Style;
use laneweave_models::follow::{CarFollowing, Pace};
use laneweave_network::{ChainIndex, Network, Sign};
use laneweave_sim::{Class, Demand, Fleet, Place};

const SECONDS_PER_HOUR: f64 = 3600.0;

/// Capacity of the lanes of all origins of `demand` together [veh/h], for the mixture of `drivers`, each with its weight.
///
/// Each driver takes up a lane for at least some time; the lane's capacity is one over the mean of these times. At a gate
/// it is the time that it takes up in its own densest stream, one over the capacity of its car-following model at
/// the lane's speed limit; at a kerb the time in which it makes room for the next on an empty road.
/// Where all lanes of a place lead to a light before they fork, each takes in no more than passes at green. Who is held up by
/// slower vehicles takes longer, so this is an upper estimate.
pub fn entrance_capacity(network: &Network, demand: &Demand, drivers: &[(Style, f64)]) -> f64 {
    let mut known: Vec<((bool, f64), f64)> = Vec::new();
    let mut capacity = 0.0;
    for place in demand.origins.iter().map(|it| &it.place) {
        let (is_gate, station) = match place {
            Place::Gate(_) => (true, 0.0),
            Place::Kerb(kerb) => (false, kerb.station),
        };
        let shares: Vec<f64> = place.chains().iter().map(|it| green_share(network, *it, station)).collect();
        // Who may change to a lane without a light is not held up by one.
        let are_all_lit = shares.iter().all(|it| *it < 1.0);
        for (chain, share) in place.chains().iter().zip(&shares) {
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
            let at_green = if are_all_lit {
                share * lane_capacity(limit, drivers, &demand.fleet, time_in_stream)
            } else {
                f64::INFINITY
            };
            capacity += lane.min(at_green);
        }
    }
    capacity * SECONDS_PER_HOUR
}

/// Least share of the time that the lights are green to which a lane leads from `station` [m] of `chain` on before it forks.
fn green_share(network: &Network, mut chain: ChainIndex, mut station: f64) -> f64 {
    let Network { chains, junctions, .. } = network;
    let mut least = 1.0_f64;
    // A lane may lead in a ring.
    for _ in 0..chains.len() {
        for stop in junctions.on(chain).stops.iter().filter(|it| it.station > station) {
            if let Sign::Light(light) = stop.sign {
                least = least.min(junctions.lights[light.at()].program.green_share());
            }
        }
        let [next] = network.chain(chain).following[..] else { break };
        (chain, station) = (next, f64::NEG_INFINITY);
    }
    least
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
