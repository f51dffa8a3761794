//! `laneweave generate`.

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueEnum, ValueHint};
use laneweave::Fault;
use laneweave::generate::{
    Arterial, Control, GenerateError, Grid, Hazard, Motorway, RandomMap, Roundabout, approach, arterial,
    grid, large_town, motorway, random, random_with, roundabout, town,
};
use laneweave::maps::{Drawing, FileKind, is_compressed};
use laneweave::network::DrivingSide;
use laneweave::output::write_whole;

use super::examples;
use super::numbers::{number, seed, whole};
use super::say;

#[derive(Debug, Subcommand)]
pub(crate) enum Kind {
    /// A straight motorway, optionally with ramps and a lane drop.
    #[command(after_help = examples::MOTORWAY)]
    Motorway(MotorwayArguments),
    /// A straight motorway with a weaving section: an on-ramp, an off-ramp, and an auxiliary lane between them.
    #[command(after_help = examples::WEAVING)]
    Weaving(WeavingArguments),
    /// A grid of streets that cross at right angles.
    #[command(after_help = examples::GRID)]
    Grid(GridArguments),
    /// A main street of two lanes in each direction, and one-lane streets that cross it at traffic lights.
    #[command(after_help = examples::ARTERIAL)]
    Arterial(ArterialArguments),
    /// A roundabout of one or two lanes.
    #[command(after_help = examples::ROUNDABOUT)]
    Roundabout(RoundaboutArguments),
    /// Three lanes before a junction: A leads left, B left and straight on, C straight on.
    #[command(after_help = examples::APPROACH)]
    Approach(Plain),
    /// A town with junctions of all kinds, and a motorway through it; with --size a larger one without a motorway.
    #[command(after_help = examples::TOWN)]
    Town(TownArguments),
    /// A random map of elements that are difficult for a simulator; it lists these elements.
    #[command(after_help = examples::RANDOM)]
    Random(RandomArguments),
}

#[derive(Debug, Args)]
pub(crate) struct MotorwayArguments {
    /// Number of lanes, 1 to 12.
    #[arg(long, value_name = "N", value_parser = whole::<usize>, default_value_t = 3)]
    lanes: usize,
    /// Length [m].
    #[arg(long, value_name = "M", default_value_t = 5000.0, value_parser = number)]
    length: f64,
    /// Where an on-ramp meets the road [m from its start]; may be repeated.
    #[arg(long, value_name = "M", value_parser = number)]
    on_ramp_at: Vec<f64>,
    /// Where an off-ramp leaves the road [m from its start]; may be repeated.
    #[arg(long, value_name = "M", value_parser = number)]
    off_ramp_at: Vec<f64>,
    /// Where the slow lane ends [m from the start of the road].
    #[arg(long, value_name = "M", value_parser = number)]
    lane_drop_at: Option<f64>,
    /// Speed limit [km/h], 5 to 300.
    #[arg(long, value_name = "KMH", default_value_t = 120.0, value_parser = number)]
    speed_limit: f64,
    #[command(flatten)]
    plain: Plain,
}

#[derive(Debug, Args)]
pub(crate) struct WeavingArguments {
    /// Number of lanes, 1 to 12, without the auxiliary lane between the ramps.
    #[arg(long, value_name = "N", value_parser = whole::<usize>, default_value_t = 2)]
    lanes: usize,
    /// From the on-ramp to the off-ramp [m], 100 to 1000.
    #[arg(long, value_name = "M", default_value_t = 450.0, value_parser = number)]
    length: f64,
    /// Speed limit [km/h], 5 to 300.
    #[arg(long, value_name = "KMH", default_value_t = 120.0, value_parser = number)]
    speed_limit: f64,
    #[command(flatten)]
    plain: Plain,
}

