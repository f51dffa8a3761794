//! Remarks on valid maps on which traffic may look odd: one function for each remark.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt;

use laneweave_maps::Map;
use laneweave_models::Style;
use laneweave_network::{
    Beside, Chain, ChainIndex, Classes, Id, Lanelet, Network, Polyline, Position, Side, turn,
};
use laneweave_sim::{Place, Places};
use laneweave_study::units::KMH_PER_MPS;
use serde::Serialize;

/// A remark on the traffic of a map.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Remark {
    /// The property of the map, and its effect on traffic.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.what, self.remedy)
    }
}

/// Maximum of items in a list.
const MOST_REMARKS: usize = 5;
/// Limits up to this make traffic very slow, and are often placeholders for unknown limits [m/s]. Ours.
const CRAWL: f64 = 10.0 / KMH_PER_MPS;
/// No higher limit exists [m/s]. Ours.
const HIGHEST: f64 = 200.0 / KMH_PER_MPS;
/// A limit is odd if the ratio of two successive limits is below this. Ours.
const JUMP: f64 = 0.5;
/// A comfortable deceleration [m/s²], that of the usual drivers.
const BRAKING: f64 = 2.0;
/// An entrance is short if it is less than this share of the braking distance from its limit. Ours.
const MUCH_SHORTER: f64 = 0.5;
/// A stretch with a shorter travel time is too short for discretionary lane changes: the change itself takes 3 to 6 s
/// [s].
const TIME_TO_CHANGE: f64 = 5.0;
/// Number of chains over which a stretch is followed. Ours.
const MOST_CHAINS: usize = 6;
/// Maximum lateral acceleration of drivers for a longer time [m/s²]: twice the comfortable one (AASHTO's side
/// friction of 0.2 at low speeds, from memory).
const LATERAL: f64 = 4.0;
/// The curvature of a lane is computed from its directions over this distance [m]; corners of drawn lines are closer.
/// Ours.
const SPAN: f64 = 10.0;
/// The shortest distance for that [m]. Ours.
const SHORTEST_SPAN: f64 = 4.0;

/// All remarks on `map` for `drivers`, if they are known; on its network with its junctions, trips start and end at
/// `places`. The most important remark comes first.
pub fn remarks(map: &Map, network: &Network, places: &Places, drivers: &[Style]) -> Vec<Remark> {
    let all = [
        closed(places),
        room_to_change(network),
        shared_at_the_edge(network),
        narrow_lanes(network),
        limits_of_law(map),
        extreme_limits(&network.lanelets),
        jumps(&network.lanelets),
        turns_at_once(&network.lanelets),
        short_entrances(network, places),
        bends(network, drivers),
    ];
    all.into_iter().flatten().take(MOST_REMARKS).collect()
}

pub(crate) fn remark(what: String, remedy: &str) -> Option<Remark> {
    Some(Remark { what, remedy: remedy.into() })
}

/// No vehicle enters the map or leaves it.
fn closed(places: &Places) -> Option<Remark> {
    let inner_places = places.origins.iter().filter(|it| matches!(it, Place::Inside(_))).count();
    if inner_places == 0 {
        return None;
    }
    let what = format!(
        "closed map (no entrance or no exit): trips start from rest and end on {inner_places} lanelets"
    );
    remark(what, "for through traffic, make roads begin and end with a lanelet of 10 m or more")
}

/// Stretches with lane changes are short, or there are none.
fn room_to_change(network: &Network) -> Option<Remark> {
    let chains = network.chains.iter();
    let stretches =
        chains.flat_map(|chain| stretches(chain).map(move |it| run_of(network, chain, it, MOST_CHAINS)));
    let Some((length, time)) = stretches.max_by(|a, b| a.1.total_cmp(&b.1)) else {
        let what = "lane changes are possible nowhere: styles differ in car-following only".into();
        return remark(what, "mark lane lines that may be crossed as dashed, or choose another map");
    };
    if time >= TIME_TO_CHANGE {
        return None;
    }
    let total: f64 = network.chains.iter().map(beside_another).sum();
    let what = format!(
        "lane changes are possible on {total:.0} m of lane, at most {length:.0} m ({time:.1} s) without interruption: there will be \
         hardly any discretionary lane changes"
    );
    remark(what, "to study lane changes, choose a map with longer lanes")
}

/// The stretches of `chain` from which a change is allowed, to either side.
fn stretches(chain: &Chain) -> impl Iterator<Item = &Beside> {
    Side::BOTH.into_iter().flat_map(|side| chain.stretches(side))
}

