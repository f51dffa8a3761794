//! Offsets along streets: a platoon that leaves one light meets green at the next.
//!
//! Junctions that follow each other closely, and need about the same cycle, get one, or half of it. Then the offsets
//! are chosen one after the other, along the links with the most traffic, and then each again, so that the platoons
//! that come and go wait least. This is the hill-climbing of TRANSYT (Robertson, 1969, from memory) with platoons that
//! do not disperse. On a link with traffic in both directions the stronger one counts more: a compromise would serve
//! nobody.

use std::collections::{BTreeMap, BinaryHeap};
use std::f64::consts::{FRAC_PI_4, PI};

use super::components::components;
use super::lanes::{Lane, Way};
use super::timing::Timed;
use super::{LightTraffic, Lights};
use crate::chain::{ChainIndex, Position};
use crate::junction::{LightIndex, Sign, SignalPlan};

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

/// Junctions share a cycle if the longer of theirs is at most so many times the shorter, or half of it is enough for
/// the other. Ours.
const ALIKE: f64 = 1.5;
/// Cycles are equal within rounding [s].
const EQUAL: f64 = 1e-6;

/// A platoon from a light to a light of another junction.
#[derive(Clone, Copy)]
struct Link {
    /// The junctions.
    from: usize,
    to: usize,
    lights: [LightIndex; 2],
    /// Its flow [veh/s], and its weight among all.
    flow: f64,
    weight: f64,
    /// From the start of its green to its arrival at the next line [s].
    time: f64,
    /// For how long it leaves, as a share of the green.
    length: f64,
    /// The direction from the first line to the other [rad].
    heading: f64,
}

/// The plans of the junctions, with offsets.
pub(super) fn coordinated(lights: &Lights, traffic: &LightTraffic, mut timed: Vec<Timed>) -> Vec<SignalPlan> {
    let mut links = links(lights, traffic, &timed);
    links.retain(|it| are_alike(&timed[it.from], &timed[it.to]));
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); timed.len()];
    for (link, number) in links.iter().zip(0..) {
        at[link.from].push(number);
        at[link.to].push(number);
    }
    let near = |it: usize| at[it].iter().flat_map(|it| [links[*it].from, links[*it].to]);
    for group in components(timed.len(), near).into_iter().filter(|it| it.len() > 1) {
        share_cycle(&mut timed, &group);
        place(&mut timed, &group, &links, &at);
    }
    timed.into_iter().map(Timed::plan).collect()
}

/// Whether two junctions can have one cycle, or one half of the other's, without much loss.
fn are_alike(one: &Timed, other: &Timed) -> bool {
    let (short, long) = (one.cycle().min(other.cycle()), one.cycle().max(other.cycle()));
    long <= ALIKE * short || 0.5 * long >= short - EQUAL && 0.5 * long <= ALIKE * short
}

/// The links between the junctions, those between the same lights as one, with their weights.
fn links(lights: &Lights, traffic: &LightTraffic, timed: &[Timed]) -> Vec<Link> {
    let mut junction_of: BTreeMap<LightIndex, usize> = BTreeMap::new();
    for (junction, number) in timed.iter().zip(0..) {
        let own = junction.stages.iter().flat_map(|it| &it.lights);
        own.for_each(|it| _ = junction_of.insert(*it, number));
    }
    let mut links: BTreeMap<[LightIndex; 2], Link> = BTreeMap::new();
    for lane in &lights.lanes {
        let Some(&from) = junction_of.get(&lane.light) else { continue };
        for way in &lane.ways {
            let Some(next) = next_light(lights, traffic, way, &junction_of) else { continue };
            let Some(&to) = junction_of.get(&next.light).filter(|it| **it != from) else { continue };
            let ends = [lane.light, next.light];
            let link = links.entry(ends).or_insert_with(|| link(lights, lane, &next, [from, to], timed));
            link.flow += (traffic.flow)(way.via);
        }
    }
    let mut links: Vec<Link> = links.into_values().filter(|it| it.flow > 0.0).collect();
    weigh(&mut links);
    links
}

fn link(lights: &Lights, lane: &Lane, next: &Next, [from, to]: [usize; 2], timed: &[Timed]) -> Link {
    let (_, green) = timed[from].green(lane.light);
    let own = timed[from].stages.iter().filter(|it| it.lights.contains(&lane.light));
    let ratio = own.map(|it| it.flow_ratio).fold(0.0, f64::max);
    let line = lights.network.chain(next.line.chain).centre.at(next.line.x);
    Link {
        from,
        to,
        lights: [lane.light, next.light],
        flow: 0.0,
        weight: 0.0,
        time: next.time,
        length: (ratio * timed[from].cycle() / green).min(1.0),
        heading: (line.y - lane.point.y).atan2(line.x - lane.point.x),
    }
}

/// The next light on a way.
struct Next {
    light: LightIndex,
    line: Position,
    /// Time of a platoon from the line before to this one [s].
    time: f64,
}

