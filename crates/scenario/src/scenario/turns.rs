//! Turning shares: destinations of drivers from turning counts at junctions.
//!
//! Shares are followed from each entrance through the network, as a Markov chain over its sections, to the exits: the
//! share of the drivers that arrives at an exit is its weight as a destination. Drivers then take their best route
//! there. So the counts are reproduced where one route leads from an entrance to an exit; of several routes, all
//! drivers take the best.

use laneweave_network::{Branch, ChainIndex, Id, Network, Sections, Side};
use laneweave_sim::{Demand, Place, Trips, World};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::WrittenId;
use super::{Origin, Scenario};
use crate::fault::Fault;

/// Turning shares of the drivers on a road to a junction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Turns {
    /// The id of a lanelet of the road.
    #[schemars(with = "WrittenId")]
    pub from: Id,
    /// Share, or count, of drivers who turn left (or make a U-turn).
    #[serde(default)]
    pub left: f64,
    /// Share, or count, of drivers who go straight on.
    #[serde(default)]
    pub straight: f64,
    /// Share, or count, of drivers who turn right.
    #[serde(default)]
    pub right: f64,
}

/// A movement that changes its direction by less goes straight on [rad].
const STRAIGHT: f64 = std::f64::consts::FRAC_PI_6;
/// Share of the drivers that may remain in the network at the end.
const LEFT_OVER: f64 = 1e-6;
/// Maximum number of sections that are followed.
const LONGEST: usize = 100_000;

/// Continuations of a section: other sections, each with the share of the drivers who go there.
type WaysOn = Vec<(usize, f64)>;

/// Sets the weights of the destinations for the origins of `demand`, from the scenario's turning shares.
///
/// # Errors
/// If a lanelet does not exist, or leads to no junction, if shares are invalid, or if drivers never arrive.
pub(super) fn set_turns(
    scenario: &Scenario,
    origin: &Origin,
    network: &Network,
    demand: &mut Demand,
) -> Result<(), Fault> {
    if scenario.turns.is_empty() {
        return Ok(());
    }
    let place = origin.place(&["turns"]);
    if network.entrances.is_empty() || network.exits.is_empty() {
        let remedy = "remove them: on this map every lanelet is a destination";
        return Err(Fault::new(place, "turning shares on a map without entrances or exits", remedy));
    }
    if !scenario.demand.exits.is_empty() {
        let what = "both turning shares and weights of exits";
        return Err(Fault::new(
            place,
            what,
            "remove demand.exits or the turns: each of them defines the destinations",
        ));
    }
    let sections = Sections::of(network);
    let ways_on = ways_on(scenario, origin, network, &sections)?;
    let ends = |place: &Place| -> Vec<usize> {
        let last = place.chains().iter().filter_map(|it| network.chain(*it).lanelets.last());
        last.map(|it| sections.holding(*it)).collect()
    };
    let ends: Vec<Vec<usize>> = demand.destinations.iter().map(ends).collect();
    for it in &mut demand.origins {
        let mut parts = vec![0.0; sections.all().len()];
        for chain in it.place.chains() {
            parts[sections.holding(network.chain(*chain).lanelets[0])] +=
                1.0 / it.place.chains().len() as f64;
        }
        it.weights.fill(0.0);
        it.trips = Trips::All;
        let arrived = arrived(parts, &ways_on).map_err(|left| {
            let what = format!(
                "with these shares {:.0} % of the drivers from the entrance {} never arrive",
                100.0 * left,
                it.place.id()
            );
            Fault::new(&place, what, "give a share above 0 to a turn that leads out of the loop")
        })?;
        // Lanes of one road may be exits of their own, of which not all can be reached from here.
        let is_reached = reached(network, it.place.chains());
        let can_be_reached = |place: &Place| place.chains().iter().any(|chain| is_reached[chain.at()]);
        let candidates: Vec<bool> = demand.destinations.iter().map(can_be_reached).collect();
        for (section, part) in arrived.into_iter().enumerate().filter(|it| it.1 > 0.0) {
            let is_there = |number: &usize| candidates[*number] && ends[*number].contains(&section);
            let there: Vec<usize> = (0..ends.len()).filter(is_there).collect();
            there.iter().for_each(|number| it.weights[*number] += part / there.len() as f64);
        }
    }
    Ok(())
}

