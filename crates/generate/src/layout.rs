//! A plan of junctions and the streets between them, and its drawing.

use laneweave_network::Pose;

use super::canvas::Canvas;
use super::compass::Compass;
use super::control::{Control, regulate};
use super::junction::{Arm, connect, setback};
use super::movement::{Lanes, Movement, usual};
use super::path::Path;
use super::ring::{compass_ring, usual_ring};
use super::street::{End, Mouth, Profile, pose, street};

/// Junctions and the streets between them.
#[derive(Clone, Debug, Default)]
pub(super) struct Layout {
    pub(super) junctions: Vec<Junction>,
    pub(super) streets: Vec<Street>,
}

/// A place where streets meet.
#[derive(Clone, Debug)]
pub(super) struct Junction {
    /// Its middle, where the paths of its streets meet: east and north [m].
    pub(super) at: (f64, f64),
    pub(super) kind: Kind,
}

/// How streets meet.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// With the usual movements.
    Crossing(Control),
    /// With these movements only.
    Marked(Control, Vec<Movement>),
    /// Around a roundabout of one lane; arms have at most one lane in each direction.
    Roundabout,
}

/// A street between two places.
#[derive(Clone, Debug)]
pub(super) struct Street {
    pub(super) from: Place,
    pub(super) to: Place,
    pub(super) profile: Profile,
}

/// Where a street begins or ends.
#[derive(Clone, Debug)]
pub(super) enum Place {
    /// The edge of the map; the pose of the street's path.
    Edge(Pose),
    /// The arm of the junction with this number.
    Arm(usize, Compass),
    /// Another road: its points across, and the pose of the street's path.
    Road(Vec<u32>, Pose),
}

/// Draws streets, then junctions.
pub(super) fn draw(canvas: &mut Canvas, layout: &Layout) {
    let lanes = layout.lanes();
    let mut arms: Vec<Vec<Arm>> = vec![Vec::new(); layout.junctions.len()];
    for Street { from, to, profile } in &layout.streets {
        let begin = layout.pose(&lanes, from, Compass::heading);
        let end = layout.pose(&lanes, to, |it| it.opposite().heading());
        let path = Path::between(begin, end);
        let mouths = street(canvas, &path, profile, [from.end(), to.end()]);
        for (place, Mouth { arriving, leaving, .. }) in [from, to].into_iter().zip(mouths) {
            if let Place::Arm(junction, towards) = *place {
                arms[junction].push(Arm { towards, arriving, leaving, limit_kmh: profile.limit_kmh });
            }
        }
    }
    for ((junction, mut arms), lanes) in layout.junctions.iter().zip(arms).zip(&lanes) {
        arms.sort_by_key(|it| it.towards as u8);
        let crossing = |canvas: &mut Canvas, control: Control, movements: &[Movement]| {
            let connectors = connect(canvas, &arms, movements);
            regulate(canvas, control, &arms, &connectors);
        };
        match &junction.kind {
            Kind::Crossing(control) => crossing(canvas, *control, &usual(lanes)),
            Kind::Marked(control, movements) => crossing(canvas, *control, movements),
            Kind::Roundabout => compass_ring(canvas, usual_ring(junction.at), &arms),
        }
    }
}

impl Place {
    fn end(&self) -> End {
        match self {
            Place::Edge(_) => End::Open,
            Place::Arm(..) => End::Junction,
            Place::Road(points, _) => End::Road(points.clone()),
        }
    }
}

impl Layout {
    /// For each junction how many lanes its arms have, in the order of [`Compass::ALL`].
    fn lanes(&self) -> Vec<[Lanes; 4]> {
        let mut lanes = vec![[Lanes::default(); 4]; self.junctions.len()];
        for Street { from, to, profile } in &self.streets {
            let (along, against) = (profile.along, profile.against);
            if let Place::Arm(junction, towards) = *from {
                lanes[junction][towards as usize] = Lanes { arriving: against, leaving: along };
            }
            if let Place::Arm(junction, towards) = *to {
                lanes[junction][towards as usize] = Lanes { arriving: along, leaving: against };
            }
        }
        lanes
    }

    /// The pose of a street's path at its end, with this `heading` if an arm of a junction is there.
    fn pose(&self, lanes: &[[Lanes; 4]], place: &Place, heading: impl Fn(Compass) -> f64) -> Pose {
        match *place {
            Place::Edge(pose) | Place::Road(_, pose) => pose,
            Place::Arm(number, towards) => {
                let Junction { at, kind } = &self.junctions[number];
                let away = match kind {
                    Kind::Roundabout => usual_ring(*at).setback(),
                    _ => setback(&lanes[number], towards),
                };
                let (east, north) = towards.step();
                pose(at.0 + away * east, at.1 + away * north, heading(towards))
            }
        }
    }
}
