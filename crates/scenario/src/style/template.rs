//! A style file: a style in which numbers may be distributed over its drivers.
//!
//! The file is compared with the complete style of the models that it names, so that an unknown key, a wrong type or
//! a number out of range is reported with its place.

mod draws;

use laneweave_models::change::{Flaw, LaneChangeModel};
use laneweave_models::{self as models, Range, Style};
use laneweave_sim::{Purpose, Random};
use toml::{Table, Value};

use super::distribution::Distribution;
use crate::fault::{Fault, did_you_mean};
use crate::source::Source;
use draws::Draws;

/// The table of a fitted style that says where its numbers come from, and what else they may be.
const PROVENANCE: &str = "fit";
/// Number of different drivers of a style with distributions.
const CHARACTERS: u32 = 512;

/// A style before its drivers are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleTemplate {
    table: Table,
    parameters: Vec<Parameter>,
    typical: Style,
    draws: Draws,
}

/// A distributed number of a style.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its keys from the outermost in.
    pub path: Vec<String>,
    /// Its distribution.
    pub distribution: Distribution,
    /// Which random number of a driver is its own: it depends on the key alone, so that no other key moves it.
    number: u32,
}

impl Parameter {
    fn new(path: Vec<String>, distribution: Distribution) -> Parameter {
        let number = fnv_1a(path.join(".").as_bytes());
        Parameter { path, distribution, number }
    }

    /// Its key in a style file.
    fn key(&self) -> String {
        self.path.join(".")
    }
}

impl StyleTemplate {
    /// Reads a style file.
    ///
    /// # Errors
    /// If it is no TOML, has an unknown key, lacks a key, or has an invalid value.
    pub fn parse(source: &Source) -> Result<StyleTemplate, Fault> {
        let mut table: Table = source.parse()?;
        let draws = match table.remove(PROVENANCE) {
            Some(Value::Table(provenance)) => Draws::of(&provenance, source)?,
            _ => Draws::default(),
        };
        let mut reader = Reader { source, path: Vec::new(), parameters: Vec::new() };
        reader.table(&table, &complete(&table, source)?)?;
        let parameters = reader.parameters;
        let typical =
            fill(&table, &parameters, |it| it.distribution.median()).map_err(|error| source.fault(&error))?;
        if typical.name.trim().is_empty() {
            return Err(Fault::new(source.place(&["name"]), "the name is empty", "give the style a name"));
        }
        if let Some(Flaw { path, what, remedy }) = typical.change.flaw() {
            return Err(Fault::new(source.place(path), what, remedy));
        }
        Ok(StyleTemplate { table, parameters, typical, draws })
    }

    /// Number of different drivers of the style: one, or 512 if a number is distributed.
    pub fn driver_parameters(&self) -> u32 {
        if self.parameters.is_empty() { 1 } else { CHARACTERS }
    }

    /// The style as a table, as its file has it.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Its distributed numbers in the order of their paths.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The style with the medians of its distributed numbers.
    pub fn typical(&self) -> &Style {
        &self.typical
    }

    /// `count` typical drivers whose desired speeds are spread evenly over their distribution; one if it has none.
    pub fn by_speed(&self, count: u32) -> Vec<Style> {
        let Some(speed) = self.parameters.iter().find(|it| it.path == ["speed_factor"]) else {
            return vec![self.typical.clone()];
        };
        let factors = (0..count).map(|it| speed.distribution.value((f64::from(it) + 0.5) / f64::from(count)));
        factors.map(|speed_factor| Style { speed_factor, ..self.typical.clone() }).collect()
    }

    /// The same style with another lane-change model.
    ///
    /// # Errors
    /// None, as long as every model can be serialized.
    pub fn with_change(self, change: &LaneChangeModel) -> Result<StyleTemplate, Fault> {
        let StyleTemplate { mut table, mut parameters, typical, mut draws } = self;
        let model = Table::try_from(change).map_err(|error| Fault::bug(&typical.name, error))?;
        table.insert("change".into(), Value::Table(model));
        let is_other = |path: &[String]| path.first().is_none_or(|it| it != "change");
        parameters.retain(|it| is_other(&it.path));
        if !draws.of.iter().all(|it| is_other(it)) {
            draws = Draws::default();
        }
        Ok(StyleTemplate { table, parameters, typical: Style { change: change.clone(), ..typical }, draws })
    }

    /// Whether there is a key at `path`, the keys from the outermost in.
    pub fn has(&self, path: &[String]) -> bool {
        let is_distributed = self.parameters.iter().any(|it| path.starts_with(&it.path));
        let found =
            |table: Table| path.iter().try_fold(&Value::Table(table), |inner, key| inner.get(key)).is_some();
        is_distributed || Table::try_from(&self.typical).is_ok_and(found)
    }

