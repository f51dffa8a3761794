//! A picture of a map: lanes with their markings, entrances and exits, conflict areas, lights and problems. Parts
//! that lie far from each other have panels of their own.

mod explorer;
mod panel;

use std::collections::HashSet;

use laneweave_maps::{Map, Problem};
use laneweave_network::{Lanelet, Point};
use laneweave_study::{Bounds, Space, escaped, panels, text_width};

pub use explorer::explorer;
use panel::MapPanel;

/// Width of the page [px].
const WIDTH: f64 = 1400.0;
/// Around panels [px].
const MARGIN: f64 = 30.0;
/// Above the panels, for the title [px].
const HEAD: f64 = 50.0;
/// Below the panels, for the legend; and for the large numbers of bars on small screens [px].
const FOOT: f64 = 40.0;
const LOW: f64 = 16.0;
/// Maximum height of the panel of a page with one, and of those with several; minimum extent of a part [px].
const HEIGHTS: [f64; 2] = [1400.0, 700.0];
const LEAST: f64 = 110.0;
/// What the colours mean.
const LEGEND: [(&str, &str); 7] = [
    ("entrance", colours::ENTRANCE),
    ("exit", colours::EXIT),
    ("conflict area", colours::CONFLICT),
    ("traffic light and its stop line", colours::LIGHT),
    ("yield or stop", colours::PRIORITY),
    ("crosswalk", colours::CROSSWALK),
    ("problem", colours::PROBLEM),
];
/// The style sheet.
mod colours {
    pub(super) const ROAD: &str = "#d9dce0";
    pub(super) const CONFLICT: &str = "#e8871e";
    pub(super) const MARKING: &str = "#5a6068";
    pub(super) const ENTRANCE: &str = "#1a7f37";
    pub(super) const EXIT: &str = "#1f5fbf";
    pub(super) const LIGHT: &str = "#c1121f";
    pub(super) const PRIORITY: &str = "#7b2d8b";
    pub(super) const PROBLEM: &str = "#d6006c";
    pub(super) const CROSSWALK: &str = "#8d99a6";
}

/// The picture of a map as SVG, with a circle around each lanelet that `problems` name. It is as wide as what it is
/// shown in; each lanelet says its id when it is pointed at.
pub fn picture(title: &str, map: &Map, problems: &[Problem]) -> String {
    let (panels, bottom) = laid_out(map, HEAD);
    let height = bottom + FOOT;
    let around = format!(
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{MARGIN}\" y=\"30\" font-size=\"18\">{}</text>\n",
        escaped(title)
    );
    opening(height) + &around + &contents(&panels, problems) + &legend(height - FOOT + 20.0) + "</svg>\n"
}

/// The same without title and legend, on the ground of a page.
fn bare(map: &Map, problems: &[Problem]) -> String {
    let (panels, bottom) = laid_out(map, MARGIN);
    opening(bottom + LOW) + &contents(&panels, problems) + "</svg>\n"
}

/// The first element of a picture of this height [px].
fn opening(height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.0}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\">\n"
    )
}

/// All panels.
fn contents(panels: &[MapPanel], problems: &[Problem]) -> String {
    let named: HashSet<&str> = problems.iter().map(|it| it.element.as_str()).collect();
    let mut svg = String::new();
    panels.iter().for_each(|it| it.draw(&mut svg, &named));
    svg
}

/// The panels with their positions from `top` on, and their lower end [px].
fn laid_out(map: &Map, top: f64) -> (Vec<MapPanel<'_>>, f64) {
    let around = |it: &Lanelet| {
        Bounds::of(it.left_border.points().iter().chain(it.right_border.points()).map(in_plan))
    };
    let bounds: Vec<Bounds> = map.network.lanelets.iter().map(around).collect();
    let space = Space { width: WIDTH, margin: MARGIN, top, heights: HEIGHTS, least: LEAST };
    let (panels, bottom) = panels(&bounds, space);
    (panels.into_iter().map(|panel| MapPanel { map, panel }).collect(), bottom)
}

/// A point as it is seen from above [m].
fn in_plan(point: &Point) -> [f64; 2] {
    [point.x, point.y]
}

fn legend(y: f64) -> String {
    let mut svg = String::new();
    let mut x = MARGIN;
    for (text, colour) in LEGEND {
        svg += &format!(
            "<rect x=\"{x:.0}\" y=\"{:.0}\" width=\"12\" height=\"12\" fill=\"{colour}\"/>\
             <text x=\"{:.0}\" y=\"{y:.0}\">{text}</text>\n",
            y - 11.0,
            x + 18.0,
        );
        x += 40.0 + text_width(text);
    }
    svg + &format!("<text x=\"{:.0}\" y=\"{y:.0}\" text-anchor=\"end\">north is up</text>\n", WIDTH - MARGIN)
}
