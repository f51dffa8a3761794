//! Links: parts of chains, each with its own travel time.
//!
//! A chain may contain an approach, a junction and the road beyond. The mean over the whole chain would hide a jam on
//! one of them.

use laneweave_network::{Chain, ChainIndex, Network};
use serde::{Deserialize, Serialize};

use crate::route::ways::free_time;

/// A link begins with a lanelet, and includes further ones until it has this length [m]; ours.
const SHORTEST: f64 = 50.0;

/// The links of all chains, chain by chain.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Links {
    /// For each chain the index of its first link; the last entry is the number of links.
    first: Vec<usize>,
    links: Vec<Link>,
}

/// A piece of a chain.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Link {
    /// Where it begins along the chain [m].
    start: f64,
    /// Its length [m].
    pub(crate) length: f64,
    /// Its lowest speed limit [m/s].
    pub(crate) limit: f64,
    /// Travel time on it when it is empty [s].
    pub(crate) free_time: f64,
    /// Present travel time on it [s].
    time: f64,
    /// Present travel time from the chain's start to its own [s].
    time_before: f64,
}

impl Links {
    /// The links of `network`, with free travel times.
    pub(crate) fn of(network: &Network) -> Links {
        let mut it = Links::default();
        for chain in &network.chains {
            it.first.push(it.links.len());
            it.links.extend(starts(chain).windows(2).map(|ends| link(chain, ends[0], ends[1])));
        }
        it.first.push(it.links.len());
        it
    }

    /// Whether they are those of the same network, with any times.
    pub(crate) fn fits(&self, other: &Links) -> bool {
        let place = |it: &Link| (it.start, it.length, it.limit, it.free_time);
        self.first == other.first
            && self.links.len() == other.links.len()
            && self.links.iter().zip(&other.links).all(|(one, other)| place(one) == place(other))
    }

    /// Whether there are no links: then all times are those of the free road.
    #[inline]
    pub(crate) fn are_free(&self) -> bool {
        self.links.is_empty()
    }

    /// All links.
    pub(crate) fn all(&self) -> &[Link] {
        &self.links
    }

    /// The index of the link at `x` [m] on `chain` in the list of all.
    pub(crate) fn at(&self, chain: ChainIndex, x: f64) -> usize {
        let [from, until] = [0, 1].map(|it| self.first[chain.at() + it]);
        from + self.links[from + 1..until].partition_point(|it| it.start <= x)
    }

    /// Travel time from the start of `chain` to `x` [m] on it [s]. Before the start and beyond the end, the first and
    /// the last link are extrapolated.
    pub(crate) fn time_to(&self, chain: ChainIndex, x: f64) -> f64 {
        let it = &self.links[self.at(chain, x)];
        it.time_before + it.time * (x - it.start) / it.length
    }

    /// Sets new travel times of all links [s].
    pub(crate) fn take(&mut self, times: impl Iterator<Item = f64>) {
        let mut before = 0.0;
        for (link, time) in self.links.iter_mut().zip(times) {
            before = if link.start == 0.0 { 0.0 } else { before };
            (link.time, link.time_before) = (time, before);
            before += time;
        }
    }
}

/// Where the links of `chain` begin [m]; the last entry is the end of the chain.
fn starts(chain: &Chain) -> Vec<f64> {
    let mut starts = vec![0.0];
    for start in &chain.starts {
        let last = starts.last().copied().unwrap_or(0.0);
        if start - last >= SHORTEST && chain.length - start >= SHORTEST {
            starts.push(*start);
        }
    }
    starts.push(chain.length);
    starts
}

fn link(chain: &Chain, start: f64, end: f64) -> Link {
    let [before, until] = [start, end].map(|it| free_time(chain, it));
    let until_end = chain.limits.iter().filter(|it| it.start < end).map(|it| (it.start, it.speed));
    let limits = until_end.rev().scan(false, |is_over, (from, speed)| {
        let is_within = !*is_over;
        *is_over = from <= start;
        is_within.then_some(speed)
    });
    let free = until - before;
    Link {
        start,
        length: end - start,
        limit: limits.fold(f64::INFINITY, f64::min),
        free_time: free,
        time: free,
        time_before: before,
    }
}

#[cfg(test)]
mod tests {
    use laneweave_network::{DrivingSide, Lanelet, LaneletIndex, Point, Polyline};

    use super::*;

    /// A chain of lanelets of these lengths [m] at 10 m/s.
    fn chain_of(lengths: &[f64]) -> Network {
        let mut start = 0.0;
        let lanelets = lengths.iter().zip(1..).map(|(length, id): (&f64, u32)| {
            let line = Polyline::new([start, start + length].map(|x| Point::new(x, 0.0, 0.0))).unwrap();
            start += length;
            let mut lanelet = Lanelet::alone(i64::from(id), [line.clone(), line.clone(), line], 10.0);
            lanelet.following =
                [LaneletIndex(id)].into_iter().filter(|_| (id as usize) < lengths.len()).collect();
            lanelet
        });
        Network::new(lanelets.collect(), DrivingSide::Right).unwrap()
    }

    #[test]
    fn links_are_lanelets_that_together_are_50_m_or_more() {
        let links = Links::of(&chain_of(&[20.0, 30.0, 200.0, 60.0, 40.0]));
        let found: Vec<(f64, f64)> = links.all().iter().map(|it| (it.start, it.length)).collect();
        assert_eq!(found, [(0.0, 50.0), (50.0, 200.0), (250.0, 100.0)]);
        let times: Vec<f64> = links.all().iter().map(|it| it.free_time).collect();
        assert_eq!(times, [5.0, 20.0, 10.0]);
        assert_eq!([0.0, 49.9, 50.0, 349.0].map(|x| links.at(ChainIndex(0), x)), [0, 0, 1, 2]);
    }

    #[test]
    fn the_time_to_a_place_is_that_of_the_links_before_and_a_share_of_its_own() {
        let mut links = Links::of(&chain_of(&[50.0, 200.0, 50.0]));
        assert_eq!(links.time_to(ChainIndex(0), 150.0), 15.0);
        links.take([10.0, 100.0, 5.0].into_iter());
        let times = [0.0, 25.0, 50.0, 150.0, 300.0].map(|x| links.time_to(ChainIndex(0), x));
        assert_eq!(times, [0.0, 5.0, 10.0, 60.0, 115.0]);
        // Another chain begins before this one, or goes on beyond it.
        assert_eq!([-10.0, 310.0].map(|x| links.time_to(ChainIndex(0), x)), [-2.0, 116.0]);
    }
}
