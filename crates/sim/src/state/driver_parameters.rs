//! The sets of driver parameters, and what users changed in them.

use std::collections::BTreeMap;

use laneweave_models::change::Flaw;
use laneweave_models::{Parameter, Style};

/// The numbers that users changed, by the names of their styles, with their values.
pub(crate) type ParameterChanges = BTreeMap<(String, Parameter), f64>;

/// All sets of driver parameters.
#[derive(Clone)]
pub(crate) struct DriverParameters {
    /// Without the changes.
    given: Vec<Style>,
    changes: ParameterChanges,
    /// With the changes.
    sets: Vec<Style>,
    /// The number of the style of each set: styles are numbered as they first occur.
    styles: Vec<u32>,
    /// Whether some drivers have errors in what they see.
    misperceive: bool,
}

impl DriverParameters {
    /// Sets that no user has changed.
    pub(crate) fn new(given: Vec<Style>) -> DriverParameters {
        let (styles, misperceive) = (style_numbers(&given), misperceive(&given));
        DriverParameters { sets: given.clone(), changes: ParameterChanges::new(), styles, misperceive, given }
    }

    /// Whether some drivers have errors in what they see.
    #[inline]
    pub(crate) fn misperceive(&self) -> bool {
        self.misperceive
    }

    /// The number of the style of each set: styles are numbered as they first occur.
    pub(crate) fn styles(&self) -> &[u32] {
        &self.styles
    }

    #[inline]
    pub(crate) fn sets(&self) -> &[Style] {
        &self.sets
    }

    /// What users changed.
    pub(crate) fn changes(&self) -> &ParameterChanges {
        &self.changes
    }

    /// The same sets with these `changes` in place of their own.
    ///
    /// # Errors
    /// Why they cannot have them, and what to do.
    pub(crate) fn with(&self, changes: ParameterChanges) -> Result<DriverParameters, String> {
        let given = self.given.clone();
        let mut sets = given.clone();
        for ((name, parameter), value) in &changes {
            let range = parameter.range();
            if !range.holds(*value, *value) {
                return Err(range.advice());
            }
            for set in sets.iter_mut().filter(|it| it.name == *name) {
                match parameter.place(set) {
                    Some(place) => *place = *value,
                    None => return Err(alternatives(set, *parameter)),
                }
            }
        }
        let is_changed = |set: &&Style| changes.keys().any(|(name, _)| set.name == *name);
        match sets.iter().filter(is_changed).find_map(|it| it.change.flaw()) {
            Some(Flaw { what, remedy, .. }) => Err(format!("{what}; {remedy}")),
            None => {
                let misperceive = misperceive(&sets);
                Ok(DriverParameters { given, changes, sets, styles: self.styles.clone(), misperceive })
            }
        }
    }

    /// Replaces each set by the one at the same index. What users changed remains.
    pub(crate) fn replace(&mut self, given: Vec<Style>) {
        let changes = std::mem::take(&mut self.changes);
        *self = DriverParameters::new(given);
        changes.into_iter().for_each(|((style, parameter), value)| self.set(&style, parameter, value));
    }

    /// Changes a number of all sets of a style.
    pub(crate) fn set(&mut self, style: &str, parameter: Parameter, value: f64) {
        for set in self.sets.iter_mut().filter(|it| it.name == style) {
            if let Some(place) = parameter.place(set) {
                *place = value;
            }
        }
        self.changes.insert((style.into(), parameter), value);
        self.misperceive = misperceive(&self.sets);
    }
}

fn misperceive(sets: &[Style]) -> bool {
    sets.iter().any(|it| it.manner.misperception > 0.0)
}

/// The number of the style of each set.
fn style_numbers(sets: &[Style]) -> Vec<u32> {
    let mut names: Vec<&str> = Vec::new();
    let mut numbers = Vec::with_capacity(sets.len());
    for set in sets {
        // The sets of a style mostly follow each other, so its name is among the last.
        let known = names.iter().rposition(|it| *it == set.name);
        let number = known.unwrap_or(names.len());
        if number == names.len() {
            names.push(&set.name);
        }
        numbers.push(number as u32);
    }
    numbers
}

/// What to do where `style` has no such number: those that it has in the same section.
fn alternatives(style: &mut Style, parameter: Parameter) -> String {
    let section = |it: Parameter| it.key().split('.').next();
    let same = Parameter::ALL.iter().filter(|it| section(**it) == section(parameter));
    let known: Vec<&str> = same.filter(|it| it.place(style).is_some()).map(|it| it.key()).collect();
    format!("its model has no such number; choose one of {}", known.join(", "))
}
