//! The JSON schema of scenario files.

use std::path::Path;

use crate::command::golden::assert_golden;
use crate::command::program::Folder;

#[test]
fn the_schema_in_the_repository_is_that_of_the_program() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/scenario.schema.json");
    assert_golden(&path, &Folder::new().laneweave("schema").text());
}
