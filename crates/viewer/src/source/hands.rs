//! What a user does by hand, as commands of the library.

use std::fs;
use std::path::{Path, PathBuf};

use laneweave::network::{LaneletIndex, Network, Point};
use laneweave::record;
use laneweave::scenario::{Origin, Scenario};
use laneweave::sim::{Command, Commanded, World};
use laneweave::study::{Format, TableWriter};
use laneweave::{
    COMMAND_COLUMNS, Class, Control, Fault, Lateral, LightState, Longitudinal, NewVehicle, Parameter, Side,
    Written,
};
use serde::{Deserialize, Serialize};

/// Something that a user does by hand.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Hand {
    /// Changes a number of a style.
    SetParameter {
        /// The name of the style.
        style: String,
        /// The number, by its key.
        parameter: Parameter,
        /// Its new value.
        value: f64,
    },
    /// Changes the demand at an entrance.
    SetDemand {
        /// The entrance, by its id.
        origin: String,
        /// Vehicles that arrive per hour.
        vehicles_per_hour: f64,
    },
    /// Changes the weight of a style among those of the drivers who arrive.
    SetShare {
        /// The name of the style.
        style: String,
        /// Its new weight.
        weight: f64,
    },
    /// Makes a light show something.
    SetLight {
        /// The light, by its id.
        light: String,
        /// What it shows; none: what its program says.
        shows: Option<LightState>,
    },
    /// Closes a lanelet, or opens it.
    CloseLanelet {
        /// The lanelet, by its id.
        lanelet: String,
        /// Whether it is closed from now on.
        is_closed: bool,
    },
    /// Puts a vehicle on the road, which the user drives.
    Put {
        /// Where, to the east [m].
        x: f64,
        /// Where, to the north [m].
        y: f64,
        /// Its class.
        class: Class,
    },
    /// Drives a vehicle.
    Drive {
        /// The vehicle, by its id.
        vehicle: String,
        /// The speed that it holds; none: its driver drives it [km/h].
        speed_kmh: Option<f64>,
        /// The side to which it changes lanes.
        side: Option<DriveSide>,
    },
    /// Gives the driver of a vehicle another style.
    SetStyle {
        /// The vehicle, by its id.
        vehicle: String,
        /// The name of the style.
        style: String,
    },
    /// Takes a vehicle off the road.
    Remove {
        /// The vehicle, by its id.
        vehicle: String,
    },
}

/// The side of a lane change by hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DriveSide {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// Something that was done by hand.
#[derive(Clone, Debug, Serialize)]
pub struct Done {
    /// Its number, from 1 on.
    pub number: usize,
    /// When [s].
    pub time_s: f64,
    /// In words.
    pub text: String,
    /// The vehicle that was put on the road.
    pub vehicle: Option<String>,
    /// Whether it was taken back.
    pub is_undone: bool,
    #[serde(skip)]
    pub(super) back: Option<Command>,
}

/// Where a scenario was saved.
#[derive(Clone, Debug, Serialize)]
pub struct Saved {
    /// The folder.
    pub folder: PathBuf,
    /// The scenario in it.
    pub scenario: PathBuf,
}

/// What can be changed, as it is after all that was done by hand.
pub(super) trait Present {
    /// The value of a number of a style.
    fn parameter(&self, style: &str, parameter: Parameter) -> Option<f64>;

    /// The weight of a style.
    fn share(&self, style: &str) -> Option<f64>;

    /// The demand at an entrance [veh/h].
    fn demand(&self, origin: i64) -> Option<f64>;
}

/// The commands of something done by hand: what is done, what takes it back, and what it is called.
pub(super) struct Deed {
    pub(super) command: Command,
    pub(super) back: Option<Command>,
    pub(super) text: String,
}

fn fault(what: impl ToString, remedy: &str) -> Fault {
    Fault::new("by hand", what.to_string(), remedy)
}

/// An id of the map, from its digits.
fn id(text: &str) -> Result<i64, Fault> {
    text.parse().map_err(|_| fault(format!("{text:?} is no id"), "give the digits of an id"))
}

