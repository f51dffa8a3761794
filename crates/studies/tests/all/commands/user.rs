//! A user who does all that users can do, at random.

use laneweave::{
    Class, Control, Fault, Id, IncentiveName, Lateral, LightState, Longitudinal, NewVehicle, Parameter, Side,
    Simulation, VehicleId,
};

/// A user, and how often it was obeyed.
pub(crate) struct User {
    numbers: u64,
    /// Commands that were carried out, by their kind.
    pub(crate) obeyed: [u32; 11],
}

impl User {
    pub(crate) fn new() -> User {
        User { numbers: 1, obeyed: [0; 11] }
    }

    fn below(&mut self, end: usize) -> usize {
        self.numbers =
            self.numbers.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.numbers >> 33) as usize % end
    }

    fn one<T: Clone>(&mut self, all: &[T]) -> Option<T> {
        if all.is_empty() { None } else { Some(all[self.below(all.len())].clone()) }
    }

    /// A number from 0 to below 1 with all its digits.
    fn share(&mut self) -> f64 {
        self.below(1 << 31) as f64 / (1_u64 << 31) as f64 / 3.0 * 3.0
    }

    /// Gives commands, most of which are obeyed.
    pub(crate) fn act(&mut self, simulation: &mut Simulation) -> Result<(), Fault> {
        let vehicles: Vec<VehicleId> = simulation.vehicles().iter().map(|it| it.id).collect();
        for _ in 0..self.below(5) {
            let kind = self.below(self.obeyed.len());
            if self.give(kind, simulation, &vehicles).is_ok() {
                self.obeyed[kind] += 1;
            }
        }
        Ok(())
    }

    fn give(
        &mut self,
        kind: usize,
        simulation: &mut Simulation,
        vehicles: &[VehicleId],
    ) -> Result<(), Fault> {
        let nobody = || Fault::new("here", "there is nobody", "wait");
        let origins: Vec<Id> = simulation.origins().into_iter().map(|(id, _)| id).collect();
        let destinations: Vec<Option<Id>> = simulation.destinations().into_iter().map(Some).collect();
        let destination = if self.below(4) > 0 { self.one(&destinations).flatten() } else { None };
        let style = self.one(&["aggressive", "conservative"]).unwrap_or_default();
        let id = self.one(vehicles);
        match kind {
            0 => {
                let lanelets = simulation.lanelets();
                let lanelet = self.one(&lanelets).ok_or_else(nobody)?;
                let class = if self.below(3) > 0 { Class::Car } else { Class::Bus };
                let (position_m, speed_mps) = (80.0 * self.share(), 14.0 * self.share());
                let vehicle =
                    NewVehicle { lanelet, position_m, speed_mps, class, style: style.into(), destination };
                simulation.insert(vehicle).map(|_| ())
            }
            // Traffic does not run dry.
            1 if self.below(4) > 0 => Err(nobody()),
            1 => simulation.remove(id.ok_or_else(nobody)?),
            2 => {
                let control = self.control();
                simulation.control(id.ok_or_else(nobody)?, control)
            }
            3 => simulation.set_style(id.ok_or_else(nobody)?, style),
            4 => simulation.set_destination(id.ok_or_else(nobody)?, destination),
            5 => {
                let (origin, rate) = (self.one(&origins).ok_or_else(nobody)?, 600.0 * self.share());
                simulation.set_demand(origin, rate)
            }
            6 => {
                // Most vehicles stay in lanes.
                let at = simulation.vehicle(id.ok_or_else(nobody)?).ok_or_else(nobody)?;
                let (way, heading) = (2.0 * self.share(), at.heading_rad + 0.4 * self.share() - 0.2);
                let (x, y) = (at.x_m + way * heading.cos(), at.y_m + way * heading.sin());
                simulation.control(at.id, Control::Pose { x, y, heading, speed: 20.0 * self.share() })
            }
            7 => {
                let value = 2.0 * self.share();
                simulation.set_parameter(style, Parameter::Weight(IncentiveName::Courtesy), value)
            }
            8 => {
                let lanelet = self.one(&simulation.lanelets()).ok_or_else(nobody)?;
                let is_closed = self.below(2) == 0;
                simulation.close_lanelet(lanelet, is_closed)
            }
            9 => {
                let light = self.one(&simulation.lights()).ok_or_else(nobody)?;
                simulation.set_offset(light.id, 60.0 * self.share())
            }
            _ => {
                let lights: Vec<Id> = simulation.lights().iter().map(|it| it.id).collect();
                let light = self.one(&lights).ok_or_else(nobody)?;
                let shows = self.one(&[
                    Some(LightState::Green),
                    Some(LightState::Yellow),
                    Some(LightState::Red),
                    None,
                ]);
                // Mostly the programs rule.
                simulation.set_light(light, shows.flatten().filter(|_| self.below(5) == 0))
            }
        }
    }

    fn control(&mut self) -> Control {
        let (speed, acceleration) = (15.0 * self.share(), 4.0 * self.share() - 2.0);
        let all =
            [Longitudinal::Driver, Longitudinal::Speed(speed), Longitudinal::Acceleration(acceleration)];
        let longitudinal = self.one(&all).unwrap_or(Longitudinal::Driver);
        let all = [Lateral::Driver, Lateral::Keep, Lateral::Change(Side::Left), Lateral::Change(Side::Right)];
        let lateral = self.one(&all).unwrap_or(Lateral::Driver);
        // Mostly vehicles are given back.
        if self.below(3) > 0 { Control::DRIVER } else { Control::Drive { longitudinal, lateral } }
    }
}