    /// Number of the draws of its parameters: none, if it was not fitted.
    pub fn draws(&self) -> usize {
        self.draws.values.len()
    }

    /// The same style with the parameters of the draw with this number, counted from 0.
    ///
    /// # Errors
    /// If there is no such draw, or it has an invalid value.
    pub fn drawn(&self, number: u32) -> Result<StyleTemplate, Fault> {
        let name = &self.typical.name;
        let Some(values) = self.draws.values.get(number as usize) else {
            let count = self.draws();
            let what = format!(
                "the style {name} has {count} draws of its parameters, from number 0 on, but none has number {number}"
            );
            return Err(Fault::new(
                name,
                what,
                format!("use at most its {count} draws, or fit more: laneweave fit --draws N"),
            ));
        };
        let pairs: Vec<(&[String], Value)> =
            self.draws.of.iter().zip(values).map(|(path, value)| (&path[..], Value::Float(*value))).collect();
        self.with_values(&pairs, &format!("draw {number} of the style {name}"))
    }

    /// The same style with `value` at `path`, the keys from the outermost in. The random numbers of the others stay
    /// the same.
    ///
    /// # Errors
    /// If there is no such key, or the value is invalid; its place is `place`.
    pub fn with_value(&self, path: &[String], value: Value, place: &str) -> Result<StyleTemplate, Fault> {
        self.with_values(&[(path, value)], place)
    }

    /// The same with several values at once.
    fn with_values(&self, values: &[(&[String], Value)], place: &str) -> Result<StyleTemplate, Fault> {
        let mut table = self.table.clone();
        values.iter().try_for_each(|(path, value)| insert(&mut table, path, value.clone(), place))?;
        let text = toml::to_string(&table).map_err(|error| Fault::bug(place, error))?;
        let source = Source { path: self.typical.name.clone().into(), text };
        let changed =
            StyleTemplate::parse(&source).map_err(|fault| Fault { place: place.into(), ..fault })?;
        Ok(StyleTemplate { draws: self.draws.clone(), ..changed })
    }

    /// The typical driver, but with `value` for its distributed numbers; `None` if one of them is in no list.
    fn typical_with(&self, value: impl Fn(&Parameter) -> f64) -> Option<Style> {
        let mut style = self.typical.clone();
        for it in &self.parameters {
            *models::Parameter::of_key(&it.key())?.place(&mut style)? = value(it);
        }
        Some(style)
    }

    /// Driver `number` of the style, which is number `style` of the run.
    ///
    /// # Errors
    /// Only if a random value is invalid at its key; reading the file excludes this.
    pub fn draw(&self, random: &Random, style: u32, number: u32) -> Result<Style, Fault> {
        let value = |it: &Parameter| {
            let driver = style * CHARACTERS + number;
            it.distribution.value(random.uniform(driver, Purpose::Parameter, it.number))
        };
        if let Some(drawn) = self.typical_with(value) {
            return Ok(drawn);
        }
        let drawn = fill(&self.table, &self.parameters, value);
        drawn.map_err(|error| {
            Fault::new(&self.typical.name, error.message(), "check the distributions of the style")
        })
    }
}

/// The hash of Fowler, Noll and Vo, FNV-1a with 32 bits: the same on every machine and in every release.
fn fnv_1a(bytes: &[u8]) -> u32 {
    const OFFSET: u32 = 0x811C_9DC5;
    const PRIME: u32 = 0x0100_0193;
    bytes.iter().fold(OFFSET, |hash, byte| (hash ^ u32::from(*byte)).wrapping_mul(PRIME))
}

/// Puts `value` at `path`.
fn insert(table: &mut Table, path: &[String], value: Value, place: &str) -> Result<(), Fault> {
    let Some((last, outer)) = path.split_last() else { return Ok(()) };
    let mut inner = table;
    for key in outer {
        let next = inner.entry(key.clone()).or_insert_with(|| Value::Table(Table::new()));
        inner = next.as_table_mut().ok_or_else(|| {
            let what = format!("{key} is not a section of a style");
            Fault::new(place, what, "see `laneweave styles show NAME`")
        })?;
    }
    inner.insert(last.clone(), value);
    Ok(())
}

