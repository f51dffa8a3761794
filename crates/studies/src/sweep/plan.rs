//! The plan of a sweep, a TOML file: which keys of a scenario have which values, and with which seeds.

use std::path::{Path, PathBuf};

use laneweave_scenario::scenario::{Origin, Scenario};
use laneweave_scenario::{Fault, Source};
use serde::Deserialize;

use super::cube::Cube;
use super::variant::{Change, Variant};
use crate::compare::seeds_from;

/// Maximum of runs of a plan.
const MOST_RUNS: usize = 1_000_000;

/// A plan as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// The scenario (.toml), or a bare map.
    scenario: PathBuf,
    #[serde(default)]
    seeds: Seeds,
    /// Keys, each with a list of values: all combinations of them.
    #[serde(default)]
    grid: toml::Table,
    /// Tables of keys with a value each.
    list: Option<Vec<toml::Table>>,
    latin_hypercube: Option<WrittenCube>,
}

/// Points that are spread evenly over the ranges of several keys.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenCube {
    samples: u32,
    #[serde(default = "one")]
    seed: u64,
    /// Keys, each with its range [lowest, highest].
    keys: toml::Table,
}

fn one() -> u64 {
    1
}

/// The seeds of each variant.
#[derive(Deserialize)]
#[serde(untagged, expecting = "invalid value: expected a number of seeds, or a list of seeds")]
enum Seeds {
    /// So many, from that of the scenario on.
    Count(u64),
    /// These.
    List(Vec<u64>),
}

impl Default for Seeds {
    fn default() -> Seeds {
        Seeds::Count(1)
    }
}

/// A plan.
pub(super) struct Plan {
    /// The file of the scenario, or of the map.
    scenario: PathBuf,
    /// The scenario without any change.
    base: (Scenario, Origin),
    /// What changes in each variant of it.
    pub(super) variants: Vec<Variant>,
    /// The seeds of each variant.
    pub(super) seeds: Vec<u64>,
}

impl Plan {
    /// The plan in the text of `source`. Its relative paths begin in the folder of the file.
    ///
    /// # Errors
    /// If the text is no plan, or plans nothing, or too much.
    pub(super) fn of(source: &Source) -> Result<Plan, Fault> {
        if source.is_scenario() {
            return Err(no_plan(&source.path, "a scenario"));
        }
        let written: Written = source.parse()?;
        let scenario = source.folder().join(&written.scenario);
        let base = Origin::open(&scenario).map_err(|it| named(it, source, &scenario, None))?;
        let seeds = written.seeds.all(source, base.0.run.seed)?;
        let reader = Reader { source };
        let mut variants = match &written.list {
            Some(rows) => reader.rows(rows)?,
            None => vec![Variant::default()],
        };
        let samples = written.latin_hypercube.iter().map(|it| reader.cube(it));
        let grid = reader.leaves(&["grid"], &written.grid);
        let choices = grid.iter().map(|(path, values)| reader.choices(path, values));
        for others in samples.chain(choices) {
            let others = others?;
            check_size(source, variants.len().saturating_mul(others.len()))?;
            variants = every(&variants, &others);
        }
        check_size(source, variants.len().saturating_mul(seeds.len()))?;
        variants.iter().try_for_each(|it| it.names_each_key_once())?;
        Ok(Plan { scenario, base, variants, seeds })
    }

    /// The scenario of a `variant` of this plan, with this seed.
    ///
    /// # Errors
    /// If a key is unknown, or its value of another kind.
    pub(super) fn scenario(&self, variant: &Variant, seed: u64) -> Result<(Scenario, Origin), Fault> {
        variant.scenario((&self.base.0, &self.base.1), seed)
    }

    /// The `fault` of a `variant` of this plan in `source`, found where the plan names its file.
    pub(super) fn named(&self, fault: Fault, source: &Source, variant: &Variant) -> Fault {
        named(fault, source, &self.scenario, Some(variant))
    }
}

/// The file at `path` is `something` else than a plan.
pub(super) fn no_plan(path: &Path, something: &str) -> Fault {
    let what = format!("this is {something}, but the plan of a sweep is expected");
    let remedy =
        format!("write a plan with scenario = {:?} and what changes: laneweave sweep --help", path.display());
    Fault::new(path.display(), what, remedy)
}

