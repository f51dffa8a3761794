//! Which chains are near each other: contacts, joined to stretches.

use super::contact::{Contact, LONGEST_VEHICLE, SAMPLE};
use crate::chain::ChainIndex;
use crate::junction::Nearby;
use crate::network::Network;

/// Contacts are joined over stretches of this length [m], so that long lanes side by side are not compared as a
/// whole.
const PIECE: f64 = 20.0;

/// For each chain the stretches of other chains, of larger or smaller index, that are near it; each pair of chains is
/// listed once.
pub(super) fn nearby(network: &Network, contacts: &[([ChainIndex; 2], Vec<Contact>)]) -> Vec<Vec<Nearby>> {
    let mut all = vec![Vec::new(); network.chains.len()];
    for ([here, there], contacts) in contacts {
        for piece in contacts.chunk_by(|a, b| number(a) == number(b)) {
            for stretches in runs(piece) {
                note(network, &mut all, [(*here, stretches[0]), (*there, stretches[1])]);
            }
        }
    }
    all
}

fn number(contact: &Contact) -> i64 {
    (contact.stations[0] / PIECE).floor() as i64
}

/// The stretches of contacts that follow each other on the other chain.
fn runs(piece: &[Contact]) -> Vec<[[f64; 2]; 2]> {
    let mut sorted: Vec<[f64; 2]> = piece.iter().map(|it| it.stations).collect();
    sorted.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let runs = sorted.chunk_by(|a, b| b[1] - a[1] <= PIECE);
    let extent = |run: &[[f64; 2]], side: usize| {
        let stations = run.iter().map(|it| it[side]);
        let low = stations.clone().fold(f64::INFINITY, f64::min);
        [low - SAMPLE, stations.fold(f64::NEG_INFINITY, f64::max) + SAMPLE]
    };
    runs.map(|run| [0, 1].map(|side| extent(run, side))).collect()
}

/// Adds two stretches on which vehicles are near each other, and those beyond their chains' ends where the fronts may
/// be.
fn note(network: &Network, all: &mut [Vec<Nearby>], bodies: [(ChainIndex, [f64; 2]); 2]) {
    let [ones, others] =
        bodies.map(|(chain, [low, high])| fronts(network, chain, [low, high + LONGEST_VEHICLE]));
    for (one, here) in &ones {
        for (other, there) in others.iter().filter(|it| it.0 != *one) {
            all[one.at()].push(Nearby { here: *here, chain: *other, there: *there });
        }
    }
}

/// A stretch, and its parts on the following chains.
fn fronts(network: &Network, chain: ChainIndex, stretch: [f64; 2]) -> Vec<(ChainIndex, [f64; 2])> {
    let mut found = vec![(chain, stretch)];
    let mut at = 0;
    while at < found.len() {
        let (chain, [low, high]) = found[at];
        at += 1;
        let here = network.chain(chain);
        if high > here.length {
            let beyond = [(low - here.length).max(0.0), high - here.length];
            for next in &here.following {
                if found.iter().all(|it| it.0 != *next) {
                    found.push((*next, beyond));
                }
            }
        }
    }
    found
}
