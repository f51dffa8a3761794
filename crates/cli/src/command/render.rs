//! `laneweave render`.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use laneweave::Fault;
use laneweave::output::write_whole;
use laneweave_viewer::{Camera, Pictures, render};

use super::numbers::number;
use super::say;
use super::shown::ShownArguments;

#[derive(Debug, Args)]
pub(crate) struct RenderArguments {
    #[command(flatten)]
    shown: ShownArguments,
    /// Folder of the pictures. Pictures in it with the same names are replaced.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, default_value = "frames")]
    out: PathBuf,
    /// Where the camera is: map, the place in its middle with the width of what is seen, such as 120,-40,300 in metres,
    /// or the vehicle that it follows, such as vehicle:17.
    #[arg(long, value_name = "CAMERA", value_parser = camera, default_value = "map", allow_hyphen_values = true)]
    camera: Camera,
    /// Width and height of the pictures in pixels.
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x720")]
    size: [u32; 2],
    /// Seconds between two pictures.
    #[arg(long, value_name = "S", value_parser = number, default_value = "0.5")]
    every: f64,
    /// Time of the first picture in seconds [default: the begin].
    #[arg(long, value_name = "S", value_parser = number)]
    from: Option<f64>,
    /// No picture is later than this, in seconds [default: the end].
    #[arg(long, value_name = "S", value_parser = number)]
    until: Option<f64>,
}

fn camera(text: &str) -> Result<Camera, String> {
    if text == "map" {
        return Ok(Camera::Map);
    }
    if let Some(id) = text.strip_prefix("vehicle:") {
        return id.parse().map(Camera::Follow).map_err(|_| format!("{id:?} is no id of a vehicle"));
    }
    let numbers: Option<Vec<f64>> = text.split(',').map(|it| it.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some([x, y, width]) if x.is_finite() && y.is_finite() && (1.0..=1e6).contains(width) => {
            Ok(Camera::Place { x: *x, y: *y, width: *width })
        }
        _ => Err("write map, X,Y,WIDTH with a width of 1 to 1000000 m, or vehicle:ID".into()),
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let pixels = |part: &str| part.trim().parse().ok().filter(|it| (1..=16_384).contains(it));
    let size = text.split_once('x').and_then(|(width, height)| Some([pixels(width)?, pixels(height)?]));
    size.ok_or_else(|| "write WIDTHxHEIGHT, each 1 to 16384 pixels".into())
}

impl RenderArguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let RenderArguments { shown, out, camera, size, every, from, until } = self;
        if every <= 0.0 {
            return Err(Fault::new(
                "--every",
                format!("{every} s between two pictures"),
                "choose more than 0 s",
            ));
        }
        let mut source = shown.shown().source(Path::new("saved"))?;
        let asked = Pictures { camera, size, every_s: every, from_s: from, until_s: until };
        let count = render(&mut *source, asked, |number, _, picture| {
            fs::create_dir_all(&out).map_err(|error| Fault::refused(&out, "made", &error))?;
            write_whole(&out.join(format!("frame_{number:05}.png")), picture)
        })?;
        if count == 0 {
            let what = "no picture lies between --from and --until";
            return Err(Fault::new("render", what, "choose an earlier --from, or a later --until"));
        }
        let pictures = if count == 1 { "picture" } else { "pictures" };
        say(&format!("{count} {pictures} in {}\n", out.display()))
    }
}
