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

    /// The default drivers.
    ///
    /// # Errors
    /// None for the built-in styles.
    pub fn usual(seed: u64) -> Result<Population, Fault> {
        let built_in = |(name, weight): &(&str, f64)| {
            let source = find(name, Path::new(""), String::new)?;
            Ok((StyleTemplate::parse(&source)?, *weight))
        };
        let mixture: Vec<_> = DEFAULT_MIXTURE.iter().map(built_in).collect::<Result<_, Fault>>()?;
        Population::draw(&mixture, seed)
    }
}
