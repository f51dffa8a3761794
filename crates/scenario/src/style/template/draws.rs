//! The draws of a fitted style: other numbers that the recordings allow as well.

use toml::{Table, Value};

use super::PROVENANCE;
use crate::fault::Fault;
use crate::source::Source;

/// Draws of the parameters of a style.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Draws {
    /// The parameters, each by its keys from the outermost in.
    pub(super) of: Vec<Vec<String>>,
    /// Their values in each draw.
    pub(super) values: Vec<Vec<f64>>,
}

impl Draws {
    /// Those in a table that says where the numbers of a style come from.
    ///
    /// # Errors
    /// If they are no lists of numbers, or not as long as the list of parameters.
    pub(super) fn of(provenance: &Table, source: &Source) -> Result<Draws, Fault> {
        const OF: &str = "draws_of";
        const VALUES: &str = "draws";
        let fault =
            |key, what: String, remedy| Err(Fault::new(source.place(&[PROVENANCE, key]), what, remedy));
        let named = provenance.get(OF).map_or(Ok(Vec::new()), |it| it.clone().try_into::<Vec<String>>());
        let Ok(of) = named else {
            let remedy = "give the keys of numbers, such as [\"change.theta\"]";
            return fault(OF, "draws_of is no list of keys".into(), remedy);
        };
        let values = provenance.get(VALUES).map_or(Ok(Vec::new()), numbers);
        let Ok(values) = values else {
            let remedy = "give a list of numbers for each draw, such as [[0.1], [0.2]]";
            return fault(VALUES, "draws are no lists of numbers".into(), remedy);
        };
        if let Some(at) = values.iter().position(|it| it.len() != of.len()) {
            let what = format!("draw {} has {} numbers for {} keys", at + 1, values[at].len(), of.len());
            return fault(VALUES, what, "give one number for each key of draws_of");
        }
        let of = of.iter().map(|it| it.split('.').map(str::to_owned).collect()).collect();
        Ok(Draws { of, values })
    }
}

fn numbers(value: &Value) -> Result<Vec<Vec<f64>>, toml::de::Error> {
    value.clone().try_into()
}
