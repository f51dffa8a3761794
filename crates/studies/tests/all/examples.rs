//! The example runs, and what it asserts is so.

use std::path::Path;

#[path = "../../examples/08_fit_a_style.rs"]
pub mod fit_a_style;

#[test]
fn a_style_is_fitted_to_a_recording_and_drives() {
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::env::set_current_dir(home).expect("the folder of the project is there");
    assert_eq!(fit_a_style::main(), Ok(()));
}