impl Deed {
    /// What `hand` means in `world`; `now` knows what can be changed as it is now.
    pub(super) fn of(hand: &Hand, world: &World, now: &impl Present) -> Result<Deed, Fault> {
        Ok(match hand {
            Hand::SetParameter { style, parameter, value: new } => {
                let set =
                    |value| Command::SetParameter { style: style.clone(), parameter: *parameter, value };
                let old = now.parameter(style, *parameter);
                let from = old.map_or_else(String::new, |it| format!(" from {}", short(it)));
                let text = format!("{} of {style}{from} to {}", parameter.key(), short(*new));
                Deed { command: set(*new), back: old.map(set), text }
            }
            Hand::SetDemand { origin, vehicles_per_hour } => {
                let origin = id(origin)?;
                let set = |vehicles_per_hour| Command::SetDemand { origin, vehicles_per_hour };
                let old = now.demand(origin);
                let text = format!("demand at entrance {origin} to {} veh/h", short(*vehicles_per_hour));
                Deed { command: set(*vehicles_per_hour), back: old.map(set), text }
            }
            Hand::SetShare { style, weight } => {
                let set = |weight| Command::SetShare { style: style.clone(), weight };
                let old = now.share(style);
                let from = old.map_or_else(String::new, |it| format!(" from {}", short(it)));
                let text = format!("share of {style}{from} to {}", short(*weight));
                Deed { command: set(*weight), back: old.map(set), text }
            }
            Hand::SetLight { light, shows } => {
                let light = id(light)?;
                let set = |shows| Command::SetLight { light, shows };
                let state = match shows {
                    Some(LightState::Green) => "green",
                    Some(LightState::Yellow) => "yellow",
                    Some(LightState::Red) => "red",
                    None => "as its program says",
                };
                Deed { command: set(*shows), back: Some(set(None)), text: format!("light {light}: {state}") }
            }
            Hand::CloseLanelet { lanelet, is_closed } => {
                let lanelet = id(lanelet)?;
                let set = |is_closed| Command::CloseLanelet { lanelet, is_closed };
                let what = if *is_closed { "closed" } else { "open again" };
                Deed {
                    command: set(*is_closed),
                    back: Some(set(!is_closed)),
                    text: format!("lanelet {lanelet}: {what}"),
                }
            }
            Hand::Put { x, y, class } => put(world, [*x, *y], *class)?,
            Hand::Drive { .. } | Hand::SetStyle { .. } | Hand::Remove { .. } => {
                Deed::of_vehicle(hand, world)?
            }
        })
    }

    /// The same for something done to one vehicle.
    fn of_vehicle(hand: &Hand, world: &World) -> Result<Deed, Fault> {
        let named = match hand {
            Hand::Drive { vehicle, .. } | Hand::SetStyle { vehicle, .. } | Hand::Remove { vehicle } => {
                vehicle
            }
            _ => return Err(fault("this concerns no vehicle", "report this as a bug")),
        };
        let gone = || fault(format!("vehicle {named} is not on the road"), "choose one that is");
        let vehicle = named.parse().map_err(|_| gone())?;
        let now = world.vehicle(vehicle).ok_or_else(gone)?;
        Ok(match hand {
            Hand::Drive { speed_kmh, side, .. } => {
                let lateral = match side {
                    Some(DriveSide::Left) => Lateral::Change(Side::Left),
                    Some(DriveSide::Right) => Lateral::Change(Side::Right),
                    None => Lateral::Keep,
                };
                let drive = |it: f64| Control::Drive { longitudinal: Longitudinal::Speed(it / 3.6), lateral };
                let control = speed_kmh.map_or(Control::DRIVER, drive);
                let text = match (speed_kmh, lateral) {
                    (None, _) => format!("vehicle {vehicle}: back to its driver"),
                    (Some(speed), Lateral::Change(side)) => {
                        let side = super::driver::side_name(side);
                        format!("vehicle {vehicle}: {} km/h, to the {side}", short(*speed))
                    }
                    (Some(speed), _) => format!("vehicle {vehicle}: {} km/h", short(*speed)),
                };
                let back = Command::Control(vehicle, world.control_of(vehicle));
                Deed { command: Command::Control(vehicle, control), back: Some(back), text }
            }
            Hand::SetStyle { style, .. } => Deed {
                command: Command::SetStyle(vehicle, style.clone()),
                back: Some(Command::SetStyle(vehicle, now.style().name.clone())),
                text: format!("vehicle {vehicle}: style {style}"),
            },
            _ => Deed {
                command: Command::Remove(vehicle),
                back: None,
                text: format!("vehicle {vehicle}: taken off the road"),
            },
        })
    }
}

