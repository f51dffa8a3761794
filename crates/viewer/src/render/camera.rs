//! Where the camera is, and which pixel shows a place of the map. North is up.

use tiny_skia::Transform;

use crate::scene::Scene;
use crate::snapshot::{Seen, Snapshot};

/// Width of what is shown around a vehicle that is followed [m].
const AROUND: f64 = 150.0;
/// Share of a picture that the whole map fills.
const FILLED: f64 = 0.94;

/// Where the camera is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Camera {
    /// It shows the whole map.
    #[default]
    Map,
    /// It shows a part of the map of this width [m], around a place: east and north [m].
    Place {
        /// East [m].
        x: f64,
        /// North [m].
        y: f64,
        /// Width of what is shown [m].
        width: f64,
    },
    /// It follows the vehicle with this id; while that is not there, it shows the whole map.
    Follow(i64),
}

/// What a picture shows.
pub(super) struct Sight {
    /// The place in the middle, from the origin of the scene [m].
    middle: [f64; 2],
    /// Pixels per metre.
    pub(super) scale: f64,
    /// Width and height of the picture [px].
    size: [f64; 2],
    origin: [f64; 3],
}

impl Sight {
    pub(super) fn of(camera: Camera, scene: &Scene, snapshot: &Snapshot, size: [u32; 2]) -> Sight {
        let (size, origin) = (size.map(f64::from), scene.origin);
        let around = |x: f64, y: f64, width: f64| Sight {
            middle: [x - origin[0], y - origin[1]],
            scale: size[0] / width,
            size,
            origin,
        };
        let [west, south, east, north] = scene.bounds;
        let whole = || Sight {
            middle: [(west + east) / 2.0, (south + north) / 2.0],
            scale: FILLED * (size[0] / (east - west).max(1.0)).min(size[1] / (north - south).max(1.0)),
            size,
            origin,
        };
        match camera {
            Camera::Map => whole(),
            Camera::Place { x, y, width } => around(x, y, width),
            Camera::Follow(id) => {
                let found = snapshot.vehicles.iter().find(|it| it.id == id);
                found.map_or_else(whole, |it| around(it.at[0], it.at[1], AROUND))
            }
        }
    }

    /// The pixel that shows a place, which is given from the origin of the scene [m].
    pub(super) fn pixel(&self, x: f64, y: f64) -> [f32; 2] {
        let [middle_x, middle_y] = self.middle;
        let [width, height] = self.size;
        [
            (width / 2.0 + self.scale * (x - middle_x)) as f32,
            (height / 2.0 - self.scale * (y - middle_y)) as f32,
        ]
    }

    /// Whether a part of a vehicle is in the picture.
    pub(super) fn shows(&self, it: &Seen) -> bool {
        let [x, y] = self.at(it);
        let reach = (self.scale * it.length) as f32;
        let inside = |value: f32, end: f64| value > -reach && value < end as f32 + reach;
        inside(x, self.size[0]) && inside(y, self.size[1])
    }

    fn at(&self, it: &Seen) -> [f32; 2] {
        self.pixel(it.at[0] - self.origin[0], it.at[1] - self.origin[1])
    }

    /// From metres ahead and to the left of the middle of a vehicle to pixels. A vehicle is never drawn smaller than it
    /// can be seen.
    pub(super) fn body(&self, it: &Seen) -> Transform {
        /// Least length of a vehicle [px].
        const LEAST: f64 = 5.0;
        let [x, y] = self.at(it);
        let scale = self.scale.max(LEAST / it.length) as f32;
        let (sin, cos) = (it.heading.sin() as f32, it.heading.cos() as f32);
        Transform::from_row(scale * cos, -scale * sin, -scale * sin, -scale * cos, x, y)
    }
}
