//! Where drivers turn: where a lane changes its direction by more than 30° within 30 m, at a junction or not. Ours.

use super::precedence::{TURNS, turned};
use crate::chain::ChainIndex;
use crate::geometry::Polyline;
use crate::network::Network;

/// Distance over which directions are compared [m].
const SAMPLE: f64 = 5.0;
/// Number of samples that make a turn, and separate it from the next one to the same side.
const SAMPLES: usize = 6;

/// For each chain the stations at which its turns begin [m], in order. Driving on around a roundabout is no turn.
pub(super) fn turns(network: &Network, in_ring: &[bool]) -> Vec<Vec<f64>> {
    let chains = (0..network.chains.len() as u32).map(ChainIndex);
    let turns_of = |chain: ChainIndex| {
        let turns = along(&network.chain(chain).centre);
        if turns.is_empty() || in_ring[chain.at()] { Vec::new() } else { turns }
    };
    chains.map(turns_of).collect()
}

/// Where the turns of a line begin [m].
fn along(line: &Polyline) -> Vec<f64> {
    let samples = (line.length() / SAMPLE).ceil() as usize;
    let headings: Vec<f64> =
        (0..=samples).map(|it| line.heading((it as f64 * SAMPLE).min(line.length()))).collect();
    let bends: Vec<f64> = headings.windows(2).map(|it| turned(it[0], it[1])).collect();
    let mut turns = Vec::new();
    // The last place on a turn, and its side.
    let mut last: Option<(usize, f64)> = None;
    for at in 0..bends.len() {
        let turn: f64 = bends[at..].iter().take(SAMPLES).sum();
        if turn.abs() <= TURNS {
            continue;
        }
        let goes_on = last.is_some_and(|(it, side)| at - it <= SAMPLES && side == turn.signum());
        if !goes_on {
            turns.push(at as f64 * SAMPLE);
        }
        last = Some((at, turn.signum()));
    }
    turns
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;
    use crate::geometry::Point;

    /// The turns of a straight line of 100 m, followed by arcs, each with a radius [m] and an angle to the left
    /// [rad], and by 100 m straight on after each.
    fn turns_of(arcs: &[(f64, f64)]) -> Vec<f64> {
        let (mut x, mut y, mut heading) = (0.0, 0.0, 0.0f64);
        let mut points = vec![Point::new(x, y, 0.0)];
        let mut go = |length: f64, turn: f64, pieces: u32| {
            for _ in 0..pieces {
                heading += 0.5 * turn / f64::from(pieces);
                x += length / f64::from(pieces) * heading.cos();
                y += length / f64::from(pieces) * heading.sin();
                heading += 0.5 * turn / f64::from(pieces);
                points.push(Point::new(x, y, 0.0));
            }
        };
        go(100.0, 0.0, 1);
        for (radius, angle) in arcs {
            go(radius * angle.abs(), *angle, 20);
            go(100.0, 0.0, 1);
        }
        along(&Polyline::new(points).unwrap())
    }

    #[test]
    fn a_tight_bend_to_either_side_is_one_turn_and_a_wide_one_is_none() {
        for angle in [FRAC_PI_2, -FRAC_PI_2, PI, -PI] {
            for radius in [6.0, 12.0, 30.0] {
                let [at] = turns_of(&[(radius, angle)])[..] else { panic!("{radius} m, {angle}") };
                assert!((70.0..=100.0).contains(&at), "{at} m");
            }
            assert_eq!(turns_of(&[(80.0, angle)]), [0.0; 0]);
        }
        assert_eq!(turns_of(&[(12.0, 0.4)]), [0.0; 0]);
    }

    #[test]
    fn bends_one_after_the_other_are_as_many_turns() {
        assert_eq!(turns_of(&[(12.0, FRAC_PI_2), (12.0, FRAC_PI_2), (12.0, -FRAC_PI_2)]).len(), 3);
    }
}
