//! `fcd.xml`: the positions of all vehicles, in the format of SUMO's `--fcd-output` with `--fcd-output.acceleration`.

use std::path::PathBuf;

use laneweave_network::{Network, Point};
use laneweave_scenario::Fault;

use super::xml::XmlFile;
use crate::output::batch::{Batch, Writer};
use crate::output::folder::Folder;
use crate::output::frame::{Body, Seen};
use crate::output::names::Names;

const ROOT: &str = "<fcd-export xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
    xsi:noNamespaceSchemaLocation=\"http://sumo.dlr.de/xsd/fcd_file.xsd\">";

/// Writes an element for each instant, with one for each vehicle.
pub(in crate::output) struct Fcd {
    file: XmlFile,
    /// Whether heights are written: only if the map has any.
    has_heights: bool,
}

impl Fcd {
    /// Begins the file in `folder`.
    pub(in crate::output) fn create(folder: &Folder, network: &Network) -> Result<Fcd, Fault> {
        let file = XmlFile::create(&folder.file("fcd.xml"), ROOT, folder.provenance)?;
        let mut points = network.lanelets.iter().flat_map(|it| it.centre.points());
        Ok(Fcd { file, has_heights: points.any(|it| it.z != 0.0) })
    }

    fn vehicle(&mut self, seen: &Seen, body: &Body, names: &Names) -> Result<(), Fault> {
        let Seen { motion, class, parameters, .. } = seen;
        let Body { lanelet, along, front, pose, .. } = body;
        let Fcd { file, has_heights } = self;
        file.raw("        <vehicle id=\"").vehicle(names, motion.id);
        file.raw("\" x=\"").number(front.x);
        file.raw("\" y=\"").number(front.y);
        if *has_heights {
            file.raw("\" z=\"").number(front.z);
        }
        file.raw("\" angle=\"").number(clockwise_from_north(pose.heading));
        file.raw("\" type=\"").raw(names.type_in_xml(*class, *parameters));
        file.raw("\" speed=\"").number(motion.speed);
        file.raw("\" pos=\"").number(along.max(0.0));
        file.raw("\" lane=\"").raw(names.lanes.xml(*lanelet));
        file.raw("\" slope=\"").number(if *has_heights { slope(front, &pose.at) } else { 0.0 });
        file.raw("\" acceleration=\"").number(f64::from(motion.acceleration));
        file.end("\"/>\n")
    }
}

impl Writer for Fcd {
    fn write(&mut self, batch: &Batch, names: &Names) -> Result<(), Fault> {
        let Batch::Frame(frame) = batch else { return Ok(()) };
        for (step, seen, bodies) in frame.instants() {
            let file =
                self.file.raw("    <timestep time=\"").time(names.begin_s + f64::from(step) * names.step_s);
            if seen.is_empty() {
                file.end("\"/>\n")?;
                continue;
            }
            file.end("\">\n")?;
            for (seen, body) in seen.iter().zip(bodies) {
                self.vehicle(seen, body, names)?;
            }
            self.file.end("    </timestep>\n")?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<PathBuf, Fault> {
        self.file.finish("</fcd-export>\n")
    }
}

/// A heading, counter-clockwise from east [rad], in SUMO's convention [°].
fn clockwise_from_north(heading: f64) -> f64 {
    let angle = (90.0 - heading.to_degrees()).rem_euclid(360.0);
    // An angle that would be rounded to a full turn is zero.
    if angle < 359.995 { angle } else { 0.0 }
}

/// Slope of the road from the centre of a vehicle to its front [°].
fn slope(front: &Point, centre: &Point) -> f64 {
    (front.z - centre.z).atan2(front.distance(centre)).to_degrees()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn angles_count_clockwise_from_north() {
        let angles = [FRAC_PI_2, 0.0, -FRAC_PI_2, PI, -PI, FRAC_PI_2 + 1e-9].map(clockwise_from_north);
        assert_eq!(angles.map(|it| (100.0 * it).round() / 100.0), [0.0, 90.0, 180.0, 270.0, 270.0, 0.0]);
    }
}
