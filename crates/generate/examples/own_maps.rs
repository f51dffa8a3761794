//! Writes the maps that come with the program into the folder `maps` of the repository.

use std::error::Error;
use std::fs;
use std::path::Path;

use laneweave_generate::own_maps;
use laneweave_maps::lanelet2;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../maps");
    fs::create_dir_all(&folder)?;
    for (name, drawing) in own_maps()? {
        fs::write(folder.join(name), lanelet2::write(&drawing))?;
    }
    Ok(())
}
