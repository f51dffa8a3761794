//! `laneweave check`.

use std::path::PathBuf;

use clap::Args;
use laneweave::Fault;
use laneweave::check::GraphJson;
use laneweave::maps::{ReadOptions, load};
use laneweave::output::write_whole;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The map file (Lanelet2: .osm, .osm.gz).
    map: PathBuf,
    /// Write the routing graph here, as one JSON object keyed by the ids of the lanelets.
    #[arg(long, value_name = "FILE")]
    graph: Option<PathBuf>,
}

impl Arguments {
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let map = load(&self.map, &ReadOptions::default())
            .map_err(|error| Fault::new(self.map.display(), error, "correct it"))?;
        if let Some(path) = &self.graph {
            let json = serde_json::to_string(&GraphJson(&map))
                .map_err(|error| Fault::new(path.display(), error, "report this as a bug"))?;
            write_whole(path, &json)?;
        }
        Ok(())
    }
}