/// Length, and travel time at the limit, of the longest stretch that begins with `stretch` of `chain` and continues
/// along the chains that follow, at most so `many` [m, s].
fn run_of(network: &Network, chain: &Chain, stretch: &Beside, many: usize) -> (f64, f64) {
    /// Stretches that are nearer to each other count as one [m].
    const NEAR: f64 = 1.0;
    let length = stretch.end - stretch.start;
    let time = length / chain.limit(stretch.start);
    if many == 0 || stretch.end < chain.length - NEAR {
        return (length, time);
    }
    let following = chain.following.iter().map(|it| network.chain(*it));
    let next =
        following.flat_map(|next| stretches(next).filter(|it| it.start <= NEAR).map(move |it| (next, it)));
    let runs = next.map(|(next, it)| run_of(network, next, it, many - 1));
    let (beyond, later) = runs.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
    (length + beyond, time + later)
}

/// Length of `chain` on which a change to either side is allowed [m].
fn beside_another(chain: &Chain) -> f64 {
    let mut all: Vec<[f64; 2]> = stretches(chain).map(|it| [it.start, it.end]).collect();
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut total, mut until) = (0.0, 0.0f64);
    for [start, end] in all {
        total += (end - start.max(until)).max(0.0);
        until = until.max(end);
    }
    total
}

/// Entrances that share a conflict area with other lanes at the edge of the map.
fn shared_at_the_edge(network: &Network) -> Option<Remark> {
    /// Maximum distance from the edge to such a conflict area [m].
    const AT_ONCE: f64 = 15.0;
    let junctions = &network.junctions;
    let shares = |chain: &ChainIndex| {
        let mut crossings = junctions.on(*chain).crossings.iter();
        let near = crossings.find(|it| junctions.reach(**it).start < AT_ONCE)?;
        let [one, other] = [*chain, junctions.other_side(*near).chain];
        Some(
            [(one, 0.0), (other, 0.0)]
                .map(|(chain, station)| network.lanelet_at(Position::new(chain, station)).0.id),
        )
    };
    let found: Vec<[Id; 2]> = network.entrances.iter().flat_map(|it| &it.chains).filter_map(shares).collect();
    let [one, other] = *found.first()?;
    let what = format!(
        "entrance {one}{} has a conflict area at the edge of the map, such as with lanelet {other}: vehicles enter one after the \
         other, and wait outside for a reservation",
        and_more(found.len() - 1)
    );
    remark(what, "extend the road to where vehicles can pass each other, if it continues")
}

/// Lanes that are too narrow for cars or for long vehicles.
fn narrow_lanes(network: &Network) -> Option<Remark> {
    let first_id = |chain: &Chain| network.lanelets[chain.lanelets[0].at()].id;
    let narrow = || network.chains.iter().filter(|it| it.is_tight_for_long || it.open != Chain::WIDE);
    let is_closed = |it: &&Chain| it.open[0][0] > it.open[0][1];
    // Its map lets long vehicles use it.
    let is_shut = |it: &&Chain| it.classes != network.lanelets[it.lanelets[0].at()].classes;
    let closed: Vec<Id> = narrow().filter(is_closed).map(first_id).collect();
    let shut: Vec<Id> = network.chains.iter().filter(is_shut).map(first_id).collect();
    let others = || narrow().filter(|it| !is_closed(it) && !is_shut(it));
    let ends: Vec<Id> = others().filter(|it| !it.is_tight_for_long).map(first_id).collect();
    let tight: Vec<Id> = others().filter(|it| it.is_tight_for_long).map(first_id).collect();
    let parts = [
        (closed, "narrower than a car: no vehicle drives there"),
        (
            shut,
            "narrower than 2.55 m and end beside others: closed to long vehicles, which could not leave them",
        ),
        (
            ends,
            "begin or end where they are too narrow for a car (1.8 m) or a long vehicle (2.55 m), or for it beside a long \
             vehicle in a bend",
        ),
        (tight, "narrower than 2.55 m: long vehicles avoid them"),
    ];
    let told = parts
        .iter()
        .filter(|(ids, _)| !ids.is_empty())
        .map(|(ids, what)| format!("{} {what} (as at lanelet {})", ids.len(), ids[0]));
    let told: Vec<String> = told.collect();
    if told.is_empty() {
        return None;
    }
    remark(
        format!("of {} lanes {}", network.chains.len(), told.join("; ")),
        "correct their borders if this is not intended",
    )
}

