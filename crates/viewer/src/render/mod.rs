//! Pictures of traffic from above, without a browser and without a display.

mod camera;
mod draw;

use laneweave::Fault;
use tiny_skia::Pixmap;

use crate::scene::Scene;
use crate::snapshot::{Seen, Snapshot};
use crate::source::{Source, Wants};

pub use camera::Camera;
use camera::Sight;

/// What pictures show, and how large they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pictures {
    /// Where the camera is.
    pub camera: Camera,
    /// Width and height [px].
    pub size: [u32; 2],
    /// Time between two pictures [s].
    pub every_s: f64,
    /// Time of the first picture [s]; none: the first time of the source.
    pub from_s: Option<f64>,
    /// No picture is later than this [s]; none: the last time of the source.
    pub until_s: Option<f64>,
}

/// Makes pictures of `source`, and gives each as PNG to `take`, with its number and its time [s]. Returns how many.
///
/// # Errors
/// If the source has no end and none is asked for, if a size is impossible, or if `take` fails.
pub fn render(
    source: &mut dyn Source,
    asked: Pictures,
    mut take: impl FnMut(u32, f64, &[u8]) -> Result<(), Fault>,
) -> Result<u32, Fault> {
    let hello = source.hello();
    let until_s = asked.until_s.or(hello.end_s).ok_or_else(|| {
        Fault::new("render", "a simulation that runs now has no end", "say until when, with --until")
    })?;
    let scene = source.scene();
    go_to(source, asked.from_s.unwrap_or(hello.begin_s))?;
    // Half a step: times are sums of steps.
    let (every, almost) = ((asked.every_s / source.step_s()).round().max(1.0) as u32, 0.5 * source.step_s());
    let mut number = 0;
    while source.time_s() <= until_s + almost {
        let mut snapshot = Snapshot::default();
        source.see(&Wants::default(), &mut snapshot);
        let picture = drawn(&scene, &snapshot, asked.camera, asked.size)?.to_png()?;
        take(number, snapshot.time_s, &picture)?;
        number += 1;
        let is_next_too_late = source.time_s() + f64::from(every) * source.step_s() > until_s + almost;
        if is_next_too_late || source.has_ended() {
            break;
        }
        (0..every).try_for_each(|_| source.step(&mut Vec::new()))?;
    }
    Ok(number)
}

/// Goes to a time; a simulation that runs now can only go on to it.
fn go_to(source: &mut dyn Source, time_s: f64) -> Result<(), Fault> {
    if source.hello().can.seek {
        return source.seek(time_s);
    }
    while source.time_s() + 0.5 * source.step_s() < time_s {
        source.step(&mut Vec::new())?;
    }
    Ok(())
}

/// A picture.
pub struct Picture(Pixmap);

impl Picture {
    /// It as PNG.
    ///
    /// # Errors
    /// None, as long as there is memory.
    pub fn to_png(&self) -> Result<Vec<u8>, Fault> {
        self.0.encode_png().map_err(|error| Fault::bug("render", error))
    }

    /// Red, green and blue of its pixels, row by row from the top. Nothing in it is transparent.
    #[must_use]
    pub fn to_rgb(&self) -> Vec<u8> {
        self.0.pixels().iter().flat_map(|it| [it.red(), it.green(), it.blue()]).collect()
    }
}

/// A picture of `source` as it is now, of so many pixels.
///
/// # Errors
/// If the size is impossible.
pub fn picture(source: &mut dyn Source, camera: Camera, size: [u32; 2]) -> Result<Picture, Fault> {
    let mut snapshot = Snapshot::default();
    source.see(&Wants::default(), &mut snapshot);
    drawn(&source.scene(), &snapshot, camera, size)
}

fn drawn(scene: &Scene, snapshot: &Snapshot, camera: Camera, size: [u32; 2]) -> Result<Picture, Fault> {
    let [width, height] = size;
    let mut canvas = Pixmap::new(width, height).ok_or_else(|| {
        let what = format!("a picture of {width} × {height} pixels");
        Fault::new("--size", what, "choose 1x1 to 16384x16384")
    })?;
    let sight = Sight::of(camera, scene, snapshot, size);
    draw::ground(&mut canvas);
    draw::roads(&mut canvas, &sight, scene);
    draw::lights(&mut canvas, &sight, scene, snapshot);
    let vehicles: Vec<&Seen> = snapshot.vehicles.iter().filter(|it| sight.shows(it)).collect();
    vehicles.into_iter().for_each(|it| draw::vehicle(&mut canvas, &sight, it));
    Ok(Picture(canvas))
}