/// For each chain whether it can be reached from those of `start`.
fn reached(network: &Network, start: &[ChainIndex]) -> Vec<bool> {
    let mut is_reached = vec![false; network.chains.len()];
    let mut open = start.to_vec();
    while let Some(index) = open.pop() {
        if !std::mem::replace(&mut is_reached[index.at()], true) {
            let chain = network.chain(index);
            open.extend(&chain.following);
            open.extend(Side::BOTH.into_iter().flat_map(|side| chain.stretches(side)).map(|it| it.chain));
        }
    }
    is_reached
}

/// Checks that each entrance with demand has a route to a destination to which turning shares send drivers.
///
/// # Errors
/// The first entrance without one.
pub(super) fn check_arrivals(scenario: &Scenario, origin: &Origin, world: &World) -> Result<(), Fault> {
    if scenario.turns.is_empty() {
        return Ok(());
    }
    let busy = world.demand().origins.iter().enumerate().filter(|it| it.1.rate.highest() > 0.0);
    for (number, it) in busy {
        let mut wanted = it.weights.iter().enumerate().filter(|it| *it.1 > 0.0);
        if !wanted.any(|(to, _)| world.leads(number, to)) {
            let id = it.place.id();
            let what = format!("no lane leads from the entrance {id} to the destinations of these shares");
            let remedy =
                "give a share above 0 to a turn that its lanes allow, or remove the demand of the entrance";
            return Err(Fault::new(origin.place(&["turns"]), what, remedy));
        }
    }
    Ok(())
}

/// Share of the drivers that arrive at the end of each section without a continuation, if they begin in `parts`.
///
/// # Errors
/// The share that never arrives.
fn arrived(mut parts: Vec<f64>, ways_on: &[WaysOn]) -> Result<Vec<f64>, f64> {
    let mut arrived = vec![0.0; parts.len()];
    for _ in 0..LONGEST {
        let mut next = vec![0.0; parts.len()];
        for (section, part) in parts.iter().enumerate().filter(|it| *it.1 > 0.0) {
            if ways_on[section].is_empty() {
                arrived[section] += part;
            }
            ways_on[section].iter().for_each(|(to, share)| next[*to] += part * share);
        }
        parts = next;
        if parts.iter().sum::<f64>() <= LEFT_OVER {
            return Ok(arrived);
        }
    }
    Err(parts.iter().sum())
}

/// For each section its continuations: where the scenario gives no shares, by the number of lanes.
fn ways_on(
    scenario: &Scenario,
    origin: &Origin,
    network: &Network,
    sections: &Sections,
) -> Result<Vec<WaysOn>, Fault> {
    let by_lanes = |branches: &[Branch]| -> WaysOn {
        let all: usize = branches.iter().map(|it| it.lanes).sum();
        branches.iter().map(|it| (it.section, it.lanes as f64 / all as f64)).collect()
    };
    let mut ways_on: Vec<WaysOn> = sections.all().iter().map(|it| by_lanes(&it.following)).collect();
    let mut named: Vec<Option<Id>> = vec![None; ways_on.len()];
    for (turns, number) in scenario.turns.iter().zip(0..) {
        let place = |key: &str| origin.place(&["turns", &number.to_string(), key]);
        let section = fork_after(turns.from, network, sections)
            .map_err(|(what, remedy)| Fault::new(place("from"), what, remedy))?;
        if let Some(other) = named[section].replace(turns.from) {
            let what = format!("the lanelets {other} and {} lead to the same junction", turns.from);
            return Err(Fault::new(place("from"), what, "remove one of them"));
        }
        ways_on[section] = by_shares(turns, &sections.all()[section].following, network, place)?;
    }
    Ok(ways_on)
}

