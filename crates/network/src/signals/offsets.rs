//! Offsets along streets: a platoon that leaves one light meets green at the next.
//!
//! Junctions that follow each other closely get one cycle, or half of it. Then the offsets are chosen one after the
//! other, along the links with the most traffic, and once more around: each so that the platoons that come and go wait
//! least. This is the hill-climbing of TRANSYT (Robertson, 1969, from memory) with platoons that do not disperse. On a
//! link with traffic in both directions the stronger one counts more: a compromise would serve nobody.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_4, PI};

use super::LightTraffic;
use super::lanes::{Lane, Way, lanes};
use super::timing::Timed;
use crate::chain::{ChainIndex, Position};
use crate::junction::{Junctions, LightIndex, Sign, SignalPlan};
use crate::network::Network;

/// Lights further apart are not coordinated [m]: platoons disperse. Ours.
const FURTHEST: f64 = 600.0;
/// Acceleration with which platoons start [m/s²], and the reaction time of their first drivers [s].
const ACCELERATION: f64 = 1.5;
const REACTION: f64 = 1.0;
/// Weight of the weaker direction of a link. Ours.
const WEAKER: f64 = 0.2;
/// Step between offsets that are compared [s], and vehicles of a platoon that are compared.
const STEP: f64 = 1.0;
const SAMPLES: u32 = 5;
/// How often each offset is chosen again.
const ROUNDS: usize = 2;

/// A stage of a junction.
type At = (usize, usize);

/// A platoon from a stage of a junction to a stage of another.
#[derive(Clone, Copy)]
struct Link {
    from: At,
    to: At,
    /// Its flow [veh/s], and its weight among all.
    flow: f64,
    weight: f64,
    /// From the start of its green to its arrival at the next line [s].
    time: f64,
    /// For how long it leaves, as a share of the green.
    length: f64,
    /// Its direction at the first line [rad].
    heading: f64,
}

/// The plans of the junctions, with offsets.
pub(super) fn coordinated(
    network: &Network,
    junctions: &Junctions,
    traffic: &LightTraffic,
    mut timed: Vec<Timed>,
) -> Vec<SignalPlan> {
    let links = links(network, junctions, traffic, &timed);
    for group in groups(timed.len(), &links) {
        share_cycle(&mut timed, &group);
        place(&mut timed, &group, &links);
    }
    timed.into_iter().map(Timed::plan).collect()
}

/// The links between the junctions, those between the same stages as one, with their weights.
fn links(network: &Network, junctions: &Junctions, traffic: &LightTraffic, timed: &[Timed]) -> Vec<Link> {
    let mut stage_of: BTreeMap<LightIndex, At> = BTreeMap::new();
    for (junction, number) in timed.iter().zip(0..) {
        for (stage, at) in junction.stages.iter().zip(0..) {
            stage.lights.iter().for_each(|it| _ = stage_of.entry(*it).or_insert((number, at)));
        }
    }
    let mut links: BTreeMap<(At, At), Link> = BTreeMap::new();
    for lane in lanes(network, junctions) {
        let Some(&from) = stage_of.get(&lane.light) else { continue };
        for way in &lane.ways {
            let Some((light, time)) = next_light(network, junctions, traffic, way) else { continue };
            let Some(&to) = stage_of.get(&light).filter(|it| it.0 != from.0) else { continue };
            let flow = (traffic.flow)(way.via);
            let link = links.entry((from, to)).or_insert_with(|| link(&lane, [from, to], time, timed));
            link.flow += flow;
        }
    }
    let mut links: Vec<Link> = links.into_values().collect();
    weigh(&mut links);
    links
}

fn link(lane: &Lane, [from, to]: [At; 2], time: f64, timed: &[Timed]) -> Link {
    let junction = &timed[from.0];
    let need = junction.stages[from.1].flow_ratio * junction.cycle() / junction.greens[from.1];
    Link { from, to, flow: 0.0, weight: 0.0, time, length: need.min(1.0), heading: lane.heading }
}

/// The next light behind a way, and the time of a platoon from its line to that one [s].
fn next_light(
    network: &Network,
    junctions: &Junctions,
    traffic: &LightTraffic,
    way: &Way,
) -> Option<(LightIndex, f64)> {
    let Position { mut chain, mut x } = way.end;
    let speed = network.chain(chain).limit(x);
    let (mut length, mut time) = (way.length, REACTION + 0.5 * speed / ACCELERATION + way.length / speed);
    while length < FURTHEST {
        let here = network.chain(chain);
        let light = junctions.on(chain).stops.iter().find_map(|it| match it.sign {
            Sign::Light(light) if it.station > x => Some((light, it.station)),
            _ => None,
        });
        let until = light.map_or(here.length, |it| it.1);
        length += until - x;
        time += (until - x) / here.limit(x);
        if let Some((light, _)) = light {
            return (length < FURTHEST).then_some((light, time));
        }
        let flow = |it: &ChainIndex| (traffic.flow)(Position::new(*it, 0.0));
        chain = *here.following.iter().max_by(|a, b| flow(a).total_cmp(&flow(b)))?;
        x = 0.0;
    }
    None
}

