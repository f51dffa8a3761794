//! A map: areas such as lanelets in the colours of a quantity, and marks where something happened.

mod groups;
mod shading;

use std::collections::BTreeMap;

use super::drawing::{Drawing, Key, above};
use super::drawn::{Drawn, Values, text, value};
use super::lines::{UNITS_PER_PX, append, in_px};
use super::plan::{Bounds, Panel, Space, panels};
use super::series::{colour, marker, marker_of};
use super::sheet::Sheet;
use groups::{Group, groups};

pub use shading::{OnTop, Shading};

/// Around the panels of a map [px].
const MARGIN: f64 = 14.0;
/// Maximum height of a panel that is alone, and of those side by side; minimum extent of a part [px].
const HEIGHTS: [f64; 2] = [420.0, 300.0];
const LEAST: f64 = 70.0;
/// Height of a line of the legend, and space above the panels [px].
const LINE: f64 = 19.0;
const ABOVE: f64 = 12.0;
/// Width of the lines between areas [m], its maximum, and below which there are none [px].
const SEAM: f64 = 0.3;
const THICKEST: f64 = 0.4;
const THINNEST: f64 = 0.12;
/// With more areas than this none says its name when it is pointed at: the page would be too large.
const MOST_NAMED: usize = 2500;

/// An area of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Its name: the id of a lanelet.
    pub name: String,
    /// Its corners in turn (x to the east, y to the north) [m].
    pub outline: Vec<[f64; 2]>,
}

/// Places of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    /// Its kind, in the data.
    pub kind: String,
    /// The kind in the legend.
    pub key: String,
    /// The quantity of a mark, with its unit.
    pub quantity: String,
    /// Number of its colour and its shape.
    pub series: usize,
    /// The largest size of a mark, as a multiple of the usual one.
    pub largest: f64,
    /// The places.
    pub marks: Vec<MarkAt>,
}

/// A mark on a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MarkAt {
    /// The name of its area.
    pub area: String,
    /// Its place [m].
    pub at: [f64; 2],
    /// The value of its quantity.
    pub value: f64,
    /// How many it stands for: the area of the mark grows with it.
    pub weight: f64,
}

/// Draws a map for a column: areas in the colours of a `shading`, if there is one, and marks over them. Parts that lie
/// far from each other have panels of their own. Marks that would lie on each other become one of each kind.
pub fn map(areas: &[Area], shading: Option<&Shading>, marks: &[Marks]) -> Drawn {
    let layout = Sheet::Column.layout();
    let width = layout.left + layout.plot[0] + MARGIN;
    let keys: Vec<Key> = marks
        .iter()
        .map(|it| Key { mark: dots(it.series, &dot(&marker(0.0, 0.0, it.series), "")), text: it.key.clone() })
        .collect();
    let mut places = above([MARGIN, width - MARGIN], &keys, layout);
    let legend = shading.map_or(0.0, Shading::height);
    places.iter_mut().for_each(|it| it[1] += legend);
    let top = places.last().map_or(legend, |it| it[1] + 0.5 * LINE) + ABOVE;
    let bounds: Vec<Bounds> = areas.iter().map(|it| Bounds::of(it.outline.iter().copied())).collect();
    let space = Space { width, margin: MARGIN, top, heights: HEIGHTS, least: LEAST };
    let (panels, bottom) = panels(&bounds, space);
    let mut drawing = Drawing::blank([width, bottom]);
    let mut values = Values::of(["what", "lanelet", "x_m", "y_m", "quantity", "value"]);
    if let Some(shading) = shading {
        shading.draw_key(&mut drawing, MARGIN);
        shading.list(areas, &mut values);
    }
    drawing.keys(&keys, &places);
    for panel in &panels {
        match shading {
            Some(shading) => shaded(&mut drawing, panel, areas, shading),
            None => roads(&mut drawing, panel, areas),
        }
        drawing.add(&format!("<g class=\"scale\">{}</g>", panel.bar()));
    }
    let groups = groups(marks, |at| {
        let panel = panels.iter().find(|panel| panel.bounds.is_near(at))?;
        Some(panel.place(at))
    });
    (0..marks.len()).for_each(|kind| drawing.add(&marked(&marks[kind], kind, &groups)));
    marks.iter().for_each(|it| it.list(&mut values));
    drawing.finish(values)
}

