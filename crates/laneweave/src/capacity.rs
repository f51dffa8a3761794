//! How many vehicles an hour the entrances of a map can take in.

use laneweave_models::Style;
use laneweave_models::follow::{CarFollowing, Pace};
use laneweave_network::{ChainIndex, Network, Sign};
use laneweave_sim::{Class, Demand, Fleet, Place};

const SECONDS_PER_HOUR: f64 = 3600.0;

/// Capacity of the lanes of all origins of `demand` together [veh/h], for the mixture of `drivers`, each with its weight.
///
/// At a gate a lane takes in its densest stream in which all drive at one speed, as they do where nobody can overtake; at a
/// kerb as many as make room for each other on an empty road. Where all lanes of a place lead to a light before they fork, each
/// takes in no more than passes at green. What happens further down the road is not looked at, so this is an upper estimate.
pub fn entrance_capacity(network: &Network, demand: &Demand, drivers: &[(Style, f64)]) -> f64 {
    let mut known: Vec<(f64, Flows)> = Vec::new();
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
            let flows = match known.iter().find(|(it, _)| *it == limit) {
                Some((_, flows)) => *flows,
                None => {
                    let kinds = kinds(limit, drivers, &demand.fleet);
                    let flows = Flows { of_a_stream: of_a_stream(&kinds), from_rest: from_rest(&kinds) };
                    known.push((limit, flows));
                    flows
                }
            };
            let lane = if is_gate { flows.of_a_stream } else { flows.from_rest };
            let at_green = if are_all_lit { share * flows.of_a_stream } else { f64::INFINITY };
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

/// What a lane takes in under one limit [veh/s].
#[derive(Clone, Copy)]
struct Flows {
    of_a_stream: f64,
    from_rest: f64,
}

/// Vehicles of one class with drivers of one style.
struct Kind<'a> {
    /// Their share of all.
    share: f64,
    style: &'a Style,
    class: Class,
    /// Desired speed [m/s].
    desired: f64,
}

/// The kinds of vehicles on a lane under `limit` [m/s].
fn kinds<'a>(limit: f64, drivers: &'a [(Style, f64)], fleet: &Fleet) -> Vec<Kind<'a>> {
    let total: f64 = drivers.iter().map(|(_, weight)| weight).sum();
    let classes = fleet.shares();
    let pairs = drivers.iter().flat_map(|driver| classes.iter().map(move |class| (driver, *class)));
    let all = pairs.map(|((style, weight), (class, share))| Kind {
        share: share * weight / total,
        style,
        class,
        desired: class.desired_speed(style, limit),
    });
    all.filter(|it| it.share > 0.0).collect()
}

/// The largest flow of one lane in which all drive at one speed [veh/s].
fn of_a_stream(kinds: &[Kind]) -> f64 {
    /// Speeds that are tried, below that of the slowest.
    const TRIED: u32 = 200;
    let slowest = kinds.iter().map(|it| it.desired).fold(f64::INFINITY, f64::min);
    let flow = |speed: f64| {
        let spacing = |it: &Kind| {
            let pace = Pace::new(speed, it.desired);
            it.share * (it.style.follow.equilibrium_gap(pace) + it.class.body().length)
        };
        speed / kinds.iter().map(spacing).sum::<f64>()
    };
    (1..TRIED).map(|it| flow(slowest * f64::from(it) / f64::from(TRIED))).fold(0.0, f64::max)
}

/// Flow of those who start from rest, each as soon as the one before has left room for it on an empty road [veh/s].
fn from_rest(kinds: &[Kind]) -> f64 {
    let time = |it: &Kind| {
        let free = Pace::new(0.0, it.desired);
        let acceleration = it.style.follow.acceleration(free, None).min(it.class.strength());
        it.share * (2.0 * (it.class.body().length + it.style.safety.min_gap) / acceleration).sqrt()
    };
    1.0 / kinds.iter().map(time).sum::<f64>()
}