/// Gives the links their weights: between two junctions the stronger direction counts, the weaker one less. Of equal
/// ones it is the direction to the east or to the north, so that it is the same along a street.
fn weigh(links: &mut [Link]) {
    let mut between: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for it in &*links {
        *between.entry((it.from.0, it.to.0)).or_default() += it.flow;
    }
    for link in links {
        let back = between.get(&(link.to.0, link.from.0)).copied().unwrap_or_default();
        let there = between[&(link.from.0, link.to.0)];
        let is_first = (-FRAC_PI_4..PI - FRAC_PI_4).contains(&link.heading);
        let is_equal = (there - back).abs() <= 1e-6 * there.max(back);
        let is_stronger = if is_equal { is_first } else { there > back };
        link.weight = link.flow * if is_stronger { 1.0 } else { WEAKER };
    }
}

/// Junctions that are linked, directly or through others.
fn groups(count: usize, links: &[Link]) -> Vec<Vec<usize>> {
    let mut near: Vec<Vec<usize>> = vec![Vec::new(); count];
    for Link { from, to, .. } in links.iter().filter(|it| it.weight > 0.0) {
        near[from.0].push(to.0);
        near[to.0].push(from.0);
    }
    let mut is_known = vec![false; count];
    let mut groups = Vec::new();
    for first in 0..count {
        let (mut group, mut open) = (Vec::new(), vec![first]);
        while let Some(at) = open.pop() {
            if !std::mem::replace(&mut is_known[at], true) {
                group.push(at);
                open.extend(&near[at]);
            }
        }
        if group.len() > 1 {
            groups.push(group);
        }
    }
    groups
}

/// Gives a group one cycle: the longest of its junctions. Those for which half of it is enough have two in that time.
fn share_cycle(timed: &mut [Timed], group: &[usize]) {
    let cycle = group.iter().map(|it| timed[*it].cycle()).fold(0.0, f64::max);
    for junction in group {
        let own = &mut timed[*junction];
        let half = 0.5 * cycle;
        own.stretch(if own.cycle() <= half && own.shortest() <= half { half } else { cycle });
    }
}

/// Chooses the offsets of a group: first along its links, those with the most traffic first, and then each again.
fn place(timed: &mut [Timed], group: &[usize], links: &[Link]) {
    let mut at: BTreeMap<usize, Vec<&Link>> = BTreeMap::new();
    for link in links {
        at.entry(link.from.0).or_default().push(link);
        at.entry(link.to.0).or_default().push(link);
    }
    let mut placed: Vec<usize> = vec![group[0]];
    let mut order: Vec<&Link> = links.iter().filter(|it| group.contains(&it.from.0)).collect();
    order.sort_by(|a, b| b.weight.total_cmp(&a.weight));
    while placed.len() < group.len() {
        let joins = |it: &&&Link| placed.contains(&it.from.0) != placed.contains(&it.to.0);
        let Some(link) = order.iter().find(joins) else { break };
        let next = if placed.contains(&link.from.0) { link.to.0 } else { link.from.0 };
        placed.push(next);
        choose(timed, next, &at[&next], |it| placed.contains(&it));
    }
    for _ in 0..ROUNDS {
        placed[1..].iter().for_each(|it| choose(timed, *it, &at[it], |_| true));
    }
}

/// Gives a junction the offset with the least waiting on those of its `links` whose other end `counts`.
fn choose(timed: &mut [Timed], junction: usize, links: &[&Link], counts: impl Fn(usize) -> bool) {
    let own: Vec<&&Link> = links.iter().filter(|it| counts(it.from.0) && counts(it.to.0)).collect();
    let mut best = (f64::INFINITY, 0.0);
    let cycle = timed[junction].cycle();
    for number in 0..(cycle / STEP).ceil() as u32 {
        timed[junction].offset = f64::from(number) * STEP;
        let waiting = own.iter().map(|it| it.weight * waiting(timed, it)).sum();
        if waiting < best.0 {
            best = (waiting, timed[junction].offset);
        }
    }
    timed[junction].offset = best.1;
}

/// Mean time for which the vehicles of a platoon wait at the next light [s].
fn waiting(timed: &[Timed], link: &Link) -> f64 {
    let [(from, of), (to, there)] = [link.from, link.to].map(|(it, stage)| (&timed[it], stage));
    let arrives = from.start(of) + link.time;
    let (length, cycle) = (link.length * from.greens[of], to.cycle());
    // Where the next light has twice the cycle of this one, its platoons come twice.
    let repeats = (cycle / from.cycle()).round().max(1.0) as u32;
    let wait = |number: u32| {
        let (repeat, vehicle) = (number / SAMPLES, number % SAMPLES);
        let after =
            f64::from(repeat) * from.cycle() + length * (f64::from(vehicle) + 0.5) / f64::from(SAMPLES);
        let since = (arrives + after - to.start(there)).rem_euclid(cycle);
        if since < to.greens[there] { 0.0 } else { cycle - since }
    };
    let count = repeats * SAMPLES;
    (0..count).map(wait).sum::<f64>() / f64::from(count)
}