/// The outline of an area as a path in units.
fn outline(panel: &Panel, area: &Area) -> String {
    let mut path = String::new();
    append(&mut path, &panel.visible(area.outline.iter().copied()));
    path + "z"
}

/// All areas of a panel in one colour, with lines between them where lanes are wide enough.
fn roads(drawing: &mut Drawing, panel: &Panel, areas: &[Area]) {
    let path: String = panel.members.iter().map(|it| outline(panel, &areas[*it])).collect();
    let [across, upwards] = panel.scale();
    let seam = (SEAM * across.min(upwards)).min(THICKEST);
    let (stroke, width, class) =
        if seam < THINNEST { (shading::NONE, THICKEST, "road") } else { ("white", seam, "road seam") };
    drawing.add(&format!(
        "<path {} d=\"{path}\" fill=\"{}\" stroke=\"{stroke}\" stroke-width=\"{:.1}\" class=\"{class}\"/>",
        in_px(),
        shading::NONE,
        width * UNITS_PER_PX
    ));
}

/// The areas of a panel in the colours of their classes: first those without a value, last those that matter most.
fn shaded(drawing: &mut Drawing, panel: &Panel, areas: &[Area], shading: &Shading) {
    let mut of_class: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for area in &panel.members {
        of_class.entry(shading.rank(*area)).or_default().push(*area);
    }
    for members in of_class.values() {
        let Some((colour, class)) = members.first().map(|it| shading.colour(*it)) else { continue };
        let shape = |it: &usize| {
            let path = outline(panel, &areas[*it]);
            match areas.len() {
                0..=MOST_NAMED => {
                    let title = shading.title(*it, &areas[*it].name);
                    format!("<path d=\"{path}\"><title>{title}</title></path>")
                }
                _ => format!("<path d=\"{path}\"/>"),
            }
        };
        let shapes: String = members.iter().map(shape).collect();
        drawing.add(&format!(
            "<g {} fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"4\" class=\"{class}\">{shapes}</g>",
            in_px()
        ));
    }
}

/// A mark of this shape, which says what it is when it is pointed at.
fn dot(shape: &str, title: &str) -> String {
    match title {
        "" => format!("<path d=\"{shape}\" class=\"dot\"/>"),
        _ => format!("<path d=\"{shape}\" class=\"dot\"><title>{title}</title></path>"),
    }
}

/// Marks in the colour of their series.
fn dots(series: usize, marks: &str) -> String {
    let (colour, class) = colour(series);
    format!("<g fill=\"{colour}\" stroke=\"white\" stroke-width=\"0.4\" class=\"{class}\">{marks}</g>")
}

/// The marks of a kind in all groups.
fn marked(marks: &Marks, kind: usize, groups: &[Group]) -> String {
    let of_kind = groups.iter().flat_map(Group::members).filter(|it| it.kind == kind);
    let shapes: String = of_kind
        .map(|it| {
            let (x, y) = it.at;
            let title = match it.number {
                1 => {
                    let (area, quantity, number) = (&it.first.area, &marks.quantity, value(it.first.value));
                    format!("{}, lanelet {area}: {quantity} {number}", marks.kind)
                }
                _ => format!("{}: {}", marks.kind, value(it.weight)),
            };
            dot(&marker_of(x, y, marks.series, it.size), &super::escaped(&title))
        })
        .collect();
    dots(marks.series, &shapes)
}

impl Marks {
    /// A row for each mark.
    fn list(&self, values: &mut Values) {
        for it in &self.marks {
            let [x, y] = it.at.map(|it| format!("{it:.1}"));
            values.row([text(&self.kind), text(&it.area), x, y, text(&self.quantity), value(it.value)]);
        }
    }
}

#[cfg(test)]
mod tests;
