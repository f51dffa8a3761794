//! What a user does by hand, as commands of the library.

use std::time::Instant;

use laneweave::network::{LaneletIndex, Network, Point};
use laneweave::sim::{Command, Target};
use laneweave::{
    Class, Control, Fault, Id, Lateral, LightState, Longitudinal, NewVehicle, Parameter, Side, Simulation,
};
use serde::{Deserialize, Serialize};

/// Something that a user does by hand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Gives the signal plan of a light another offset.
    SetOffset {
        /// A light of the plan, by its id.
        light: String,
        /// When its first phase begins [s].
        offset_s: f64,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
    /// Whether it was taken back.
    pub is_undone: bool,
    /// The first part of the text: what was done to what.
    #[serde(skip)]
    pub(super) to_what: String,
    #[serde(skip)]
    pub(super) command: Command,
    /// The command that takes it back.
    #[serde(skip)]
    pub(super) back: Option<Command>,
    /// When the user did it last, while a slider moves.
    #[serde(skip)]
    pub(super) at: Instant,
}

/// What was done by hand, and what is set by it.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Hands {
    /// All that was done, in order.
    pub done: Vec<Done>,
    /// All that is not as in the scenario, or was not for a while, as it is now.
    pub set: Vec<Hand>,
}

impl Hand {
    /// What is set of `target` now, if it is something that stays until it is set again.
    pub(super) fn setting(target: &Target, simulation: &Simulation) -> Option<Hand> {
        Some(match target {
            Target::Parameter(style, parameter) => Hand::SetParameter {
                style: style.clone(),
                parameter: *parameter,
                value: simulation.parameter(style, *parameter)?,
            },
            Target::Style(style) => Hand::SetShare { style: style.clone(), weight: simulation.share(style)? },
            Target::Origin(origin) => Hand::SetDemand {
                origin: origin.to_string(),
                vehicles_per_hour: simulation.demand_at(*origin)?,
            },
            Target::Light(light) => {
                Hand::SetLight { light: light.to_string(), shows: simulation.light_override(*light)? }
            }
            Target::Plan(light) => {
                Hand::SetOffset { light: light.to_string(), offset_s: simulation.offset(*light)? }
            }
            Target::Lanelet(lanelet) => Hand::CloseLanelet {
                lanelet: lanelet.to_string(),
                is_closed: simulation.is_closed(*lanelet)?,
            },
            Target::Vehicle(_) => return None,
        })
    }
}

/// The commands of something done by hand: what is done, what takes it back, and what it is called.
pub(super) struct Deed {
    pub(super) command: Command,
    pub(super) back: Option<Command>,
    /// What is done to what, and how it is from now on.
    pub(super) text: [String; 2],
}

fn fault(what: impl ToString, remedy: &str) -> Fault {
    Fault::new("by hand", what.to_string(), remedy)
}

impl Deed {
    /// What `hand` means for the traffic as it is `now`.
    pub(super) fn of(hand: &Hand, now: &Simulation) -> Result<Deed, Fault> {
        Ok(match hand {
            Hand::SetParameter { style, parameter, value: new } => {
                let set =
                    |value| Command::SetParameter { style: style.clone(), parameter: *parameter, value };
                let old = now.parameter(style, *parameter);
                let from = old.map_or_else(String::new, |it| format!(" from {}", short(it)));
                let text = [format!("{} of {style}{from} to ", parameter.key()), short(*new)];
                Deed { command: set(*new), back: old.map(set), text }
            }
            Hand::SetDemand { origin, vehicles_per_hour } => {
                let origin = Id::from(origin.as_str());
                let set = |vehicles_per_hour| Command::SetDemand { origin, vehicles_per_hour };
                let old = now.demand_at(origin);
                let demand = format!("{} veh/h", short(*vehicles_per_hour));
                let text = [format!("demand at entrance {origin} to "), demand];
                Deed { command: set(*vehicles_per_hour), back: old.map(set), text }
            }
            Hand::SetShare { style, weight } => {
                let set = |weight| Command::SetShare { style: style.clone(), weight };
                let old = now.share(style);
                let from = old.map_or_else(String::new, |it| format!(" from {}", short(it)));
                let text = [format!("share of {style}{from} to "), short(*weight)];
                Deed { command: set(*weight), back: old.map(set), text }
            }
            Hand::SetLight { light, shows } => {
                let light = Id::from(light.as_str());
                let set = |shows| Command::SetLight { light, shows };
                let state = match shows {
                    Some(state) => state.name(),
                    None => "as its program says",
                };
                let text = [format!("light {light}: "), state.to_owned()];
                Deed { command: set(*shows), back: Some(set(now.light_override(light).flatten())), text }
            }
            Hand::SetOffset { light, offset_s } => {
                let light = Id::from(light.as_str());
                let set = |offset_s| Command::SetOffset { light, offset_s };
                let text = [format!("offset of light {light} to "), format!("{} s", short(*offset_s))];
                Deed { command: set(*offset_s), back: now.offset(light).map(set), text }
            }
            Hand::CloseLanelet { lanelet, is_closed } => {
                let lanelet = Id::from(lanelet.as_str());
                let set = |is_closed| Command::CloseLanelet { lanelet, is_closed };
                let what = if *is_closed { "closed" } else { "open again" };
                Deed {
                    command: set(*is_closed),
                    back: Some(set(!is_closed)),
                    text: [format!("lanelet {lanelet}: "), what.to_owned()],
                }
            }
            Hand::Put { x, y, class } => put(now, [*x, *y], *class)?,
            Hand::Drive { .. } | Hand::SetStyle { .. } | Hand::Remove { .. } => Deed::of_vehicle(hand, now)?,
        })
    }

