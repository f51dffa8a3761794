//! What is drawn: the ground, the roads with their lines, the lights, the vehicles.

use laneweave::{LightState, Side};
use tiny_skia::{
    Color, FillRule, LineCap, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash, Transform,
};

use super::camera::Sight;
use crate::scene::Scene;
use crate::snapshot::{Seen, Snapshot};

/// Colours as red, green and blue.
type Rgb = [u8; 3];

const GROUND: Rgb = [206, 215, 196];
const ROAD: Rgb = [92, 96, 104];
/// Lanes for some vehicles only, such as buses.
const RESTRICTED: Rgb = [122, 84, 78];
const WHITE: Rgb = [240, 240, 236];
const GREY: Rgb = [150, 150, 150];
const GLASS: Rgb = [38, 46, 58];
const RED: Rgb = [213, 43, 30];
const AMBER: Rgb = [255, 176, 0];
const GREEN: Rgb = [0, 158, 115];
/// Styles, in colours that the colour-blind can tell apart (Okabe, Ito 2008).
const STYLES: [Rgb; 7] = [
    [0, 114, 178],
    [230, 159, 0],
    [0, 158, 115],
    [204, 121, 167],
    [86, 180, 233],
    [213, 94, 0],
    [240, 228, 66],
];

/// Width of a line on the road [m], and of a broad one.
const LINE: f64 = 0.15;
const BROAD: f64 = 0.3;
/// Lines that would be thinner than this are left out [px].
const VISIBLE: f64 = 0.25;

fn paint(colour: Rgb) -> Paint<'static> {
    let [red, green, blue] = colour;
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, 255);
    paint.anti_alias = true;
    paint
}

/// Fills the picture with the ground.
pub(super) fn ground(canvas: &mut Pixmap) {
    let [red, green, blue] = GROUND;
    canvas.fill(Color::from_rgba8(red, green, blue, 255));
}

/// The path along the points of lines of a scene, one after the other.
fn path<'a>(sight: &Sight, points: impl Iterator<Item = &'a [f64]>, is_closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for point in points {
        let [x, y] = sight.pixel(point[0], point[1]);
        if builder.is_empty() { builder.move_to(x, y) } else { builder.line_to(x, y) }
    }
    if is_closed {
        builder.close();
    }
    builder.finish()
}

fn stroke(canvas: &mut Pixmap, sight: &Sight, line: &[f64], colour: Rgb, width: f64, dash: Option<[f64; 2]>) {
    let pixels = sight.scale * width;
    if pixels < VISIBLE {
        return;
    }
    let dash = dash.and_then(|it| StrokeDash::new(it.map(|it| (sight.scale * it) as f32).to_vec(), 0.0));
    let stroke = Stroke { width: pixels as f32, line_cap: LineCap::Butt, dash, ..Stroke::default() };
    if let Some(path) = path(sight, line.chunks_exact(3), false) {
        canvas.stroke_path(&path, &paint(colour), &stroke, Transform::identity(), None);
    }
}

/// Surfaces, crosswalks and lines.
pub(super) fn roads(canvas: &mut Pixmap, sight: &Sight, scene: &Scene) {
    let [road, restricted] = [ROAD, RESTRICTED].map(paint);
    for lanelet in &scene.lanelets {
        let surface = if lanelet.only_for.is_some() { &restricted } else { &road };
        let outline = lanelet.left.chunks_exact(3).chain(lanelet.right.chunks_exact(3).rev());
        if let Some(path) = path(sight, outline, true) {
            canvas.fill_path(&path, surface, FillRule::Winding, Transform::identity(), None);
        }
    }
    for crosswalk in &scene.crosswalks {
        stroke(canvas, sight, crosswalk, WHITE, LINE, Some([0.5, 0.5]));
    }
    for marking in &scene.markings {
        let width = if marking.is_thick { BROAD } else { LINE };
        let (colour, dash) = match marking.paint {
            "virtual" => continue,
            "dashed" | "dashed_dashed" => (WHITE, Some([3.0, 6.0])),
            "curb" | "barrier" | "edge" => (GREY, None),
            _ => (WHITE, None),
        };
        stroke(canvas, sight, &marking.line, colour, width, dash);
    }
}

/// Stop lines, those of lights in the colour that they show.
pub(super) fn lights(canvas: &mut Pixmap, sight: &Sight, scene: &Scene, snapshot: &Snapshot) {
    /// Width of a stop line, and of that of a light, which is seen from afar [m].
    const WIDTHS: [f64; 2] = [0.4, 1.0];
    for stop in &scene.stop_lines {
        let shown = stop.light.and_then(|it| snapshot.lights.get(it));
        let (colour, width) = match shown {
            None => (WHITE, WIDTHS[0]),
            Some(LightState::Green) => (GREEN, WIDTHS[1]),
            Some(LightState::Yellow) => (AMBER, WIDTHS[1]),
            Some(LightState::Red) => (RED, WIDTHS[1]),
        };
        stroke(canvas, sight, &stop.line, colour, width, None);
    }
}

/// A vehicle with its windscreen, its brake lights and its indicators.
pub(super) fn vehicle(canvas: &mut Pixmap, sight: &Sight, it: &Seen) {
    /// Length of a windscreen and of a lamp [m].
    const GLASS_LENGTH: f32 = 0.9;
    const LAMP: f32 = 0.35;
    let place = sight.body(it);
    let (length, width) = (it.length as f32, it.width as f32);
    let mut fill = |from: [f32; 2], size: [f32; 2], colour: Rgb| {
        if let Some(rect) = Rect::from_xywh(from[0], from[1], size[0], size[1]) {
            let path = PathBuilder::from_rect(rect);
            canvas.fill_path(&path, &paint(colour), FillRule::Winding, place, None);
        }
    };
    let (rear, right) = (-length / 2.0, -width / 2.0);
    let colour = if it.is_recorded { GREY } else { STYLES[usize::from(it.style) % STYLES.len()] };
    fill([rear, right], [length, width], colour);
    let glass = (length / 4.0).min(GLASS_LENGTH);
    fill([length / 2.0 - 2.0 * glass, right + 0.1 * width], [glass, 0.8 * width], GLASS);
    if it.is_external {
        // Who is driven by a user has a bar across the roof.
        fill([-glass / 2.0, right], [glass / 2.0, width], WHITE);
    }
    let lamp = LAMP.min(length / 4.0);
    let left_lamp = width / 2.0 - 0.25 * width;
    if it.is_braking {
        fill([rear, right], [lamp, 0.25 * width], RED);
        fill([rear, left_lamp], [lamp, 0.25 * width], RED);
    }
    if let Some(side) = it.signals {
        let across = if side == Side::Left { left_lamp } else { right };
        fill([rear, across], [lamp, 0.25 * width], AMBER);
        fill([length / 2.0 - lamp, across], [lamp, 0.25 * width], AMBER);
    }
}