/// A new vehicle on the lane nearest to a point. It drives as fast as the limit allows, but no faster than the
/// vehicle ahead.
fn put(world: &World, [x, y]: [f64; 2], class: Class) -> Result<Deed, Fault> {
    let network = world.network();
    let (index, position_m) = nearest(network, &Point { x, y, z: 0.0 })
        .ok_or_else(|| fault("there is no lane", "put the vehicle on a lane"))?;
    let lanelet = &network.lanelets[index.at()];
    let at = network.start_of(index);
    let ahead = world
        .scene()
        .motions(at.chain)
        .iter()
        .find(|it| it.x > at.x + position_m)
        .map_or(f64::INFINITY, |it| it.speed);
    let style = world.driver_parameters().first().map_or_else(String::new, |it| it.name.clone());
    let speed_mps = lanelet.speed_limit.min(ahead).min(class.body().top_speed);
    let vehicle = NewVehicle { lanelet: lanelet.id, position_m, speed_mps, class, style, destination: None };
    let text = format!("a {} on lanelet {}", class.body().name, lanelet.id);
    Ok(Deed { command: Command::Insert(vehicle), back: None, text })
}

/// The lanelet under a point, and the station there [m].
fn nearest(network: &Network, point: &Point) -> Option<(LaneletIndex, f64)> {
    /// Lanes that are further away than this are not meant [m].
    const FARTHEST: f64 = 4.0;
    let flat = |it: &Point| Point { z: 0.0, ..*it };
    let mut best: Option<(f64, LaneletIndex, f64)> = None;
    for (lanelet, index) in network.lanelets.iter().zip(0..) {
        let mut station = 0.0;
        for pair in lanelet.centre.points().windows(2) {
            let (from, to) = (flat(&pair[0]), flat(&pair[1]));
            let length = from.distance(&to);
            let along = (point.x - from.x) * (to.x - from.x) + (point.y - from.y) * (to.y - from.y);
            let share = if length > 0.0 { (along / (length * length)).clamp(0.0, 1.0) } else { 0.0 };
            let distance = from.towards(&to, share).distance(point);
            if best.is_none_or(|it| distance < it.0) {
                best = Some((distance, LaneletIndex(index), station + share * pair[0].distance(&pair[1])));
            }
            station += pair[0].distance(&pair[1]);
        }
    }
    best.filter(|it| it.0 < FARTHEST).map(|(_, index, station)| (index, station))
}

/// A number in few digits.
fn short(value: f64) -> String {
    let digits = if value.abs() >= 100.0 { 0 } else { 3 };
    let text = format!("{value:.digits$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Writes `scenario` with these commands into a new folder inside `dir`, so that a run of it repeats all that was
/// done up to `until_s` [s].
pub(super) fn save(
    dir: &Path,
    (scenario, origin): (&Scenario, &Origin),
    commands: &[Commanded],
    until_s: f64,
) -> Result<Saved, Fault> {
    let folder = new_folder(dir)?;
    let path = folder.join("commands.csv");
    let unwritten = |error: &dyn std::fmt::Display| {
        Fault::new(path.display(), error.to_string(), "choose another folder with --save")
    };
    let mut table =
        TableWriter::create(&path, Format::Csv, &COMMAND_COLUMNS).map_err(|error| unwritten(&error))?;
    for command in commands {
        table.row(&Written::of(command, scenario.run.step_s).cells()).map_err(|error| unwritten(&error))?;
    }
    table.finish().map_err(|error| unwritten(&error))?;
    let mut saved = Scenario { commands: Some(path.clone()), external: Vec::new(), ..scenario.clone() };
    saved.run.duration_s = (until_s - saved.run.warmup_s).max(saved.run.step_s);
    saved.output.dir = folder.join("out");
    record::keep(&saved, origin, &folder, "laneweave view: what was done by hand")?;
    Ok(Saved { scenario: folder.join(record::SCENARIO), folder })
}

/// Makes a folder that was not there.
fn new_folder(dir: &Path) -> Result<PathBuf, Fault> {
    fs::create_dir_all(dir).map_err(|error| Fault::refused(dir, "made", &error))?;
    for number in 1_u32.. {
        let folder = dir.join(number.to_string());
        match fs::create_dir(&folder) {
            Ok(()) => return Ok(folder),
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(Fault::refused(&folder, "made", &error)),
        }
    }
    Err(Fault::new(dir.display(), "it has too many folders", "choose another folder with --save"))
}