    /// The same for something done to one vehicle.
    fn of_vehicle(hand: &Hand, now: &Simulation) -> Result<Deed, Fault> {
        let named = match hand {
            Hand::Drive { vehicle, .. } | Hand::SetStyle { vehicle, .. } | Hand::Remove { vehicle } => {
                vehicle
            }
            _ => return Err(Fault::bug("by hand", "this concerns no vehicle")),
        };
        let gone = || fault(format!("vehicle {named} is not on the road"), "choose one that is");
        let vehicle = named.parse().map_err(|_| gone())?;
        let style_now = now.style_of(vehicle).ok_or_else(gone)?.to_owned();
        let text = |how: String| [format!("vehicle {vehicle}: "), how];
        Ok(match hand {
            Hand::Drive { speed_kmh, side, .. } => {
                let side = side.map(|it| match it {
                    DriveSide::Left => Side::Left,
                    DriveSide::Right => Side::Right,
                });
                let lateral = match (side, now.control_of(vehicle)) {
                    (Some(side), _) => Lateral::Change(side),
                    // A change that was asked for goes on at another speed.
                    (None, Control::Drive { lateral: asked @ Lateral::Change(_), .. }) => asked,
                    _ => Lateral::Keep,
                };
                let drive = |it: f64| Control::Drive { longitudinal: Longitudinal::Speed(it / 3.6), lateral };
                let control = speed_kmh.map_or(Control::DRIVER, drive);
                let how = match (speed_kmh, side) {
                    (None, _) => "back to its driver".to_owned(),
                    (Some(speed), Some(side)) => {
                        format!("{} km/h, to the {}", short(*speed), side.name())
                    }
                    (Some(speed), None) => format!("{} km/h", short(*speed)),
                };
                let back = Command::Control(vehicle, now.control_of(vehicle));
                Deed { command: Command::Control(vehicle, control), back: Some(back), text: text(how) }
            }
            Hand::SetStyle { style, .. } => Deed {
                command: Command::SetStyle(vehicle, style.clone()),
                back: Some(Command::SetStyle(vehicle, style_now)),
                text: text(format!("style {style}")),
            },
            _ => Deed {
                command: Command::Remove(vehicle),
                back: None,
                text: text("taken off the road".to_owned()),
            },
        })
    }
}

/// A new vehicle on the lane nearest to a point. It drives as fast as the limit allows, but no faster than the
/// vehicle ahead.
fn put(simulation: &Simulation, [x, y]: [f64; 2], class: Class) -> Result<Deed, Fault> {
    let network = simulation.network();
    let (index, position_m) = nearest(network, &Point { x, y, z: 0.0 })
        .ok_or_else(|| fault("there is no lane", "put the vehicle on a lane"))?;
    let lanelet = &network.lanelets[index.at()];
    let at = network.start_of(index);
    let ahead = simulation
        .scene()
        .motions(at.chain)
        .iter()
        .find(|it| it.x > at.x + position_m)
        .map_or(f64::INFINITY, |it| it.speed);
    let style = simulation.driver_parameters().first().map_or_else(String::new, |it| it.name.clone());
    let speed_mps = class.allowed(lanelet.speed_limit, &network.law).min(ahead);
    let vehicle = NewVehicle { lanelet: lanelet.id, position_m, speed_mps, class, style, destination: None };
    let text = [format!("a {} ", class.body().name), format!("on lanelet {}", lanelet.id)];
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
