//! A style file: a style in which numbers may be distributed over its drivers.
//!
//! The file is held against the complete style of the models that it names, so that an unknown key, a wrong type or
//! a number out of range is told with its place.

use laneweave_models::Style;
use laneweave_models::change::{LaneChangeModel, Rule};
use laneweave_sim::{Purpose, Random};
use toml::{Table, Value};

use super::distribution::Distribution;
use super::ranges::Range;
use crate::fault::{Fault, did_you_mean};
use crate::source::Source;

/// How many different drivers stand for a style with distributions.
const CHARACTERS: u32 = 512;
/// Draws that are kept apart for the parameters of one style.
const PARAMETERS_PER_STYLE: u32 = 1 << 12;

/// A style before its drivers are drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleTemplate {
    table: Table,
    parameters: Vec<Parameter>,
    typical: Style,
}

/// A distributed number of a style.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its keys from the outermost in.
    pub path: Vec<String>,
    /// How it is distributed.
    pub distribution: Distribution,
    /// Which draw of the style is its own.
    number: u32,
}

impl StyleTemplate {
    /// Reads a style file.
    ///
    /// # Errors
    /// If it is no TOML, has an unknown key, lacks one, or has a value that makes no sense.
    pub fn parse(source: &Source) -> Result<StyleTemplate, Fault> {
        let table: Table = source.parse()?;
        let mut reader = Reader { source, path: Vec::new(), parameters: Vec::new() };
        reader.table(&table, &complete(&table, source)?)?;
        let parameters = reader.parameters;
        let typical =
            fill(&table, &parameters, |it| it.distribution.median()).map_err(|error| source.fault(&error))?;
        if typical.name.trim().is_empty() {
            return Err(Fault::new(source.place(&["name"]), "the name is empty", "give the style a name"));
        }
        if let LaneChangeModel::Mcdm(it) = &typical.change
            && it.rule == Rule::Logit
            && it.sigma == 0.0
        {
            let remedy = "give sigma a value above 0, or set rule = \"threshold\"";
            return Err(Fault::new(source.place(&["change", "sigma"]), "a logit rule without noise", remedy));
        }
        if let LaneChangeModel::Lmrs(it) = &typical.change
            && !(it.free <= it.synchronize && it.synchronize < it.cooperate)
        {
            let remedy = "choose free ≤ synchronize < cooperate";
            return Err(Fault::new(source.place(&["change"]), "thresholds of desire out of order", remedy));
        }
        Ok(StyleTemplate { table, parameters, typical })
    }

    /// Number of different drivers that stand for the style: one, or 512 where anything is distributed.
    pub fn characters(&self) -> u32 {
        if self.parameters.is_empty() { 1 } else { CHARACTERS }
    }

    /// Its distributed numbers in the order of their paths.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The style whose distributed numbers have their medians.
    pub fn typical(&self) -> &Style {
        &self.typical
    }

    /// The same style with another lane-change model.
    ///
    /// # Errors
    /// None, as long as every model can be written down.
    pub fn with_change(self, change: &LaneChangeModel) -> Result<StyleTemplate, Fault> {
        let StyleTemplate { mut table, mut parameters, typical } = self;
        let model = Table::try_from(change)
            .map_err(|error| Fault::new(&typical.name, error, "report this as a bug"))?;
        table.insert("change".into(), Value::Table(model));
        parameters.retain(|it| it.path.first().is_none_or(|it| it != "change"));
        Ok(StyleTemplate { table, parameters, typical: Style { change: change.clone(), ..typical } })
    }

    /// Whether there is a key at `path`, the keys from the outermost in.
    pub fn has(&self, path: &[String]) -> bool {
        let is_distributed = self.parameters.iter().any(|it| path.starts_with(&it.path));
        let found =
            |table: Table| path.iter().try_fold(&Value::Table(table), |inner, key| inner.get(key)).is_some();
        is_distributed || Table::try_from(&self.typical).is_ok_and(found)
    }

    /// The same style with `value` at `path`, the keys from the outermost in. What is drawn of it stays as it was.
    ///
    /// # Errors
    /// If there is no such key, or the value does not fit; the place is `place`.
    pub fn with_value(&self, path: &[String], value: Value, place: &str) -> Result<StyleTemplate, Fault> {
        let mut table = self.table.clone();
        let Some((last, outer)) = path.split_last() else { return Ok(self.clone()) };
        let mut inner = &mut table;
        for key in outer {
            let next = inner.entry(key.clone()).or_insert_with(|| Value::Table(Table::new()));
            inner = next.as_table_mut().ok_or_else(|| {
                Fault::new(
                    place,
                    format!("{key} is no section of a style"),
                    "see `laneweave styles show NAME`",
                )
            })?;
        }
        inner.insert(last.clone(), value);
        let text =
            toml::to_string(&table).map_err(|error| Fault::new(place, error, "report this as a bug"))?;
        let source = Source { path: self.typical.name.clone().into(), text };
        let changed =
            StyleTemplate::parse(&source).map_err(|fault| Fault { place: place.into(), ..fault })?;
        let number =
            |it: &Parameter| self.parameters.iter().find(|own| own.path == it.path).map(|own| own.number);
        let mut next = self.parameters.iter().map(|it| it.number + 1).max().unwrap_or(0);
        let renumbered = changed.parameters.iter().map(|it| {
            let number = number(it).unwrap_or_else(|| {
                next += 1;
                next - 1
            });
            Parameter { number, ..it.clone() }
        });
        let parameters = renumbered.collect();
        Ok(StyleTemplate { parameters, ..changed })
    }

