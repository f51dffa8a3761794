//! The conflict zones of chains, and the places where they part at forks: contacts of two chains, put together.

use super::contact::{Contact, LONGEST_VEHICLE, SAMPLE, Touching};
use super::fork::Parting;
use super::kinship::{Kinship, Meeting};
use crate::chain::ChainIndex;
use crate::junction::{Precedence, Reach, Touch, Zone, ZoneKind};

/// Contacts further apart along a chain than this belong to different zones [m].
const APART: f64 = 6.0;

/// The zones of chains with these contacts, and where chains part at forks, ordered by their chains.
pub(super) fn zones(
    kinship: &Kinship,
    contacts: &[([ChainIndex; 2], Vec<Contact>)],
) -> (Vec<Zone>, Vec<Parting>) {
    let (mut zones, mut partings) = (Vec::new(), Vec::new());
    for (pair, contacts) in contacts {
        for group in groups(kinship, *pair, contacts) {
            let bounds = [0, 1].map(|side| bounds(&group, side));
            let starts = bounds.map(|it| it[0]);
            let forks = kinship.forks(*pair, starts);
            let is_fork = forks.iter().any(|it| kinship.come_only_from(it, *pair));
            partings.extend(forks.into_iter().map(|fork| Parting::of(*pair, fork, &group)));
            if !is_fork {
                add(&mut zones, zone_of(kinship, *pair, bounds, &group));
            }
        }
    }
    (zones, partings)
}

/// Adds a zone, or makes it part of one that is known, if both lead into the same place for the same vehicles: a merge
/// is passed as a whole.
fn add(zones: &mut Vec<Zone>, zone: Option<Zone>) {
    let Some(zone) = zone else { return };
    let chains = |it: &Zone| it.sides.map(|it| it.chain);
    let is_merge = matches!(zone.kind, ZoneKind::Merging(_));
    let of_pair = zones.iter_mut().rev().take_while(|it| chains(it) == chains(&zone));
    let mut same = of_pair.filter(|it| is_merge && it.kind == zone.kind && it.touch == zone.touch);
    match same.next() {
        Some(known) => {
            for (known, side) in known.sides.iter_mut().zip(zone.sides) {
                (known.start, known.end) = (known.start.min(side.start), known.end.max(side.end));
            }
        }
        None => zones.push(zone),
    }
}

/// The contacts of two chains, which are in the order of the first chain's stations, by the zones to which they belong.
fn groups<'a>(kinship: &Kinship, pair: [ChainIndex; 2], contacts: &'a [Contact]) -> Vec<Vec<Touching<'a>>> {
    let touching = contacts.iter().filter_map(|it| Some((it, it.touch?)));
    // Where one of two lanes begins or ends, the change between them has to stay possible: cars would not touch
    // there.
    let apart = touching.filter(|(it, touch)| {
        let is_changed = *touch != Touch::Any && kinship.is_left_beside(pair, it.stations);
        !is_changed && !kinship.is_one_behind_the_other(pair, it.stations)
    });
    let (beyond, usual): (Vec<_>, Vec<_>) = apart.partition(|(it, _)| it.is_beyond);
    let mut groups: Vec<Vec<Touching>> = Vec::new();
    for contact in usual.into_iter().chain(beyond) {
        let fits =
            |group: &&mut Vec<Touching>| {
                group.iter().rev().take(32).any(|it| {
                    (0..2).all(|side| (it.0.stations[side] - contact.0.stations[side]).abs() <= APART)
                })
            };
        // In a crossing that is longer because of long vehicles beyond it, cars would wait without a reason: that
        // part is a zone of its own.
        let joins = |group: &&mut Vec<Touching>| {
            fits(group) && !(contact.0.is_beyond && group.iter().any(|it| it.1 == Touch::Any))
        };
        match groups.iter_mut().find(joins) {
            Some(group) => group.push(contact),
            None => groups.push(vec![contact]),
        }
    }
    groups
}

/// First and last station of contacts on one side, and a sample around them [m].
fn bounds(group: &[Touching], side: usize) -> [f64; 2] {
    let stations = group.iter().map(|it| it.0.stations[side]);
    let low = stations.clone().fold(f64::INFINITY, f64::min);
    [low - SAMPLE, stations.fold(0.0, f64::max) + SAMPLE]
}

fn zone_of(
    kinship: &Kinship,
    pair: [ChainIndex; 2],
    bounds: [[f64; 2]; 2],
    group: &[Touching],
) -> Option<Zone> {
    let starts = bounds.map(|it| it[0]);
    let ends = bounds.map(|it| it[1]);
    let touch = group.iter().map(|it| it.1).min()?;
    let kind = match kinship.meeting(pair, starts, ends) {
        Meeting::Merges(stations) => ZoneKind::Merging(stations),
        Meeting::Shares => ZoneKind::Merging(ends.map(|it| it + LONGEST_VEHICLE)),
        Meeting::Crosses if mostly(group, |it| it.is_along) => {
            ZoneKind::Merging(ends.map(|it| it + LONGEST_VEHICLE))
        }
        Meeting::Crosses => ZoneKind::Crossing,
    };
    // Estimates are too coarse to distinguish two long vehicles from one where paths cross, or any from all where
    // they lead into one.
    let touch = match kind {
        ZoneKind::Merging(_) if !mostly(group, |it| it.is_along) => Touch::Any,
        ZoneKind::Crossing if !mostly(group, |it| it.is_road) => touch.min(Touch::OneLong),
        _ => touch,
    };
    let reach = |side: usize| Reach { chain: pair[side], start: starts[side].max(0.0), end: ends[side] };
    Some(Zone { kind, touch, sides: [reach(0), reach(1)], precedence: Precedence::Arrival })
}

/// Whether by far the most contacts are of a kind.
fn mostly(group: &[Touching], kind: impl Fn(&Contact) -> bool) -> bool {
    const MOST: f64 = 0.8;
    let found = group.iter().filter(|it| kind(it.0)).count();
    found as f64 > MOST * group.len() as f64
}