/// A `fault` in a plan. That of a file which the plan names, such as a missing one, is found where it names it: as the
/// `scenario`, or in a `variant`.
fn named(fault: Fault, source: &Source, scenario: &Path, variant: Option<&Variant>) -> Fault {
    let is_of = |it: &&Change| it.value_text() == fault.place;
    let change = variant.into_iter().flat_map(|it| &it.changes).find(is_of);
    let is_scenario = scenario.display().to_string() == fault.place;
    let place =
        change.map(|it| it.place.clone()).or_else(|| is_scenario.then(|| source.place(&["scenario"])));
    match place {
        Some(place) => Fault { what: format!("{}: {}", fault.place, fault.what), place, ..fault },
        None => fault,
    }
}

fn check_size(source: &Source, runs: usize) -> Result<(), Fault> {
    if runs <= MOST_RUNS {
        return Ok(());
    }
    let what = format!("this plans more than {MOST_RUNS} runs");
    Err(Fault::new(source.path.display(), what, "divide it into several plans, or take fewer values"))
}

/// Each of the `variants` with each of the `others`.
fn every(variants: &[Variant], others: &[Variant]) -> Vec<Variant> {
    variants.iter().flat_map(|variant| others.iter().map(|it| variant.and(it))).collect()
}

impl Seeds {
    /// All seeds; those of a number begin with `first`.
    fn all(self, source: &Source, first: u64) -> Result<Vec<u64>, Fault> {
        let wrong = |what: String, remedy| Err(Fault::new(source.place(&["seeds"]), what, remedy));
        match self {
            Seeds::Count(0) => wrong("there are no seeds".into(), "give 1 or more"),
            Seeds::Count(count) if count > MOST_RUNS as u64 => {
                wrong(format!("{count} seeds are more than {MOST_RUNS}"), "give fewer")
            }
            Seeds::Count(count) => seeds_from(first, count),
            Seeds::List(seeds) if seeds.is_empty() => {
                wrong("there are no seeds".into(), "give one, such as [1]")
            }
            Seeds::List(seeds) => {
                let mut sorted = seeds.clone();
                sorted.sort_unstable();
                match sorted.windows(2).find(|it| it[0] == it[1]) {
                    Some(twice) => wrong(format!("the seed {} occurs twice", twice[0]), "give it once"),
                    None => Ok(seeds),
                }
            }
        }
    }
}

/// The path of a key in a plan or in a scenario.
type KeyPath = Vec<String>;

/// Reads the tables of a plan.
struct Reader<'s> {
    source: &'s Source,
}