/// Lanes for other classes than those that drive.
pub(crate) fn unused_lanes(network: &Network, driven: Classes) -> Option<Remark> {
    let is_unused = |it: &&Lanelet| it.classes.iter().all(|class| !driven.has(class));
    let unused: Vec<&Lanelet> = network.lanelets.iter().filter(is_unused).collect();
    let first = unused.first()?;
    let what = format!(
        "lanelet {}{} is for {} only, and the demand has none of these: nobody drives there",
        first.id,
        and_more(unused.len() - 1),
        first.classes.names()
    );
    remark(what, "give the demand a share of them, such as demand.buses, or a line of buses")
}

/// Legal limits that replace missing ones.
fn limits_of_law(map: &Map) -> Option<Remark> {
    let mut limits = map.contents.limits_of_law.clone();
    if limits.is_empty() {
        return None;
    }
    limits.sort_by(f64::total_cmp);
    let shown = limits.chunk_by(|a, b| a == b).map(|it| format!("{:.0} km/h on {}", it[0], it.len()));
    let what = format!(
        "{} of {} lanelets have no speed limit: that of the traffic law applies ({})",
        limits.len(),
        map.network.lanelets.len(),
        shown.collect::<Vec<_>>().join(", ")
    );
    remark(what, "add speed_limit to them, or choose the law (--law, or map_options.law in a scenario)")
}

/// Limits that are probably not intended.
fn extreme_limits(lanelets: &[Lanelet]) -> Option<Remark> {
    let slow = lanelets.iter().filter(|it| it.speed_limit <= CRAWL);
    let fast = lanelets.iter().filter(|it| it.speed_limit > HIGHEST);
    let odd: Vec<&Lanelet> = slow.chain(fast).collect();
    let first = odd.first()?;
    let what = format!(
        "{} of {} lanelets have a speed limit up to {:.0} or above {:.0} km/h (lanelet {}: {}), and drivers keep to it",
        odd.len(),
        lanelets.len(),
        CRAWL * KMH_PER_MPS,
        HIGHEST * KMH_PER_MPS,
        first.id,
        kmh(first.speed_limit)
    );
    remark(what, "correct speed_limit if this is not intended")
}

/// Whether a lanelet is a turn.
fn turns(lanelet: &Lanelet) -> bool {
    /// By this angle, a lanelet turns at least from its begin to its end [rad]; ours.
    const TURN: f64 = 0.5;
    let [begin, end] = [0.0, lanelet.length()].map(|it| lanelet.centre.heading(it));
    turn(begin, end).abs() >= TURN
}

/// Limits that change by more than half from one lanelet to the next. A low limit in a turn is meant so.
fn jumps(lanelets: &[Lanelet]) -> Option<Remark> {
    let pairs =
        lanelets.iter().flat_map(|it| it.following.iter().map(move |next| (it, &lanelets[next.at()])));
    let is_jump = |a: f64, b: f64| a.min(b) < JUMP * a.max(b);
    let is_meant = |a: &Lanelet, b: &Lanelet| turns(if a.speed_limit < b.speed_limit { a } else { b });
    let odd: Vec<_> =
        pairs.filter(|(a, b)| is_jump(a.speed_limit, b.speed_limit) && !is_meant(a, b)).collect();
    let (from, to) = odd.first()?;
    let what = format!(
        "in {} places the speed limit changes by more than half at once (lanelet {} to {}: {} to {}): vehicles bunch or spread \
         there",
        odd.len(),
        from.id,
        to.id,
        kmh(from.speed_limit),
        kmh(to.speed_limit)
    );
    remark(what, "change the limits in steps, or correct speed_limit")
}

/// Lanelets that begin in another direction than the one before ends in.
fn turns_at_once(lanelets: &[Lanelet]) -> Option<Remark> {
    let pairs =
        lanelets.iter().flat_map(|it| it.following.iter().map(move |next| (it, &lanelets[next.at()])));
    let turn = |(from, to): &(&Lanelet, &Lanelet)| {
        let turn = to.centre.heading(0.0) - from.centre.heading(from.length());
        turn.cos().clamp(-1.0, 1.0).acos()
    };
    let odd: Vec<_> = pairs.map(|it| (it, turn(&it))).filter(|it| it.1 > FRAC_PI_2).collect();
    let ((from, to), turn) = odd.first()?;
    let what = format!(
        "in {} places a lane turns by more than 90° at one point (lanelet {} to {}: {:.0}°): vehicles turn on the spot there",
        odd.len(),
        from.id,
        to.id,
        turn.to_degrees()
    );
    remark(what, "draw the bend, or disconnect the lanelets if nobody can drive there")
}