#[derive(Debug, Args)]
pub(crate) struct GridArguments {
    /// Streets that run east and west, 1 to 50.
    #[arg(long, value_name = "R", value_parser = whole::<usize>)]
    rows: usize,
    /// Streets that run north and south, 1 to 50.
    #[arg(long, value_name = "C", value_parser = whole::<usize>)]
    columns: usize,
    /// From one junction to the next [m], 80 to 1000.
    #[arg(long, value_name = "M", default_value_t = 150.0, value_parser = number)]
    block_length: f64,
    /// Number of lanes in each direction, 1 to 3.
    #[arg(long, value_name = "N", value_parser = whole::<usize>, default_value_t = 2)]
    lanes: usize,
    /// Speed limit [km/h], 5 to 130.
    #[arg(long, value_name = "KMH", default_value_t = 50.0, value_parser = number)]
    speed_limit: f64,
    /// Control of the junctions; with priority, the streets that run east and west have priority.
    #[arg(long, value_enum, default_value_t = Order::Signals)]
    control: Order,
    /// Keep the slow one of several lanes for buses, but not within 60 m of junctions; blocks are 200 m or longer.
    #[arg(long)]
    bus_lanes: bool,
    #[command(flatten)]
    plain: Plain,
}

#[derive(Debug, Args)]
pub(crate) struct ArterialArguments {
    /// Number of junctions, 1 to 50.
    #[arg(long, value_name = "N", value_parser = whole::<usize>)]
    junctions: usize,
    /// From one junction to the next [m], 80 to 1000.
    #[arg(long, value_name = "M", default_value_t = 300.0, value_parser = number)]
    block_length: f64,
    /// Speed limit [km/h], 5 to 130.
    #[arg(long, value_name = "KMH", default_value_t = 50.0, value_parser = number)]
    speed_limit: f64,
    /// Keep the slow lanes of the main street for buses, but not within 60 m of junctions; blocks are 200 m or longer.
    #[arg(long)]
    bus_lanes: bool,
    #[command(flatten)]
    plain: Plain,
}

#[derive(Debug, Args)]
pub(crate) struct RoundaboutArguments {
    /// Number of arms, 3 to 6.
    #[arg(long, value_name = "N", value_parser = whole::<usize>, default_value_t = 4)]
    arms: usize,
    /// Number of lanes around it, and on each arm in each direction, 1 or 2.
    #[arg(long, value_name = "N", value_parser = whole::<usize>, default_value_t = 1)]
    lanes: usize,
    /// Radius of the middle of its ring [m], up to 60 [default: the smallest for these arms and lanes].
    #[arg(long, value_name = "M", value_parser = number)]
    radius: Option<f64>,
    #[command(flatten)]
    plain: Plain,
}

#[derive(Debug, Args)]
pub(crate) struct TownArguments {
    /// Streets in each direction of a larger town, 3 to 20 [default: the town with the motorway].
    #[arg(long, value_name = "N", value_parser = whole::<usize>)]
    size: Option<usize>,
    #[command(flatten)]
    plain: Plain,
}

#[derive(Debug, Args)]
pub(crate) struct RandomArguments {
    /// Seed of the map: the same seed gives the same map.
    #[arg(long, value_name = "N", value_parser = seed, default_value_t = 1)]
    seed: u64,
    /// Draw only this difficult element, and as many as there is room for, such as nested-fork; a wrong name lists all.
    #[arg(long, value_name = "ELEMENT")]
    only: Option<Hazard>,
    #[command(flatten)]
    plain: Plain,
}