impl Reader<'_> {
    fn wrong(&self, path: &[String], what: impl Into<String>, remedy: &str) -> Fault {
        let path: Vec<&str> = path.iter().map(String::as_str).collect();
        Fault::new(self.source.place(&path), what.into(), remedy)
    }

    /// The keys of `table` that are no tables, with their values; each path begins with `at`.
    fn leaves<'t>(&self, at: &[&str], table: &'t toml::Table) -> Vec<(KeyPath, &'t toml::Value)> {
        let mut found = Vec::new();
        for (key, value) in table {
            let path: Vec<&str> = at.iter().copied().chain([key.as_str()]).collect();
            match value.as_table() {
                Some(inner) if !inner.is_empty() => found.extend(self.leaves(&path, inner)),
                _ => found.push((path.iter().map(|it| (*it).to_owned()).collect(), value)),
            }
        }
        found
    }

    /// The change to a value of the key whose place in the plan is `path`, below so many tables of the plan itself.
    fn change(&self, path: &[String], tables: usize, value: &toml::Value) -> Result<Change, Fault> {
        let names: Vec<&str> = path.iter().map(String::as_str).collect();
        let place = self.source.place(&names);
        let value = serde_json::to_value(value).map_err(|error| Fault::bug(&place, error))?;
        let change = Change::new(&names[tables..], value, place)?;
        Ok(change.within(&std::path::absolute(self.source.folder()).unwrap_or_default()))
    }

    /// A variant for each value of a key of the grid.
    fn choices(&self, path: &[String], values: &toml::Value) -> Result<Vec<Variant>, Fault> {
        let Some(values) = values.as_array() else {
            let remedy = "write a list, even of one value: [1000]";
            return Err(self.wrong(path, "the values of a key of the grid are a list", remedy));
        };
        if values.is_empty() {
            return Err(self.wrong(
                path,
                "this key of the grid has no values",
                "give at least one, or leave it out",
            ));
        }
        values.iter().map(|it| Ok(Variant::of([self.change(path, 1, it)?]))).collect()
    }

    /// A variant for each row of the list.
    fn rows(&self, rows: &[toml::Table]) -> Result<Vec<Variant>, Fault> {
        if rows.is_empty() {
            let at = ["list".to_owned()];
            return Err(self.wrong(&at, "the list has no rows", "add one: [[list]], or leave it out"));
        }
        let row = |(number, table): (usize, &toml::Table)| {
            let number = number.to_string();
            let leaves = self.row_leaves(&["list", &number], table);
            let changes = leaves.into_iter().map(|(path, value)| self.change(&path, 2, value));
            Ok(Variant::of(changes.collect::<Result<Vec<Change>, Fault>>()?))
        };
        rows.iter().enumerate().map(row).collect()
    }

    /// The keys of a row. A table of styles is a value: it replaces all styles.
    fn row_leaves<'t>(&self, at: &[&str], table: &'t toml::Table) -> Vec<(KeyPath, &'t toml::Value)> {
        let is_styles = |it: &(&String, &toml::Value)| it.0 == "styles";
        let whole = table.iter().filter(is_styles);
        let path = |key: &str| at.iter().copied().chain([key]).map(str::to_owned).collect();
        let mut found: Vec<(KeyPath, &toml::Value)> = whole.map(|(key, value)| (path(key), value)).collect();
        for (key, value) in table.iter().filter(|it| !is_styles(it)) {
            match value.as_table() {
                Some(inner) => {
                    let below: Vec<&str> = at.iter().copied().chain([key.as_str()]).collect();
                    found.extend(self.leaves(&below, inner));
                }
                None => found.push((path(key), value)),
            }
        }
        found
    }

    /// A variant for each point of a Latin hypercube.
    fn cube(&self, written: &WrittenCube) -> Result<Vec<Variant>, Fault> {
        let at = |name: &str| ["latin_hypercube".to_owned(), name.to_owned()];
        if written.samples == 0 {
            return Err(self.wrong(&at("samples"), "there are no samples", "give 1 or more"));
        }
        check_size(self.source, written.samples as usize)?;
        let leaves = self.leaves(&["latin_hypercube", "keys"], &written.keys);
        if leaves.is_empty() {
            let remedy = "give keys with their ranges, such as demand.trucks = [0, 0.3]";
            return Err(self.wrong(&at("keys"), "there are no keys", remedy));
        }
        let ranges: Vec<[f64; 2]> =
            leaves.iter().map(|(path, value)| self.range(path, value)).collect::<Result<_, Fault>>()?;
        let points = Cube { samples: written.samples, seed: written.seed }.points(&ranges);
        let variant = |point: &Vec<f64>| {
            let changes = leaves
                .iter()
                .zip(point)
                .map(|((path, _), value)| self.change(path, 2, &toml::Value::Float(*value)));
            Ok(Variant::of(changes.collect::<Result<Vec<Change>, Fault>>()?))
        };
        points.iter().map(variant).collect()
    }

    /// The range of a key.
    fn range(&self, path: &[String], value: &toml::Value) -> Result<[f64; 2], Fault> {
        let number = |it: &toml::Value| it.as_float().or(it.as_integer().map(|it| it as f64));
        let range: Option<Vec<f64>> = value.as_array().and_then(|it| it.iter().map(number).collect());
        match range.as_deref() {
            Some([low, high]) if low < high && (high - low).is_finite() => Ok([*low, *high]),
            Some([low, high]) if low >= high => {
                let what = format!("the range from {low} to {high} is empty");
                Err(self.wrong(path, what, "write the lowest number first, such as [0, 0.3]"))
            }
            _ => {
                let what = "this is no range of numbers";
                Err(self.wrong(path, what, "write [lowest, highest], such as [0, 0.3]"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(text: &str) -> Result<Plan, Fault> {
        Plan::of(&Source { path: "plan.toml".into(), text: format!("scenario = \"a.osm\"\n{text}") })
    }

    fn words(text: &str) -> Vec<String> {
        plan(text)
            .map(|it| it.variants.iter().map(Variant::to_text).collect())
            .unwrap_or_else(|it| vec![it.to_string()])
    }

    #[test]
    fn a_grid_has_all_combinations() {
        let text = "[grid]\ndemand.trucks = [0, 0.1]\nmodel = [\"mcdm\", \"mobil\"]\n";
        let expected = [
            "demand.trucks=0, model=mcdm",
            "demand.trucks=0, model=mobil",
            "demand.trucks=0.1, model=mcdm",
            "demand.trucks=0.1, model=mobil",
        ];
        assert_eq!(words(text), expected);
    }

    #[test]
    fn a_key_may_be_written_with_its_table_or_in_quotes() {
        let quoted = words("[grid]\n\"demand.trucks\" = [0.2]\n");
        assert_eq!(words("[grid.demand]\ntrucks = [0.2]\n"), quoted);
        assert_eq!(quoted, ["demand.trucks=0.2"]);
    }

    #[test]
    fn a_list_has_its_rows_each_with_each_point_of_the_grid() {
        let text =
            "[[list]]\nstyles = { egoistic = 1 }\nrun.step_s = 0.2\n[[list]]\n[grid]\nmodel = [\"null\"]\n";
        assert_eq!(words(text), ["styles={\"egoistic\":1}, run.step_s=0.2, model=null", "model=null"]);
    }

    #[test]
    fn without_anything_there_is_one_variant() {
        let plan = plan("seeds = 3").expect("a plan");
        assert_eq!((plan.variants.len(), plan.seeds), (1, vec![1, 2, 3]));
    }

    #[test]
    fn what_is_wrong_has_its_place() {
        let cases = [
            ("seeds = 0", "plan.toml:2:1: there are no seeds; give 1 or more"),
            ("seeds = [1, 2, 1]", "plan.toml:2:1: the seed 1 occurs twice; give it once"),
            (
                "[grid]\nmodel = []",
                "plan.toml:3:1: this key of the grid has no values; give at least one, or leave it out",
            ),
            (
                "[grid]\nmodel = \"mcdm\"",
                "plan.toml:3:1: the values of a key of the grid are a list; write a list, even of one value: [1000]",
            ),
            ("list = []", "plan.toml:2:1: the list has no rows; add one: [[list]], or leave it out"),
            ("[gird]", "plan.toml:2:2: unknown key \"gird\"; did you mean \"grid\"?"),
            (
                "[grid]\nmodel = [\"mcdm\"]\n[[list]]\nmodel = \"null\"",
                "plan.toml:3:1: the key model is given twice; leave it out here, or in the other table",
            ),
            (
                "[grid]\ndemand = [{ trucks = 0.1 }]\n[[list]]\ndemand.trucks = 0.2",
                "plan.toml:3:1: the keys demand.trucks and demand both say what one of them is; leave it out here, or in the other table",
            ),
            (
                "[latin_hypercube]\nsamples = 3\nkeys.demand.trucks = [0.3, 0]",
                "plan.toml:4:13: the range from 0.3 to 0 is empty; write the lowest number first, such as [0, 0.3]",
            ),
            (
                "[latin_hypercube]\nsamples = 3\nkeys.demand.trucks = [0.3]",
                "plan.toml:4:13: this is no range of numbers; write [lowest, highest], such as [0, 0.3]",
            ),
            (
                "[grid]\nrun.seed = [1, 2]",
                "plan.toml:3:5: the seed is not a key of a sweep; give seeds = [1, 2] at the top of the plan",
            ),
        ];
        for (text, expected) in cases {
            assert_eq!(words(text), [expected]);
        }
    }
}