/// Entrances after which drivers soon have to stop.
fn short_entrances(network: &Network, places: &Places) -> Option<Remark> {
    let gates = places.origins.iter().filter(|it| matches!(it, Place::Gate(_)));
    let short = gates.filter_map(|place| {
        let short = |chain: &ChainIndex| {
            let limit = network.chain(*chain).limit(0.0);
            let room = room(network, *chain)?;
            (room < MUCH_SHORTER * limit * limit / (2.0 * BRAKING)).then_some((place.id(), room, limit))
        };
        place.chains().iter().filter_map(short).min_by(|a, b| a.1.total_cmp(&b.1))
    });
    let short: Vec<(Id, f64, f64)> = short.collect();
    let (id, room, limit) = *short.first()?;
    let what = format!(
        "entrance {id}{} is {room:.0} m from where drivers may have to stop, at a speed limit of {}: vehicles enter more slowly, \
         and the flow is lower",
        and_more(short.len() - 1),
        kmh(limit)
    );
    remark(what, "make the road longer there")
}

/// From the start of `chain` to the first place where its drivers may have to stop, if there is one before it forks
/// [m].
fn room(network: &Network, chain: ChainIndex) -> Option<f64> {
    let on = network.junctions.on(chain);
    let stops = on.stops.iter().map(|it| it.station);
    let zones = on.crossings.iter().map(|it| network.junctions.reach(*it).start);
    stops.chain(zones).reduce(f64::min).map(|it| it.max(0.0))
}

/// Bends where the limit is faster than any driver would drive, if some drivers do not slow down for bends.
fn bends(network: &Network, drivers: &[Style]) -> Option<Remark> {
    let slows = |it: &Style| it.manner.lateral_acceleration > 0.0;
    let style = &drivers.iter().find(|it| !slows(it))?.name;
    let mut found: Vec<(&Lanelet, f64)> = Vec::new();
    for chain in &network.chains {
        for (index, start) in chain.lanelets.iter().zip(&chain.starts) {
            let lanelet = &network.lanelets[index.at()];
            let lateral =
                lanelet.speed_limit.powi(2) * curvature(&chain.centre, *start, start + lanelet.length());
            if lateral > LATERAL {
                found.push((lanelet, lateral));
            }
        }
    }
    let (sharpest, lateral) = found.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let what = format!(
        "{} of {} lanelets have bends in which the speed limit gives a lateral acceleration above {LATERAL} m/s² (lanelet {}: \
         {lateral:.0} m/s² at {}): {style} drivers do not slow down for bends",
        found.len(),
        network.lanelets.len(),
        sharpest.id,
        kmh(sharpest.speed_limit)
    );
    remark(what, "if this matters, give the style a lateral_acceleration, or reduce speed_limit there")
}

/// The greatest curvature of `line` between two stations [1/m], as far as the line extends half a span before and
/// after.
fn curvature(line: &Polyline, from: f64, to: f64) -> f64 {
    // A turn at a junction is often shorter than three spans; on an even shorter line, a corner is not a bend.
    let span = SPAN.min(line.length() / 3.0);
    if span < SHORTEST_SPAN {
        return 0.0;
    }
    let pieces = ((to - from) / span).ceil().max(1.0) as usize;
    let stations = (0..=pieces).map(|it| from + (to - from) * it as f64 / pieces as f64);
    let direction = |from: f64, to: f64| {
        let (a, b) = (line.at(from), line.at(to));
        (b.y - a.y).atan2(b.x - a.x)
    };
    let inner = stations.filter(|it| *it >= span && *it <= line.length() - span);
    let turn = |at: f64| {
        let turn = direction(at, at + span) - direction(at - span, at);
        let turn = turn.rem_euclid(TAU);
        turn.min(TAU - turn) / span
    };
    inner.map(turn).fold(0.0, f64::max)
}

/// The number of the others, after the first of some.
fn and_more(count: usize) -> String {
    if count == 0 { String::new() } else { format!(" (and {count} more)") }
}

fn kmh(speed: f64) -> String {
    format!("{:.0} km/h", speed * KMH_PER_MPS)
}