    /// Driver `number` of the style, which is number `style` of the run.
    ///
    /// # Errors
    /// Only if a number that is drawn does not fit where it stands, which reading the file rules out.
    pub fn draw(&self, random: &Random, style: u32, number: u32) -> Result<Style, Fault> {
        let drawn = fill(&self.table, &self.parameters, |it| {
            let draw = style * PARAMETERS_PER_STYLE + it.number;
            it.distribution.value(random.uniform(number, Purpose::Parameter, draw))
        });
        drawn.map_err(|error| {
            Fault::new(&self.typical.name, error.message(), "check the distributions of the style")
        })
    }
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

/// Walks through a style file beside the complete style.
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
                Err(self.fault(format!("{} is no number", self.key()), remedy))
            }
            (default, found) => {
                let what = format!("{} is a {}", self.key(), found.type_str());
                Err(self.fault(what, format!("give a {}", default.type_str())))
            }
        }
    }

    fn number(&self, number: f64) -> Result<(), Fault> {
        let range = Range::of(&self.key());
        if number.is_finite() && range.holds(number, number) {
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
        let range = Range::of(&self.key());
        let (least, largest) = distribution.support();
        if !range.holds(least, largest) {
            let what = format!("{} reaches from {least} to {largest}", self.key());
            return Err(self.fault(what, format!("set its min and max: {}", range.advice())));
        }
        let number = self.parameters.len() as u32;
        self.parameters.push(Parameter { path: self.path.clone(), distribution, number });
        Ok(())
    }

    fn key(&self) -> String {
        self.path.join(".")
    }

    fn fault(&self, what: String, remedy: impl std::fmt::Display) -> Fault {
        let path: Vec<&str> = self.path.iter().map(String::as_str).collect();
        Fault::new(self.source.place(&path), what, remedy)
    }
}

#[cfg(test)]
mod tests {
    use laneweave_models::change::{Courtesy, Mcdm};
    use laneweave_models::follow::FollowingModel;
    use laneweave_models::{Alertness, Attention, Manner, Reading};

    use super::*;
    use crate::style::built_in;

    fn template(name: &str) -> StyleTemplate {
        let text = built_in(name).unwrap().text.into();
        StyleTemplate::parse(&Source { path: name.into(), text }).unwrap()
    }

    #[test]
    fn a_style_with_a_distribution_is_512_drivers_with_its_mean_and_deviation() {
        let template = template("aggressive");
        assert_eq!(template.characters(), 512);
        let draw = |number| template.draw(&Random::new(1), 0, number).unwrap().speed_factor;
        let factors: Vec<f64> = (0..512).map(draw).collect();
        let mean = factors.iter().sum::<f64>() / 512.0;
        let sd = (factors.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / 511.0).sqrt();
        // Three standard errors of 512 draws with mean 1.12 and deviation 0.08.
        assert!((mean - 1.12).abs() < 0.0106, "mean {mean}");
        assert!((sd - 0.08).abs() < 0.0075, "deviation {sd}");
        assert!(factors.iter().all(|it| (0.85..=1.4).contains(it)));
    }

    #[test]
    fn a_style_without_distributions_is_one_driver() {
        let template = template("paper-conservative");
        assert_eq!(template.characters(), 1);
        assert_eq!(template.draw(&Random::new(1), 0, 0).unwrap(), *template.typical());
    }

    #[test]
    fn draws_depend_on_seed_style_and_number_only() {
        let template = template("conservative");
        let factor =
            |seed, style, number| template.draw(&Random::new(seed), style, number).unwrap().speed_factor;
        assert_eq!(factor(1, 0, 7), factor(1, 0, 7));
        let all = [factor(1, 0, 7), factor(1, 0, 8), factor(1, 1, 7), factor(2, 0, 7)];
        assert!((1..4).all(|i| all[..i].iter().all(|it| *it != all[i])), "{all:?}");
    }

    #[test]
    fn several_parameters_are_drawn_independently_of_each_other() {
        let text = built_in("conservative").unwrap().text.replace(
            "time_gap = 1.2",
            "time_gap = { distribution = \"lognormal\", mean = 1.2, sd = 0.3, min = 0.5, max = 3 }",
        );
        let template = StyleTemplate::parse(&Source { path: "own".into(), text }).unwrap();
        let paths: Vec<String> = template.parameters().iter().map(|it| it.path.join(".")).collect();
        assert_eq!(paths, ["follow.time_gap", "speed_factor"]);
        let pairs: Vec<(f64, f64)> = (0..512)
            .map(|number| template.draw(&Random::new(1), 0, number).unwrap())
            .map(|style| match style.follow {
                FollowingModel::Idm(idm) => (idm.time_gap, style.speed_factor),
                other => panic!("{other:?}"),
            })
            .collect();
        let sum = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
        let (gap, factor) = (sum(&|it| it.0) / 512.0, sum(&|it| it.1) / 512.0);
        let together = sum(&|it| (it.0 - gap) * (it.1 - factor));
        let apart = sum(&|it| (it.0 - gap).powi(2)) * sum(&|it| (it.1 - factor).powi(2));
        // Three standard errors of a correlation that is not there.
        assert!((together / apart.sqrt()).abs() < 0.133);
    }

