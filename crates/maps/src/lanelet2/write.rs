//! Drawings written as Lanelet2 maps.

use std::fmt::{self, Write};

use laneweave_network::DrivingSide;

use super::projection::Utm;
use super::rules::line_subtype;
use crate::drawing::{Drawing, Edge, Lane};

/// Where the origin of a drawing is put on the earth: latitude and longitude [°].
const ORIGIN: (f64, f64) = (49.0, 8.4);

/// The text of a Lanelet2 map with this drawing, which is read again as the same network.
///
/// Nodes have exact metric coordinates (`local_x`, `local_y`, `ele`), and latitude and longitude for other
/// programs, rounded to about a micrometre; these mean little further than some hundred kilometres from the
/// origin. Lanelets keep their ids; borders and points get those that come after.
pub fn write(drawing: &Drawing) -> String {
    let mut text = String::new();
    // Writing to a string never fails.
    let _ = write_to(&mut text, drawing);
    text
}

fn write_to(out: &mut impl Write, drawing: &Drawing) -> fmt::Result {
    let first_border = 1 + drawing.lanes.iter().map(|it| it.id).max().unwrap_or(0);
    let first_point = first_border + drawing.borders.len() as i64;
    let side = match drawing.driving_side {
        DrivingSide::Left => "left",
        DrivingSide::Right => "right",
    };
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    writeln!(out, r#"<osm version="0.6" generator="laneweave">"#)?;
    writeln!(out, r#"<MetaInfo format_version="1" map_version="1" driving_side="{side}"/>"#)?;
    write_nodes(out, drawing, first_point)?;
    for (border, id) in drawing.borders.iter().zip(first_border..) {
        write!(out, r#"<way id="{id}">"#)?;
        for point in &border.points {
            write!(out, r#"<nd ref="{}"/>"#, first_point + i64::from(*point))?;
        }
        write_tag(out, "type", "line_thin")?;
        write_tag(out, "subtype", line_subtype(border.crossing))?;
        writeln!(out, "</way>")?;
    }
    for lane in &drawing.lanes {
        write_lanelet(out, lane, first_border)?;
    }
    writeln!(out, "</osm>")
}

fn write_nodes(out: &mut impl Write, drawing: &Drawing, first: i64) -> fmt::Result {
    let utm = Utm::around(ORIGIN.0, ORIGIN.1);
    for (point, id) in drawing.points.iter().zip(first..) {
        let (latitude, longitude) = utm.map_or(ORIGIN, |it| it.inverse(point.x, point.y));
        write!(out, r#"<node id="{id}" lat="{latitude:.11}" lon="{longitude:.11}">"#)?;
        write_tag(out, "local_x", point.x)?;
        write_tag(out, "local_y", point.y)?;
        write_tag(out, "ele", point.z)?;
        writeln!(out, "</node>")?;
    }
    Ok(())
}

fn write_lanelet(out: &mut impl Write, lane: &Lane, first_border: i64) -> fmt::Result {
    let border = |edge: Edge| first_border + i64::from(edge.border);
    write!(out, r#"<relation id="{}">"#, lane.id)?;
    write!(out, r#"<member type="way" ref="{}" role="left"/>"#, border(lane.left))?;
    write!(out, r#"<member type="way" ref="{}" role="right"/>"#, border(lane.right))?;
    write_tag(out, "type", "lanelet")?;
    write_tag(out, "subtype", "highway")?;
    write_tag(out, "location", "nonurban")?;
    write_tag(out, "one_way", "yes")?;
    write_tag(out, "participant:vehicle", "yes")?;
    write_tag(out, "speed_limit", lane.limit_kmh)?;
    writeln!(out, "</relation>")
}

fn write_tag(out: &mut impl Write, key: &str, value: impl fmt::Display) -> fmt::Result {
    write!(out, r#"<tag k="{key}" v="{value}"/>"#)
}