/// The style of `table` with `value` in the place of each distribution.
fn fill(
    table: &Table,
    parameters: &[Parameter],
    mut value: impl FnMut(&Parameter) -> f64,
) -> Result<Style, toml::de::Error> {
    let mut table = table.clone();
    for parameter in parameters {
        let (last, outer) = match parameter.path.split_last() {
            Some(parts) => parts,
            None => continue,
        };
        let inner = outer
            .iter()
            .try_fold(&mut table, |table, name| table.get_mut(name).and_then(Value::as_table_mut));
        if let Some(inner) = inner {
            inner.insert(last.clone(), Value::Float(value(parameter)));
        }
    }
    table.try_into()
}

/// Every key that a style with the models of `table` can have, with its default.
fn complete(table: &Table, source: &Source) -> Result<Table, Fault> {
    let mut bare = Table::from_iter([("name".into(), Value::String(String::new()))]);
    for (section, example) in [("follow", "idm"), ("change", "mcdm")] {
        let model = table.get(section).and_then(|it| it.get("model")).cloned().ok_or_else(|| {
            let remedy = format!("add it, such as [{section}] with model = {example:?}");
            Fault::new(source.place(&[section]), format!("the key {section}.model is missing"), remedy)
        })?;
        bare.insert(section.into(), Value::Table(Table::from_iter([("model".into(), model)])));
    }
    let complete = bare.try_into::<Style>().and_then(|style| {
        Table::try_from(&style).map_err(|error| serde::de::Error::custom(error.to_string()))
    });
    complete.map_err(|error| source.fault(&error))
}

/// Compares a style file with the complete style, key by key.
struct Reader<'a> {
    source: &'a Source,
    path: Vec<String>,
    parameters: Vec<Parameter>,
}

impl Reader<'_> {
    fn table(&mut self, found: &Table, complete: &Table) -> Result<(), Fault> {
        for (key, value) in found {
            self.path.push(key.clone());
            match complete.get(key) {
                Some(default) => self.value(value, default)?,
                None => {
                    let known = complete.keys().map(String::as_str);
                    return Err(self.fault(format!("unknown key {key:?}"), did_you_mean(key, known)));
                }
            }
            self.path.pop();
        }
        Ok(())
    }

    fn value(&mut self, found: &Value, default: &Value) -> Result<(), Fault> {
        match (default, found) {
            (Value::Table(default), Value::Table(found)) => self.table(found, default),
            (Value::String(_), Value::String(_)) => Ok(()),
            (Value::Float(_), Value::Float(number)) => self.number(*number),
            (Value::Float(_), Value::Integer(number)) => self.number(*number as f64),
            (Value::Float(_), Value::Table(found)) => self.distribution(found),
            (Value::Float(_), _) => {
                let remedy = "give a number, or a distribution such as \
                              { distribution = \"normal\", mean = 1.0, sd = 0.1, min = 0.7, max = 1.3 }";
                Err(self.fault(format!("{} is not a number", self.key()), remedy))
            }
            (default, found) => {
                let what = format!("{} is {}", self.key(), with_article(found.type_str()));
                Err(self.fault(what, format!("give {}", with_article(default.type_str()))))
            }
        }
    }

    fn number(&self, number: f64) -> Result<(), Fault> {
        let range = self.range();
        if range.holds(number, number) {
            return Ok(());
        }
        Err(self.fault(format!("{} is {number}", self.key()), range.advice()))
    }

    fn distribution(&mut self, found: &Table) -> Result<(), Fault> {
        let distribution: Distribution = Value::Table(found.clone()).try_into().map_err(|error| {
            let Fault { what, remedy, .. } = self.source.fault(&error);
            self.fault(format!("{}: {what}", self.key()), remedy)
        })?;
        if let Some((what, remedy)) = distribution.flaw() {
            return Err(self.fault(format!("{}: {what}", self.key()), remedy));
        }
        let range = self.range();
        let (least, largest) = distribution.support();
        if !range.holds(least, largest) {
            let what = format!("{} ranges from {least} to {largest}", self.key());
            return Err(self.fault(what, format!("set its min and max: {}", range.advice())));
        }
        self.parameters.push(Parameter::new(self.path.clone(), distribution));
        Ok(())
    }

    fn key(&self) -> String {
        self.path.join(".")
    }

    /// The values that the number at this key may have.
    fn range(&self) -> Range {
        models::Parameter::of_key(&self.key()).map_or(Range::ANY, models::Parameter::range)
    }

    fn fault(&self, what: String, remedy: impl std::fmt::Display) -> Fault {
        let path: Vec<&str> = self.path.iter().map(String::as_str).collect();
        Fault::new(self.source.place(&path), what, remedy)
    }
}

/// A noun with its article.
fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

#[cfg(test)]
mod tests;
