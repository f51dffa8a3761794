//! From styles with weights to the drivers of a run.

use std::path::Path;

use laneweave_models::Style;
use laneweave_sim::{Random, Share};

use super::{DEFAULT_MIXTURE, StyleTemplate, find};
use crate::fault::Fault;

/// All different drivers of a run.
#[derive(Clone, Debug)]
pub struct Population {
    /// The drivers, style by style.
    pub driver_parameters: Vec<Style>,
    /// The weight of each style and its range in `driver_parameters`.
    pub shares: Vec<Share>,
}

impl Population {
    /// Draws the drivers of the styles in `mixture`, each with its weight.
    ///
    /// # Errors
    /// If a distribution gives a value that is invalid for a parameter.
    pub fn draw(mixture: &[(StyleTemplate, f64)], seed: u64) -> Result<Population, Fault> {
        let random = Random::new(seed);
        let mut population = Population { driver_parameters: Vec::new(), shares: Vec::new() };
        for ((template, weight), number) in mixture.iter().zip(0..) {
            let (first, count) = (population.driver_parameters.len() as u32, template.driver_parameters());
            for variant in 0..count {
                population.driver_parameters.push(template.draw(&random, number, variant)?);
            }
            population.shares.push(Share { weight: *weight, first, count });
        }
        Ok(population)
    }

    /// The same drivers after a change of the templates of their `mixture`: each keeps its index.
    ///
    /// # Errors
    /// If a distribution gives a value that is invalid for a parameter.
    pub fn redrawn(&self, mixture: &[(StyleTemplate, f64)], seed: u64) -> Result<Vec<Style>, Fault> {
        let random = Random::new(seed);
        let mut driver_parameters = Vec::new();
        for (((template, _), share), number) in mixture.iter().zip(&self.shares).zip(0..) {
            for variant in 0..share.count {
                driver_parameters.push(template.draw(&random, number, variant)?);
            }
        }
        Ok(driver_parameters)
    }

    /// The factors of the desired speeds of further drivers for recorded vehicles (ours).
    pub const OTHER_SPEEDS: [f64; 7] = [0.6, 0.72, 0.85, 1.18, 1.4, 1.65, 2.0];

    /// These drivers, and further ones for recorded vehicles: each again, but for the speed that it desires. Those who
    /// were recorded may drive faster or slower than any driver of a style does, such as where the map has a wrong
    /// limit.
    pub fn with_other_speeds(driver_parameters: Vec<Style>) -> Vec<Style> {
        let other = |it: &Style, factor| Style { speed_factor: factor * it.speed_factor, ..it.clone() };
        let factors = Population::OTHER_SPEEDS.iter();
        let others: Vec<Style> =
            factors.flat_map(|factor| driver_parameters.iter().map(|it| other(it, *factor))).collect();
        [driver_parameters, others].concat()
    }

    /// Drivers who stand for those of the `mixture`, each with its weight: typical ones of each style, with all of its
    /// desired speeds. Behind a slow driver nobody is faster, so that the capacity of a lane depends on the slow ones.
    pub fn by_speed(mixture: &[(StyleTemplate, f64)]) -> Vec<(Style, f64)> {
        const SPEEDS: u32 = 64;
        let drivers = mixture.iter().flat_map(|(template, weight)| {
            let drivers = template.by_speed(SPEEDS);
            let each = weight / drivers.len() as f64;
            drivers.into_iter().map(move |it| (it, each))
        });
        drivers.collect()
    }

    /// The styles of the default drivers, each with its weight.
    ///
    /// # Errors
    /// None for the built-in styles.
    pub fn usual_mixture() -> Result<Vec<(StyleTemplate, f64)>, Fault> {
        let built_in = |(name, weight): &(&str, f64)| {
            let source = find(name, Path::new(""), String::new)?;
            Ok((StyleTemplate::parse(&source)?, *weight))
        };
        DEFAULT_MIXTURE.iter().map(built_in).collect()
    }

    /// The default drivers.
    ///
    /// # Errors
    /// None for the built-in styles.
    pub fn usual(seed: u64) -> Result<Population, Fault> {
        Population::draw(&Population::usual_mixture()?, seed)
    }
}
