//! Lanelet2 maps: OSM XML with nodes, ways as borders, and relations as lanelets.

mod draw;
mod orientation;
mod osm;
mod place;
mod projection;
mod rules;
mod speed;
mod write;

pub use write::write;

use crate::error::MapError;
use crate::format::{MAXIMUM_SIZE, Map, ReadOptions};

/// Reads a Lanelet2 map. Lanelets that cannot be used as they stand are left out and listed as problems.
///
/// Lanelets with `one_way=no` are used in their forward direction only, and listed, too. Regulatory elements
/// other than speed limits are passed over.
///
/// # Errors
/// If it is no OSM XML or holds no lanelet that cars may use.
pub fn read(bytes: &[u8], options: &ReadOptions) -> Result<Map, MapError> {
    if bytes.len() as u64 > MAXIMUM_SIZE {
        return Err(MapError::TooLarge { bytes: bytes.len() as u64, limit: MAXIMUM_SIZE });
    }
    let mut problems = Vec::new();
    let document = osm::parse(bytes, &mut problems)?;
    let (drawing, origin) = draw::draw(&document, options, &mut problems)?;
    let built = drawing.network();
    let (network, flaws) = match built {
        Err(MapError::NotDrivable { problems: flaws, .. }) => {
            problems.extend(flaws);
            problems.sort_by_key(|it| it.line);
            return Err(MapError::NotDrivable { lanelets: document.lanelets().count(), problems });
        }
        built => built?,
    };
    problems.extend(flaws);
    problems.sort_by_key(|it| it.line);
    Ok(Map { network, problems, origin })
}
