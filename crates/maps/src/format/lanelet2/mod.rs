//! Lanelet2 maps: OSM XML with nodes, ways as borders, and relations as lanelets.

mod compose;
mod contents;
mod draw;
mod lookup;
mod orientation;
mod osm;
mod parse;
mod place;
mod projection;
mod regulation;
mod rules;
mod sharing;
mod speed;
mod unused;
mod write;

pub use compose::compose;
pub use osm::Document;
pub use projection::utm;

use crate::drawing::Drawing;
use crate::error::MapError;
use crate::left_hand;
use crate::map::Map;
use crate::options::ReadOptions;
use crate::problem::{BORDERS, Problem};
use crate::regulation::unobeyed;
use crate::size::Size;
use lookup::Lookup;

/// Reads a Lanelet2 map. Lanelets that cannot be used as they stand are left out and listed as problems.
///
/// # Errors
/// If it is no OSM XML or holds no lanelet that cars may use.
pub fn read(bytes: &[u8], options: &ReadOptions) -> Result<Map, MapError> {
    let (document, problems) = Document::parse(bytes)?;
    document.map(problems, options)
}

/// The text of a Lanelet2 map with this drawing; reading it gives the same network.
pub fn write(drawing: &Drawing) -> String {
    compose(drawing).write()
}

impl<'a> Document<'a> {
    /// Reads all elements of an OSM file, whether or not a map needs them. Elements without a usable id become
    /// problems.
    ///
    /// # Errors
    /// If it is no OSM XML.
    pub fn parse(bytes: &'a [u8]) -> Result<(Document<'a>, Vec<Problem>), MapError> {
        if bytes.len() as u64 > Size::MAXIMUM.0 {
            return Err(MapError::TooLarge { largest: Size::MAXIMUM });
        }
        let mut problems = Vec::new();
        let document = parse::parse(bytes, &mut problems)?;
        Ok((document, problems))
    }

    /// The refusal of a street map of OpenStreetMap, which has streets and no lanelet.
    fn streets(&self) -> Option<MapError> {
        if self.relations_of_type("lanelet").next().is_some() {
            return None;
        }
        let mut streets = self.ways.iter().filter(|it| self.tags(it.tags).get("highway").is_some());
        let first = streets.next()?;
        let (line, way) = (first.line as usize, first.id);
        Some(MapError::Streets { line, way, streets: 1 + streets.count() })
    }

    /// Latitude and longitude of the first node that has both [°].
    fn place(&self) -> Option<(f64, f64)> {
        self.nodes.iter().find_map(|it| Some((it.lat.get()?, it.lon.get()?)))
    }

    /// The map of these elements, with the `problems` that are already known, and the problems found here.
    ///
    /// # Errors
    /// If it holds no lanelet that cars may use.
    pub fn map(self, mut problems: Vec<Problem>, options: &ReadOptions) -> Result<Map, MapError> {
        if let Some(error) = self.streets() {
            return Err(error);
        }
        let (lookup, origin) = Lookup::new(&self, options.origin, &mut problems)?;
        let mut contents = contents::contents(&self, &lookup, &mut problems);
        let drawing = draw::draw(&self, lookup, options, &mut contents, &mut problems);
        problems.extend(left_hand::warning(self.place(), self.driving_side, options));
        problems.extend(unused::unused(&self, &drawing.rules).problems());
        let lanelets = self.relations_of_type("lanelet").count();
        // This frees its memory for the network.
        drop(self);
        match drawing.build() {
            Ok(mut map) => {
                map.network.law = options.law.rules();
                problems.extend(unobeyed(&map));
                problems.extend(map.problems);
                problems.sort_by_key(|it| it.line);
                Ok(Map { contents, problems, origin, ..map })
            }
            Err(MapError::NotDrivable { problems: flaws, .. }) => {
                problems.extend(flaws);
                problems.sort_by_key(|it| it.line);
                const TAG: &str =
                    "give roads the tags type=lanelet and subtype=road, or participant:vehicle=yes";
                let lack_borders = problems.first().is_some_and(|it| it.element == BORDERS);
                let remedy = if lack_borders { "add borders to them, or choose another map" } else { TAG };
                Err(MapError::NotDrivable { lanelets, problems, remedy })
            }
            Err(error) => Err(error),
        }
    }
}
