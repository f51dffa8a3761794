//! Density, flow and speed.

use std::collections::BTreeMap;

use laneweave_study::{EdieRow, Estimated, Moments, Sheet, TimeLine, over_time, scatter};

use super::{NOBODY, RunReport};
use crate::report::{Figure, Section};
use crate::units::KMH_PER_MPS;

/// Width of the classes of density over which means are taken [veh/km].
const CLASS: f64 = 5.0;
/// A mean of fewer boxes is not drawn.
const LEAST_BOXES: usize = 3;

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("flow", "Density, flow and speed");
    let rows: Vec<EdieRow> =
        run.record.boxes.rows(run.end).filter(|it| it.density_veh_per_km > 0.0).collect();
    let mut figures = Vec::new();
    if !rows.is_empty() {
        figures.extend([flow(&rows), speed(&rows)]);
    }
    if run.record.crowd.counts.iter().any(|(_, on_road, waiting)| on_road + waiting > 0) {
        figures.push(crowd(run));
    }
    if figures.is_empty() {
        return section.text(NOBODY);
    }
    section.figures(figures)
}

fn flow(rows: &[EdieRow]) -> Figure {
    let labels = ["density [veh/km per lane]", "flow [veh/h per lane]"];
    let points: Vec<[f64; 2]> = rows.iter().map(|it| [it.density_veh_per_km, it.flow_veh_per_h]).collect();
    Figure {
        svg: scatter(Sheet::Column, labels, (BOXES, &points), (MEANS, &means(&points))),
        title: "Fundamental diagram: flow against density".into(),
        caption: caption(
            rows.len(),
            "k = Σt/(LT), q = Σd/(LT), with the times t and ways d of all vehicles in a box of L metres of lane and T seconds",
        ),
    }
}

fn speed(rows: &[EdieRow]) -> Figure {
    let labels = ["density [veh/km per lane]", "speed [km/h]"];
    let place = |it: &EdieRow| Some([it.density_veh_per_km, it.speed_mps? * KMH_PER_MPS]);
    let points: Vec<[f64; 2]> = rows.iter().filter_map(place).collect();
    Figure {
        svg: scatter(Sheet::Column, labels, (BOXES, &points), (MEANS, &means(&points))),
        title: "Speed against density".into(),
        caption: caption(points.len(), "v = Σd/Σt, the space-mean speed"),
    }
}

const BOXES: &str = "boxes";
const MEANS: &str = "means";

fn caption(boxes: usize, definition: &str) -> String {
    format!(
        "Edie's definitions in boxes of about 500 m of all parallel lanes and 60 s: {definition}; seen once a second. n = {boxes} \
         boxes with anybody in them; those at the same point are darker. Means over classes of {CLASS} veh/km with Student's \
         95 % intervals over boxes, from {LEAST_BOXES} boxes on; neighbouring boxes are alike, so the intervals are rather \
         too narrow. Sections of different roads, limits and lights are mixed."
    )
}

/// Means of the second values over classes of the first ones.
fn means(points: &[[f64; 2]]) -> Vec<Estimated> {
    let mut classes: BTreeMap<u64, [Moments; 2]> = BTreeMap::new();
    for point in points {
        let class = classes.entry((point[0] / CLASS) as u64).or_default();
        class.iter_mut().zip(point).for_each(|(moments, value)| moments.add(*value));
    }
    let estimates = classes.into_values().filter_map(|it| Some((it[0].estimate()?, it[1].estimate()?)));
    let enough = estimates.filter(|(_, it)| it.replications >= LEAST_BOXES);
    enough.map(|(at, it)| Estimated { at: at.mean, value: it.mean, interval: it.interval() }).collect()
}

fn crowd(run: &RunReport) -> Figure {
    let counts = &run.record.crowd.counts;
    let line = |name: &str, count: fn(&(f64, usize, usize)) -> usize| TimeLine {
        name: name.into(),
        points: counts.iter().map(|it| [it.0, count(it) as f64]).collect(),
    };
    let lines = [line("on the road", |it| it.1), line("waiting at the entrances", |it| it.2)];
    Figure {
        svg: over_time(Sheet::Column, "vehicles [number]", &lines),
        title: "Vehicles in the course of time".into(),
        caption: format!(
            "Vehicles on the road, and those that have arrived and find no room yet, at {} times. While the numbers still grow, \
             means over the run are those of no steady traffic.",
            counts.len()
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_taken_over_classes_with_enough_boxes() {
        let points = [[1.0, 10.0], [2.0, 20.0], [3.0, 30.0], [6.0, 40.0], [7.0, 50.0]];
        let means = means(&points);
        assert_eq!(means.len(), 1);
        assert_eq!((means[0].at, means[0].value), (2.0, 20.0));
        // t₂ s/√3 = 4.302653 · 10/1.732051
        assert!((means[0].interval.upper - 44.841377).abs() < 1e-6);
    }
}