/// The next light behind a way that is not always green, if it is near.
fn next_light(
    lights: &Lights,
    traffic: &LightTraffic,
    way: &Way,
    junction_of: &BTreeMap<LightIndex, usize>,
) -> Option<Next> {
    let network = lights.network;
    let Position { mut chain, mut x } = way.end;
    let speed = network.chain(chain).limit(x);
    let (mut length, mut time) = (way.length, REACTION + 0.5 * speed / ACCELERATION + way.length / speed);
    let has_program = |light: LightIndex| {
        junction_of.contains_key(&light) || !lights.junctions.lights[light.at()].program.phases.is_empty()
    };
    while length < FURTHEST {
        let here = network.chain(chain);
        let light = lights.junctions.on(chain).stops.iter().find_map(|it| match it.sign {
            Sign::Light(light) if it.station > x && has_program(light) => Some((light, it.station)),
            _ => None,
        });
        let until = light.map_or(here.length, |it| it.1);
        length += until - x;
        time += (until - x) / here.limit(x);
        if let Some((light, station)) = light {
            let line = Position::new(chain, station);
            return (length < FURTHEST).then_some(Next { light, line, time });
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
        *between.entry((it.from, it.to)).or_default() += it.flow;
    }
    for link in links {
        let back = between.get(&(link.to, link.from)).copied().unwrap_or_default();
        let there = between[&(link.from, link.to)];
        let is_first = (-FRAC_PI_4..PI - FRAC_PI_4).contains(&link.heading);
        let is_equal = (there - back).abs() <= 1e-6 * there.max(back);
        let is_stronger = if is_equal { is_first } else { there > back };
        link.weight = link.flow * if is_stronger { 1.0 } else { WEAKER };
    }
}

/// Gives a group one cycle: the longest of its junctions. Those for which half of it is enough have two in that time.
fn share_cycle(timed: &mut [Timed], group: &[usize]) {
    let cycle = group.iter().map(|it| timed[*it].cycle()).fold(0.0, f64::max);
    for junction in group {
        let own = &mut timed[*junction];
        let half = 0.5 * cycle;
        let is_enough = own.cycle() <= half + EQUAL && own.shortest() <= half;
        own.stretch(if is_enough { half } else { cycle });
    }
}

/// Chooses the offsets of a group: first along its links, those with the most traffic first, and then each again.
fn place(timed: &mut [Timed], group: &[usize], links: &[Link], at: &[Vec<usize>]) {
    let mut is_placed = vec![false; timed.len()];
    let mut placed = Vec::new();
    // The links from placed junctions by weight, and of equal ones the first.
    let mut open: BinaryHeap<(u64, std::cmp::Reverse<usize>)> = BinaryHeap::new();
    let mut next = group[0];
    loop {
        is_placed[next] = true;
        placed.push(next);
        let own: Vec<&Link> = at[next].iter().map(|it| &links[*it]).collect();
        choose(timed, next, own.iter().copied().filter(|it| is_placed[it.from] && is_placed[it.to]));
        open.extend(at[next].iter().map(|it| (links[*it].weight.to_bits(), std::cmp::Reverse(*it))));
        let ends = |number: usize| [links[number].from, links[number].to];
        let further = std::iter::from_fn(|| open.pop())
            .find_map(|(_, number)| ends(number.0).into_iter().find(|it| !is_placed[*it]));
        match further {
            Some(junction) => next = junction,
            None => break,
        }
    }
    for _ in 0..ROUNDS {
        placed[1..].iter().for_each(|it| choose(timed, *it, at[*it].iter().map(|it| &links[*it])));
    }
}

/// Gives a junction the offset with the least waiting on these `links`.
fn choose<'a>(timed: &mut [Timed], junction: usize, links: impl Iterator<Item = &'a Link>) {
    timed[junction].offset = 0.0;
    let platoons: Vec<Platoon> = links.map(|it| Platoon::on(timed, it, junction)).collect();
    let cycle = timed[junction].cycle();
    let offsets = (0..(cycle / STEP).ceil() as u32).map(|it| f64::from(it) * STEP);
    let waiting = |offset: &f64| platoons.iter().map(|it| it.weight * it.waiting(*offset)).sum::<f64>();
    let mut best = (f64::INFINITY, 0.0);
    for offset in offsets {
        let waiting = waiting(&offset);
        if waiting < best.0 {
            best = (waiting, offset);
        }
    }
    timed[junction].offset = best.1;
}

/// A platoon that comes to a junction, or goes from it.
struct Platoon {
    weight: f64,
    /// It comes later with the offset of the junction, or the green does.
    sign: f64,
    /// From the start of the next green to its arrival [s].
    after: f64,
    length: f64,
    /// Cycle from which it comes, and the cycle and the green to which it comes [s].
    from_cycle: f64,
    cycle: f64,
    green: f64,
}

impl Platoon {
    fn on(timed: &[Timed], link: &Link, junction: usize) -> Platoon {
        let [from, to] = [link.from, link.to].map(|it| &timed[it]);
        let (leaves, length) = from.green(link.lights[0]);
        let (begins, green) = to.green(link.lights[1]);
        Platoon {
            weight: link.weight,
            sign: if link.from == junction { 1.0 } else { -1.0 },
            after: leaves + link.time - begins,
            length: link.length * length,
            from_cycle: from.cycle(),
            cycle: to.cycle(),
            green,
        }
    }

    /// Mean time for which its vehicles wait at the next light [s].
    fn waiting(&self, offset: f64) -> f64 {
        // Where the next light has twice the cycle of this one, its platoons come twice.
        let repeats = (self.cycle / self.from_cycle).round().max(1.0) as u32;
        let wait = |number: u32| {
            let (repeat, vehicle) = (f64::from(number / SAMPLES), f64::from(number % SAMPLES));
            let part = self.length * (vehicle + 0.5) / f64::from(SAMPLES);
            let since = self.after + self.sign * offset + repeat * self.from_cycle + part;
            let since = since.rem_euclid(self.cycle);
            if since < self.green { 0.0 } else { self.cycle - since }
        };
        let count = repeats * SAMPLES;
        (0..count).map(wait).sum::<f64>() / f64::from(count)
    }
}