/// What every map needs.
#[derive(Debug, Args)]
pub(crate) struct Plain {
    /// On which side traffic drives.
    #[arg(long, value_name = "SIDE", value_enum, default_value_t = Driving::Right)]
    driving_side: Driving,
    /// The map file to write (.osm); one that is there is replaced.
    #[arg(value_hint = ValueHint::FilePath)]
    file: PathBuf,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Driving {
    Left,
    Right,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Order {
    Signals,
    Priority,
    RightBeforeLeft,
    AllWayStop,
}

impl Kind {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let (name, file) = match &self {
            Kind::Motorway(it) => ("motorway", &it.plain.file),
            Kind::Weaving(it) => ("weaving", &it.plain.file),
            Kind::Grid(it) => ("grid", &it.plain.file),
            Kind::Arterial(it) => ("arterial", &it.plain.file),
            Kind::Roundabout(it) => ("roundabout", &it.plain.file),
            Kind::Approach(plain) => ("approach", &plain.file),
            Kind::Town(it) => ("town", &it.plain.file),
            Kind::Random(it) => ("random", &it.plain.file),
        };
        let write = writer(file)?;
        let drawing = self.draw().map_err(|error| {
            let message = error.to_string();
            let (what, remedy) = message.rsplit_once("; ").unwrap_or((&message, "choose another"));
            Fault::new(format!("generate {name}"), what, remedy)
        })?;
        write_whole(file, &write(&drawing))?;
        if let Kind::Random(it) = &self {
            say(&it.told())?;
        }
        Ok(())
    }

    fn draw(&self) -> Result<Drawing, GenerateError> {
        match self {
            Kind::Motorway(it) => it.draw(),
            Kind::Weaving(it) => it.draw(),
            Kind::Grid(it) => it.draw(),
            Kind::Arterial(it) => it.draw(),
            Kind::Roundabout(it) => it.draw(),
            Kind::Approach(it) => Ok(approach(it.side())),
            Kind::Town(it) => match it.size {
                Some(size) => large_town(size, it.plain.side()),
                None => Ok(town(it.plain.side())),
            },
            Kind::Random(it) => Ok(it.draw()),
        }
    }
}

/// The writer of the format that the name of a file says.
fn writer(file: &Path) -> Result<fn(&Drawing) -> String, Fault> {
    let writer = match FileKind::by_name(file) {
        FileKind::Map(format) if !is_compressed(file) => format.write,
        _ => None,
    };
    writer.ok_or_else(|| {
        let what = "this is not a valid name for a map file";
        Fault::new(file.display(), what, "use a name that ends in .osm")
    })
}

impl MotorwayArguments {
    fn draw(&self) -> Result<Drawing, GenerateError> {
        motorway(&Motorway {
            lanes: self.lanes,
            length_m: self.length,
            speed_limit_kmh: self.speed_limit,
            on_ramp_at: self.on_ramp_at.clone(),
            off_ramp_at: self.off_ramp_at.clone(),
            lane_drop_at: self.lane_drop_at,
            driving_side: self.plain.side(),
            ..Motorway::default()
        })
    }
}

impl WeavingArguments {
    fn draw(&self) -> Result<Drawing, GenerateError> {
        motorway(&Motorway {
            lanes: self.lanes,
            speed_limit_kmh: self.speed_limit,
            driving_side: self.plain.side(),
            ..Motorway::weaving(self.length)
        })
    }
}

impl GridArguments {
    fn draw(&self) -> Result<Drawing, GenerateError> {
        grid(&Grid {
            rows: self.rows,
            columns: self.columns,
            lanes: self.lanes,
            block_length_m: self.block_length,
            speed_limit_kmh: self.speed_limit,
            control: match self.control {
                Order::Signals => Control::Signals,
                Order::Priority => Control::Priority,
                Order::RightBeforeLeft => Control::RightBeforeLeft,
                Order::AllWayStop => Control::AllWayStop,
            },
            bus_lanes: self.bus_lanes,
            driving_side: self.plain.side(),
        })
    }
}

impl ArterialArguments {
    fn draw(&self) -> Result<Drawing, GenerateError> {
        arterial(&Arterial {
            junctions: self.junctions,
            block_length_m: self.block_length,
            speed_limit_kmh: self.speed_limit,
            bus_lanes: self.bus_lanes,
            driving_side: self.plain.side(),
        })
    }
}

impl RoundaboutArguments {
    fn draw(&self) -> Result<Drawing, GenerateError> {
        roundabout(&Roundabout {
            arms: self.arms,
            lanes: self.lanes,
            radius_m: self.radius,
            driving_side: self.plain.side(),
        })
    }
}

impl RandomArguments {
    fn map(&self) -> RandomMap {
        self.only.map_or_else(|| random(self.seed), |it| random_with(self.seed, it))
    }

    fn draw(&self) -> Drawing {
        let drawing = self.map().drawing;
        if self.plain.side() == drawing.driving_side { drawing } else { drawing.mirrored() }
    }

    /// The difficulties of the map, for the screen.
    fn told(&self) -> String {
        let hazards: Vec<&str> = self.map().hazards().into_iter().map(Hazard::name).collect();
        format!("random map {}: {}\n", self.seed, hazards.join(", "))
    }
}

impl Plain {
    fn side(&self) -> DrivingSide {
        match self.driving_side {
            Driving::Left => DrivingSide::Left,
            Driving::Right => DrivingSide::Right,
        }
    }
}