/// The section to which the lanelet with this id leads, and which has several continuations.
fn fork_after(id: Id, network: &Network, sections: &Sections) -> Result<usize, (String, &'static str)> {
    let lanelets = sections.all().iter().flat_map(|it| &it.lanelets);
    let mut same = lanelets.filter(|it| network.lanelets[it.at()].id == id);
    let first = same.next().ok_or((
        format!("the map has no lanelet {id} for vehicles"),
        "give a lanelet of the road to the junction",
    ))?;
    let mut at = sections.holding(*first);
    for _ in 0..sections.all().len() {
        match sections.all()[at].following[..] {
            [only] => at = only.section,
            [] => break,
            _ => return Ok(at),
        }
    }
    Err((format!("the lanelet {id} leads to no junction"), "leave it out"))
}

/// The roads of `network` that fork, each with shares by the number of lanes.
pub(super) fn forks(network: &Network) -> Vec<Turns> {
    let sections = Sections::of(network);
    let forks = sections.all().iter().filter(|it| it.following.len() > 1);
    let named = forks.filter_map(|it| {
        let lanes = |way: Way| -> f64 {
            it.following.iter().filter(|it| Way::of(it) == way).map(|it| it.lanes as f64).sum()
        };
        let [left, straight, right] = Way::ALL.map(lanes);
        let from = it.lanelets.iter().map(|it| network.lanelets[it.at()].id).min()?;
        Some(Turns { from, left, straight, right })
    });
    named.collect()
}

/// The direction of a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Left,
    Straight,
    Right,
}

impl Way {
    const ALL: [Way; 3] = [Way::Left, Way::Straight, Way::Right];

    fn of(branch: &Branch) -> Way {
        match branch.angle {
            angle if angle > STRAIGHT => Way::Left,
            angle if angle < -STRAIGHT => Way::Right,
            _ => Way::Straight,
        }
    }

    /// Its key, and its name.
    fn words(self) -> [&'static str; 2] {
        match self {
            Way::Left => ["left", "left"],
            Way::Straight => ["straight", "straight on"],
            Way::Right => ["right", "right"],
        }
    }
}

/// The continuations over `branches` by the shares of `turns`; several in the same direction share by lanes.
fn by_shares(
    turns: &Turns,
    branches: &[Branch],
    network: &Network,
    place: impl Fn(&str) -> String,
) -> Result<WaysOn, Fault> {
    let share = |way: Way| match way {
        Way::Left => turns.left,
        Way::Straight => turns.straight,
        Way::Right => turns.right,
    };
    let lanes =
        |way: Way| -> usize { branches.iter().filter(|it| Way::of(it) == way).map(|it| it.lanes).sum() };
    for way in Way::ALL {
        let [key, reads] = way.words();
        if !(share(way).is_finite() && share(way) >= 0.0) {
            return Err(Fault::new(place(key), format!("a share of {}", share(way)), "choose 0 or more"));
        }
        if share(way) > 0.0 && lanes(way) == 0 {
            let known = branches
                .iter()
                .map(|it| format!("{} ({})", Way::of(it).words()[1], network.lanelets[it.lanelet.at()].id));
            let known: Vec<String> = known.collect();
            let what = format!("no lane leads {reads} from {}", turns.from);
            return Err(Fault::new(place(key), what, format!("its lanelets lead {}", known.join(", "))));
        }
    }
    let total: f64 = Way::ALL.into_iter().map(share).sum();
    if total <= 0.0 {
        let what = format!("all shares from {} are 0", turns.from);
        return Err(Fault::new(place("from"), what, "give left, straight or right a share above 0"));
    }
    let part = |it: &Branch| share(Way::of(it)) / total * it.lanes as f64 / lanes(Way::of(it)) as f64;
    Ok(branches.iter().map(|it| (it.section, part(it))).filter(|it| it.1 > 0.0).collect())
}
