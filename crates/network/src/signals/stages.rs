//! Which lights are green together: the stages of a junction's program.
//!
//! Opposing approaches share a stage if no light of one excludes one of the other. Where lanes of their own lead to
//! turns across the oncoming traffic, these may get a stage before it: they are protected. Or each approach has a stage
//! of its own. Of the programs that are possible, the one with the shortest cycle by Webster is best.

use std::f64::consts::PI;

use super::approaches::Approach;
use super::conflicts::Rivals;
use super::flow_ratios::Flows;
use super::lanes::Lane;
use super::stage::Stage;
use super::timing::webster;
use crate::geometry::turn;
use crate::junction::LightIndex;

/// Approaches whose directions differ by more are opposite ones [rad]. Ours.
const OPPOSITE: f64 = 0.75 * PI;
/// A program has no more stages than this, if that is possible.
const MOST_STAGES: usize = 4;
/// Turns from a lane of their own are protected where the product of their flow and the oncoming flow exceeds this, for
/// one, two, and more oncoming lanes [(veh/h)²] (Highway Capacity Manual 2000).
const PROTECTED_FROM: [f64; 3] = [50_000.0, 90_000.0, 110_000.0];
const SECONDS_PER_HOUR: f64 = 3600.0;

/// So many programs are compared at a time; of more only the best.
const COMPARED: usize = 9;

/// The lights of stages that follow each other.
type Lights = Vec<Vec<LightIndex>>;

/// The best program of a junction with these `approaches`.
pub(super) fn best(flows: &Flows, rivals: &Rivals, approaches: &[Approach]) -> Vec<Stage> {
    let mut programs: Vec<Vec<Stage>> = vec![Vec::new()];
    for (first, second) in pairs(rivals, approaches) {
        let ways = match second {
            Some(second) => for_pair(flows, rivals, &approaches[first], &approaches[second]),
            None => vec![vec![approaches[first].lights.clone()]],
        };
        let measured = |it: Lights| sound(rivals, it).into_iter().map(|it| flows.measured(it)).collect();
        let ways: Vec<Vec<Stage>> = ways.into_iter().map(measured).collect();
        let longer = |program: &Vec<Stage>| -> Vec<Vec<Stage>> {
            ways.iter().map(|it| [program.clone(), it.clone()].concat()).collect()
        };
        programs = programs.iter().flat_map(longer).collect();
        programs.sort_by(|a, b| webster(a).total_cmp(&webster(b)));
        programs.truncate(COMPARED);
    }
    let is_short = |it: &&Vec<Stage>| it.len() <= MOST_STAGES;
    let best = programs.iter().find(is_short).or(programs.first()).cloned().unwrap_or_default();
    extended(flows, rivals, best)
}

/// Each approach with the one that comes from the opposite direction, if there is one.
fn pairs(rivals: &Rivals, approaches: &[Approach]) -> Vec<(usize, Option<usize>)> {
    let mut is_taken = vec![false; approaches.len()];
    let mut pairs = Vec::new();
    for first in 0..approaches.len() {
        if std::mem::replace(&mut is_taken[first], true) {
            continue;
        }
        let between = |it: &usize| turn(approaches[first].heading, approaches[*it].heading).abs();
        let meets = |it: &usize| {
            let any = approaches[first].lights.iter().flat_map(|light| &rivals.any[light.at()]);
            any.into_iter().any(|light| approaches[*it].lights.contains(light))
        };
        let others = (0..approaches.len()).filter(|it| !is_taken[*it] && between(it) > OPPOSITE);
        // Opposing approaches that do not meet at all belong to one street, too; those that meet come first.
        let second = others.max_by(|a, b| meets(a).cmp(&meets(b)).then(between(a).total_cmp(&between(b))));
        if let Some(second) = second {
            is_taken[second] = true;
        }
        pairs.push((first, second));
    }
    pairs
}

/// The ways to serve two opposing approaches.
fn for_pair(flows: &Flows, rivals: &Rivals, one: &Approach, other: &Approach) -> Vec<Lights> {
    let both = [one, other].map(|it| it.lights.clone()).concat();
    let mut ways = Vec::new();
    let across = [turns(flows, one, other), turns(flows, other, one)];
    let ahead: Vec<LightIndex> =
        both.iter().filter(|it| !across.iter().any(|of| of.contains(it))).copied().collect();
    let [across_one, across_other] = &across;
    let is_protectable = !across.concat().is_empty() && !ahead.is_empty();
    if is_protectable && !rivals.exclude(&ahead, &ahead) {
        ways.push(match rivals.exclude(across_one, across_other) {
            true => vec![across_one.clone(), across_other.clone(), ahead],
            false => vec![across.concat(), ahead],
        });
    }
    let must_be_protected = !ways.is_empty()
        && (needs_protection(flows, one, other, across_one)
            || needs_protection(flows, other, one, across_other));
    if !must_be_protected && !rivals.exclude(&one.lights, &other.lights) {
        ways.push(vec![both]);
    }
    ways.push(vec![one.lights.clone(), other.lights.clone()]);
    ways
}

/// The lights of `approach` all of whose lanes lead only to turns across the `oncoming` traffic.
fn turns(flows: &Flows, approach: &Approach, oncoming: &Approach) -> Vec<LightIndex> {
    let turn = |light: &&LightIndex| {
        let mut own = approach.lanes.iter().filter(|it| it.light == **light);
        own.all(|it| flows.turns_across(it, &oncoming.lanes))
    };
    approach.lights.iter().filter(turn).copied().collect()
}

/// Whether the turns with these lights of `approach` need protection from the `oncoming` traffic: there are two such
/// lanes or more, or the product of the flows is large.
fn needs_protection(flows: &Flows, approach: &Approach, oncoming: &Approach, turns: &[LightIndex]) -> bool {
    let turning: Vec<&Lane> = approach.lanes.iter().copied().filter(|it| turns.contains(&it.light)).collect();
    let of_lanes = turning.iter().map(|it| flows.across(it, &oncoming.lanes).map(|it| it * SECONDS_PER_HOUR));
    let product: f64 = of_lanes.map(|[across, oncoming]| across * oncoming).sum();
    let count = turning.iter().map(|it| flows.oncoming(it, &oncoming.lanes).len()).max().unwrap_or_default();
    let limit = PROTECTED_FROM[count.clamp(1, PROTECTED_FROM.len()) - 1];
    turning.len() > 1 || product > limit
}

/// The same stages, in none of which a light excludes another: such a stage is divided.
fn sound(rivals: &Rivals, stages: Lights) -> Lights {
    let mut divided: Lights = Vec::new();
    for stage in stages.into_iter().filter(|it| !it.is_empty()) {
        let first = divided.len();
        for light in stage {
            let fits = |it: &&mut Vec<LightIndex>| !rivals.exclude(&[light], it);
            match divided[first..].iter_mut().find(fits) {
                Some(group) => group.push(light),
                None => divided.push(vec![light]),
            }
        }
    }
    divided
}

/// The same stages, in each of which every further light is green, too, that conflicts with none of it.
fn extended(flows: &Flows, rivals: &Rivals, mut stages: Vec<Stage>) -> Vec<Stage> {
    let all: Vec<LightIndex> = stages.iter().flat_map(|it| it.lights.clone()).collect();
    for stage in &mut stages {
        for light in &all {
            let meets = |it: &LightIndex| it == light || rivals.any[light.at()].contains(it);
            if !stage.lights.iter().any(meets) {
                stage.lights.push(*light);
            }
        }
        stage.all_red = flows.all_red(&stage.lights);
    }
    stages
}
