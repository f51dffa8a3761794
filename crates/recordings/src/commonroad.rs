//! CommonRoad recordings: the dynamic obstacles of XML in the versions 2018b and 2020a.
//!
//! For a value given as an interval the middle is taken, for a position given as an area its centre. A state without
//! a velocity gets that of the path from the state before, or to the next one. The first frame is number 0.
//!
//! Unobserved obstacles and planning problems are ignored. Occupancy sets are ignored, too: they say where an obstacle
//! may be. The map, with what stands in it, is read by [`laneweave_maps::commonroad`].

mod obstacle;

use std::collections::HashSet;

use laneweave_maps::Problem;
use laneweave_maps::xml::{Element, Visitor, XmlError, number, walk};

use crate::error::RecordingError;
use crate::gaps::leave_out_parts;
use crate::recording::{Recording, RoadUser, Track};
use crate::table::in_range;
use obstacle::Obstacle;

/// Largest file that is read [B].
pub(crate) const MAXIMUM_SIZE: u64 = 512 << 20;

/// Reads the road users of a CommonRoad file. Those that cannot be used as they stand are left out and listed
/// as problems, as are states.
///
/// # Errors
/// If it is no CommonRoad XML, does not say the time between frames, or has no road user with a state.
pub fn read(bytes: &[u8]) -> Result<(Recording, Vec<Problem>), RecordingError> {
    if bytes.len() as u64 > MAXIMUM_SIZE {
        return Err(RecordingError::TooLarge { bytes: bytes.len() as u64, limit: MAXIMUM_SIZE });
    }
    let mut draft = Draft::default();
    walk(bytes, "commonRoad", &mut draft)?;
    let Draft { line, step, tracks, mut problems, standing, .. } = draft;
    if !(step > 0.0 && step.is_finite()) {
        return Err(RecordingError::NoStep { line, element: "commonRoad", attribute: "timeStepSize" });
    }
    in_range(1000.0 * step, line, "timeStepSize")?;
    problems.extend(standing.problem());
    problems.sort_by_key(|it| it.line);
    if tracks.is_empty() {
        return Err(RecordingError::Empty { problems });
    }
    let mut recording = Recording { step, tracks, ..Recording::default() };
    leave_out_parts(&mut recording, &mut problems);
    Ok((recording, problems))
}

/// A recording under construction, obstacle by obstacle.
#[derive(Default)]
struct Draft {
    /// Line of the outermost element.
    line: usize,
    /// Time between frames [s]; NaN where it is missing or unreadable.
    step: f64,
    tracks: Vec<Track>,
    ids: HashSet<i64>,
    problems: Vec<Problem>,
    building: Option<Obstacle>,
    standing: Standing,
}

impl Visitor for Draft {
    fn open(&mut self, path: &str, element: &Element) -> Result<(), XmlError> {
        match path {
            "" => {
                let [step] = element.values(["timeStepSize"])?;
                self.step = step.map_or(f64::NAN, |it| number(&it));
                self.line = element.line;
            }
            "dynamicObstacle" | "obstacle" | "staticObstacle" => {
                let [id] = element.values(["id"])?;
                match id.as_deref().and_then(|it| it.parse().ok()) {
                    Some(id) => {
                        let is_static = path == "staticObstacle";
                        let line = element.line;
                        self.building = Some(Obstacle::new(id, line, is_static));
                    }
                    None => self.problems.push(Problem {
                        element: format!("{path} {}", id.unwrap_or_default()).trim_end().into(),
                        line: Some(element.line),
                        what: "its id is missing or not a whole number, so it is left out".into(),
                        remedy: "give it an id of its own".into(),
                    }),
                }
            }
            _ => {
                if let (Some(obstacle), Some((_, part))) = (&mut self.building, path.split_once('/')) {
                    obstacle.open(part, element.line);
                }
            }
        }
        Ok(())
    }

    fn close(&mut self, path: &str, text: &str) {
        match path.split_once('/') {
            Some((_, part)) => {
                if let Some(obstacle) = &mut self.building {
                    obstacle.close(part, text);
                }
            }
            None => {
                if let Some(obstacle) = self.building.take() {
                    self.keep(obstacle);
                }
            }
        }
    }
}

impl Draft {
    fn keep(&mut self, obstacle: Obstacle) {
        if obstacle.is_static {
            self.standing.count(&obstacle);
        } else if !self.ids.insert(obstacle.id) {
            let what = "another obstacle above has the same id, so this one is left out";
            self.problems.push(obstacle.problem(what, "give it an id of its own"));
        } else {
            self.tracks.extend(obstacle.track(self.step, &mut self.problems));
        }
    }
}

/// Static vehicles.
#[derive(Default)]
struct Standing {
    number: usize,
    /// Id and line of the first.
    first: (i64, usize),
}

impl Standing {
    fn count(&mut self, obstacle: &Obstacle) {
        use RoadUser::{Bus, Car, Motorcycle, Truck};
        if obstacle.kind == "parkedVehicle" || matches!(obstacle.class(), Car | Truck | Bus | Motorcycle) {
            if self.number == 0 {
                self.first = (obstacle.id, obstacle.line);
            }
            self.number += 1;
        }
    }

    fn problem(&self) -> Option<Problem> {
        let (id, line) = self.first;
        (self.number > 0).then(|| Problem {
            element: format!("obstacle {id}"),
            line: Some(line),
            what: format!("parked vehicles are no tracks: this one and {} more", self.number - 1),
            remedy: "take this file as the map: then they stand on its roads".into(),
        })
    }
}
