//! `laneweave generate`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use laneweave::Fault;
use laneweave::maps::generate::{Motorway, motorway};
use laneweave::maps::{FORMATS, lanelet2};
use laneweave::network::DrivingSide;
use laneweave::output::write_whole;

#[derive(Debug, Subcommand)]
pub(crate) enum Kind {
    /// A straight motorway, with ramps and a lane drop if you like.
    Motorway(Arguments),
}

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Number of lanes.
    #[arg(long, value_name = "N", default_value_t = 3)]
    lanes: usize,
    /// Length [m].
    #[arg(long, value_name = "M", default_value_t = 5000.0, allow_negative_numbers = true)]
    length: f64,
    /// Where an on-ramp meets the road [m]; may be repeated.
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    on_ramp_at: Vec<f64>,
    /// Where an off-ramp leaves it [m]; may be repeated.
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    off_ramp_at: Vec<f64>,
    /// Where the slow lane ends [m].
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    lane_drop_at: Option<f64>,
    /// Speed limit [km/h].
    #[arg(long, value_name = "KMH", default_value_t = 120.0, allow_negative_numbers = true)]
    speed_limit: f64,
    /// On which side traffic drives.
    #[arg(long, value_name = "SIDE", value_enum, default_value_t = Driving::Right)]
    driving_side: Driving,
    /// The map file to write (.osm); one that is there is replaced.
    file: PathBuf,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Driving {
    Left,
    Right,
}

impl Kind {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let Kind::Motorway(arguments) = self;
        let file = arguments.file;
        let extension = file.extension().map_or("".into(), |it| it.to_string_lossy());
        if !FORMATS.iter().any(|format| format.extensions.contains(&extension.as_ref())) {
            let what = "this is no name of a map file";
            return Err(Fault::new(file.display(), what, "let it end in .osm"));
        }
        let plan = Motorway {
            lanes: arguments.lanes,
            length_m: arguments.length,
            speed_limit_kmh: arguments.speed_limit,
            on_ramp_at: arguments.on_ramp_at,
            off_ramp_at: arguments.off_ramp_at,
            lane_drop_at: arguments.lane_drop_at,
            driving_side: match arguments.driving_side {
                Driving::Left => DrivingSide::Left,
                Driving::Right => DrivingSide::Right,
            },
            ..Motorway::default()
        };
        let drawing = motorway(&plan).map_err(|error| {
            let message = error.to_string();
            let (what, remedy) = message.rsplit_once("; ").unwrap_or((&message, "choose another"));
            Fault::new("generate motorway", what, remedy)
        })?;
        write_whole(&file, &lanelet2::write(&drawing))
    }
}
