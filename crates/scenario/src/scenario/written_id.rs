//! How ids are written in scenario files.

use schemars::JsonSchema;

/// The id of a lanelet or a light: a text, or a whole number without quotes.
#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "it describes files; ids are read by their own type")]
pub(super) enum WrittenId {
    Text(String),
    Number(i64),
}
