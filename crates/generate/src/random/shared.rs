//! Streets whose directions share an area: all of it, or a part.

use super::element::Built;
use super::hazard::Hazard;
use super::mouth::{Mouth, Width, two_way_offsets};
use super::stretch::{Ease, Pen, Stretch};
use crate::path::Path;

/// Length of one lane for both directions [m].
const ONE_LANE: [f64; 2] = [40.0, 300.0];
/// Length of a partial overlap of the directions [m], and its width [m].
const PARTIAL: [f64; 2] = [50.0, 400.0];
const OVERLAP: [f64; 2] = [0.3, 1.8];
/// Length of the transition from lanes side by side to lanes that share an area [m].
const TRANSITION: [f64; 2] = [20.0, 40.0];
/// Maximum limit of streets that share an area [km/h].
const LIMIT: f64 = 50.0;

/// One lane for both directions.
pub(super) fn one_lane_street(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let width = mouth.lane_width();
    sharing(pen, mouth, width, ONE_LANE, Hazard::OneLaneStreet)
}

/// Directions that partly overlap.
pub(super) fn partial_overlap(pen: &mut Pen, mouth: &Mouth) -> Option<Built> {
    let overlap = pen.dice.between(OVERLAP[0], OVERLAP[1]);
    sharing(pen, mouth, overlap, PARTIAL, Hazard::PartialOverlap)
}

/// A street that shares an area from the edge of the map on.
pub(super) fn from_edge(pen: &mut Pen, start: &Mouth) -> Option<Built> {
    let (shared, hazard) = shared_from(pen, start);
    Some(Built::road(parting(pen, &shared, 0.0), hazard))
}

/// A street that shares an area from one edge of the map to the other.
pub(super) fn edge_to_edge(pen: &mut Pen, start: &Mouth) -> Option<Built> {
    let (_, hazard) = shared_from(pen, start);
    Some(Built { mouths: Vec::new(), hazard: Some(hazard) })
}

fn shared_from(pen: &mut Pen, start: &Mouth) -> (Mouth, Hazard) {
    let whole = pen.dice.chance(0.5);
    let (length, hazard, overlap) = if whole {
        (ONE_LANE, Hazard::OneLaneStreet, start.lane_width())
    } else {
        (PARTIAL, Hazard::PartialOverlap, pen.dice.between(OVERLAP[0], OVERLAP[1]))
    };
    let width = Width { lane: start.lane_width(), limit_kmh: start.limit_kmh.min(LIMIT) };
    let edge = Mouth::two_way(&mut pen.canvas, start.pose, overlap, width);
    (run(pen, &edge, length), hazard)
}

fn sharing(pen: &mut Pen, mouth: &Mouth, overlap: f64, length: [f64; 2], hazard: Hazard) -> Option<Built> {
    if !mouth.is_two_way() {
        return None;
    }
    let meeting = parting(pen, &mouth.clone().at_most(LIMIT), overlap);
    let shared = run(pen, &meeting, length);
    if pen.dice.chance(0.15) {
        return Some(Built { mouths: Vec::new(), hazard: Some(hazard) });
    }
    Some(Built::road(parting(pen, &shared, 0.0), hazard))
}

fn run(pen: &mut Pen, mouth: &Mouth, [from, to]: [f64; 2]) -> Mouth {
    let length = pen.dice.between(from, to);
    let path = pen.gentle(mouth, length);
    let is_doubled = pen.dice.chance(0.5);
    pen.draw(&Stretch { is_doubled, ..Stretch::onward(mouth, path) })
}

/// The transition to lanes that overlap so much [m].
fn parting(pen: &mut Pen, mouth: &Mouth, overlap: f64) -> Mouth {
    let length = pen.dice.between(TRANSITION[0], TRANSITION[1]);
    let stretch = Stretch::onward(mouth, Path::straight(mouth.pose, length));
    pen.draw(&stretch.to(&two_way_offsets(mouth.lane_width(), overlap), Ease::Smooth))
}