    #[test]
    fn the_built_in_styles_have_the_papers_weights_in_both_readings() {
        for (name, weights, beta, reading) in [
            ("aggressive", [1.26, 0.58, 0.03, 0.61, 0.9], 1.1, Reading::Repaired),
            ("conservative", [0.44, 0.41, 0.09, 1.72, 0.9], 2.3, Reading::Repaired),
            ("paper-aggressive", [1.26, 0.58, 0.03, 0.61, 0.0], 1.1, Reading::Literal),
            ("paper-conservative", [0.44, 0.41, 0.09, 1.72, 0.0], 2.3, Reading::Literal),
        ] {
            let LaneChangeModel::Mcdm(it) = template(name).typical().change.clone() else { panic!("{name}") };
            let found =
                [it.speed.weight, it.route.weight, it.comfort.weight, it.courtesy.weight, it.urgency.weight];
            assert_eq!((found, it.comfort.beta), (weights, beta), "{name}");
            let others = [it.route.reading, it.comfort.reading, it.courtesy.reading, it.returning.reading];
            assert_eq!((it.speed.reading, others), (reading, [reading; 4]), "{name}");
            let decision = match reading {
                Reading::Literal => (Rule::Threshold, 0.0, 0.0),
                Reading::Repaired => (Rule::Logit, 0.112, 0.014),
            };
            assert_eq!((it.rule, it.theta, it.sigma), decision, "{name}");
        }
    }

    #[test]
    fn the_other_characters_are_the_conservative_driver_but_for_what_their_names_say() {
        let usual = template("conservative").typical().clone();
        let LaneChangeModel::Mcdm(table) = usual.change.clone() else { panic!("conservative") };
        let with_courtesy = |weight| {
            let courtesy = Courtesy { weight, ..table.courtesy };
            LaneChangeModel::Mcdm(Mcdm { courtesy, ..table.clone() })
        };
        let with_manner = |yield_deceleration| Manner { yield_deceleration, ..usual.manner };
        let attention = Attention {
            epoch: 1.0,
            concentrated_for: 15.0,
            inattentive_for: 60.0,
            inattentive: Alertness { epoch: 2.0, sight: 150.0, comfort: 5.0 },
        };
        for (name, expected) in [
            ("inattentive", Style { attention, ..usual.clone() }),
            ("altruistic", Style { change: with_courtesy(3.44), manner: with_manner(3.0), ..usual.clone() }),
            ("egoistic", Style { change: with_courtesy(0.0), manner: with_manner(0.0), ..usual.clone() }),
        ] {
            let found = template(name).typical().clone();
            let description = found.description.clone();
            assert_eq!(found, Style { name: name.into(), description, ..expected });
        }
    }

    #[test]
    fn the_cautious_keep_longer_gaps_than_the_conservative_everywhere_and_drive_slower() {
        let [cautious, usual] = ["cautious", "conservative"].map(|it| template(it).typical().clone());
        let (FollowingModel::Idm(gaps), FollowingModel::Idm(usual_gaps)) = (cautious.follow, usual.follow)
        else {
            panic!("both follow by IDM")
        };
        assert!(gaps.time_gap > usual_gaps.time_gap && gaps.jam_gap > usual_gaps.jam_gap);
        assert!(cautious.safety.min_gap > usual.safety.min_gap);
        assert!(cautious.safety.min_time_to_collision > usual.safety.min_time_to_collision);
        assert!(cautious.safety.max_deceleration < usual.safety.max_deceleration);
        assert!(cautious.manner.tightest > usual.manner.tightest);
        assert!(cautious.yielding.critical_gap > usual.yielding.critical_gap);
        assert!(cautious.speed_factor < usual.speed_factor);
        assert_eq!(cautious.change, usual.change);
    }

    #[test]
    fn every_number_of_the_models_has_a_range_but_weights_and_thresholds() {
        fn unbounded(table: &Table, path: &str, found: &mut Vec<String>) {
            for (key, value) in table {
                let path = format!("{path}{key}");
                match value {
                    Value::Table(inner) => unbounded(inner, &format!("{path}."), found),
                    Value::Float(_) if Range::of(&path).from.is_infinite() => found.push(path),
                    _ => {}
                }
            }
        }
        let mut found = Vec::new();
        for name in ["aggressive", "conservative", "mobil", "lmrs", "constant-hazard"] {
            unbounded(&Table::try_from(template(name).typical()).unwrap(), "", &mut found);
        }
        assert!(found.iter().all(|it| it.ends_with(".weight") || it == "change.theta"), "{found:?}");
    }
}
