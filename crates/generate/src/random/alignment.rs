//! Roads that are difficult because of their alignment or cuts: bends, short lanelets, narrow lanes.

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, two_way_offsets};
use super::stretch::{Ease, Pen, Stretch};
use crate::path::Path;

/// Radius of the innermost lane of sharp bends [m].
const RADIUS: [f64; 2] = [8.0, 20.0];
/// Angle of sharp bends, and of those with one back [rad].
const TURN: [f64; 2] = [0.8, 2.1];
const THERE_AND_BACK: [f64; 2] = [0.4, 1.1];
/// Radius of hairpins, width of their lanes [m], and their angle [rad].
const HAIRPIN_RADIUS: [f64; 2] = [8.0, 10.0];
const HAIRPIN_WIDTH: [f64; 2] = [2.2, 2.4];
const HAIRPIN: [f64; 2] = [1.2, 2.6];
/// Limit on bends [km/h].
const BEND_LIMIT: f64 = 30.0;
/// Length of short lanelets [m], and their number in a row.
const SHORT: [f64; 2] = [0.5, 3.0];
const ROW: [usize; 2] = [3, 12];
/// Width of narrow lanes [m], their length, and the length of the transition [m].
const NARROW: [f64; 2] = [2.2, 2.6];
const NARROW_LENGTH: [f64; 2] = [50.0, 250.0];
const TRANSITION: f64 = 25.0;
/// The road before and after [m].
const AROUND: [f64; 2] = [15.0, 50.0];

/// A bend.
pub(super) fn sharp_bend(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let turn = pen.dice.between(TURN[0], TURN[1]) * pen.dice.sign();
    let limit = pen.dice.pick(&[BEND_LIMIT, 50.0]);
    let bent = bend(pen, &mouth.clone().at_most(limit), turn);
    Some(Built::road(after(pen, bent, mouth.limit_kmh), Hazard::SharpBend))
}

/// A bend, and one back.
pub(super) fn reverse_curve(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let turn = pen.dice.between(THERE_AND_BACK[0], THERE_AND_BACK[1]) * pen.dice.sign();
    let there = bend(pen, &mouth.clone().at_most(BEND_LIMIT), turn);
    let there = if pen.dice.chance(0.5) { pen.straight(&there, [2.0, 20.0]) } else { there };
    let back = bend(pen, &there, -turn);
    Some(Built::road(after(pen, back, mouth.limit_kmh), Hazard::ReverseCurve))
}

/// Bends so tight, of lanes so narrow, that a long vehicle needs both directions.
pub(super) fn hairpin(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let usual: Vec<f64> = mouth.knots.iter().map(|it| it.offset).collect();
    let width = pen.dice.between(HAIRPIN_WIDTH[0], HAIRPIN_WIDTH[1]);
    let there = Stretch::onward(mouth, Path::straight(mouth.pose, TRANSITION));
    let narrow = pen.draw(&there.to(&narrowed(mouth, width), Ease::Smooth)).at_most(BEND_LIMIT);
    let turn = pen.dice.between(HAIRPIN[0], HAIRPIN[1]) * pen.dice.sign();
    let inner = pen.dice.between(HAIRPIN_RADIUS[0], HAIRPIN_RADIUS[1]);
    let radius = (inner + (narrow.breadth() - width) / 2.0) * turn.signum();
    let bent = pen.go_on(&narrow, Path::arc(narrow.pose, radius, turn));
    let back = Stretch::onward(&bent, Path::straight(bent.pose, TRANSITION));
    let wide = pen.draw(&back.to(&usual, Ease::Smooth));
    Some(Built::road(after(pen, wide, mouth.limit_kmh), Hazard::Hairpin))
}

/// The offsets of the lines of lanes of this width [m].
fn narrowed(mouth: &Mouth, width: f64) -> Vec<f64> {
    let lanes = mouth.lanes() as f64;
    if mouth.is_two_way() {
        two_way_offsets(width, 0.0).to_vec()
    } else {
        (0..=mouth.lanes()).map(|it| (lanes / 2.0 - it as f64) * width).collect()
    }
}

fn after(pen: &mut Pen, bent: Mouth, limit_kmh: f64) -> Mouth {
    pen.straight(&Mouth { limit_kmh, ..bent }, AROUND)
}

fn bend(pen: &mut Pen, mouth: &Mouth, turn: f64) -> Mouth {
    let inner = pen.dice.between(RADIUS[0], RADIUS[1]);
    let radius = (inner + (mouth.breadth() - mouth.lane_width()) / 2.0) * turn.signum();
    pen.go_on(mouth, Path::arc(mouth.pose, radius, turn))
}

/// A row of very short lanelets.
pub(super) fn short_lanelets(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let number = pen.dice.count(ROW[0], ROW[1]);
    let mut cuts = vec![0.0];
    for _ in 0..number {
        cuts.push(cuts[cuts.len() - 1] + pen.dice.between(SHORT[0], SHORT[1]));
    }
    let length = cuts.pop()?;
    cuts.remove(0);
    let path = pen.gentle(mouth, length);
    let end = pen.draw(&Stretch { cuts, ..Stretch::onward(mouth, path) });
    Some(Built::road(pen.straight(&end, AROUND), Hazard::ShortLanelets))
}

/// Lanes that are hardly wider than vehicles.
pub(super) fn narrow_lanes(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let usual: Vec<f64> = mouth.knots.iter().map(|it| it.offset).collect();
    let width = pen.dice.between(NARROW[0], NARROW[1]);
    let offsets = narrowed(mouth, width);
    let there = Stretch::onward(mouth, Path::straight(mouth.pose, TRANSITION));
    let narrow = pen.draw(&there.to(&offsets, Ease::Smooth));
    let length = pen.dice.between(NARROW_LENGTH[0], NARROW_LENGTH[1]);
    let path = pen.gentle(&narrow, length);
    let end = pen.go_on(&narrow, path);
    let back = Stretch::onward(&end, Path::straight(end.pose, TRANSITION));
    Some(Built::road(pen.draw(&back.to(&usual, Ease::Smooth)), Hazard::NarrowLanes))
}
