//! Density, flow and speed.

use laneweave_study::units::KMH_PER_MPS;
use laneweave_study::{EdieRow, Scattered, Sheet, scatter};

use super::{NOBODY, RunReport};
use crate::report::classes::{CLASS, LEAST_BOXES, means};
use crate::report::{Figure, Section, counted};

/// Classes of roads by speed limit [km/h]: streets, main roads, motorways; ours.
const LIMITS: [(f64, &str); 3] = [
    (40.0, "speed limit up to 40 km/h"),
    (75.0, "speed limit 40 to 75 km/h"),
    (f64::INFINITY, "speed limit above 75 km/h"),
];

pub(super) fn section(run: &RunReport) -> Section {
    let section = Section::new("flow", "Density, flow and speed");
    let boxes = &run.record.boxes;
    let rows: Vec<EdieRow> = boxes.rows(run.end).filter(|it| it.density_veh_per_km > 0.0).collect();
    if rows.is_empty() {
        return section.text(NOBODY);
    }
    let figure = |label: &str, title: &str, definition: &str, value: &dyn Fn(&EdieRow) -> f64| {
        let point = |it: &EdieRow| [it.density_veh_per_km, value(it)];
        let groups = grouped(rows.iter().map(|it| (KMH_PER_MPS * boxes.limit(it.section), point(it))));
        let drawn = scatter(Sheet::Column, ["Density [veh/km per lane]", label], &groups);
        Figure { drawn, title: title.into(), caption: caption(&groups, definition) }
    };
    section.figures(vec![
        figure(
            "Flow [veh/h per lane]",
            "Fundamental diagram: flow against density",
            "k = Σt/(LT), q = Σd/(LT), with the times t and distances d of all vehicles in a box of L metres of lane and T seconds",
            &|it| it.flow_veh_per_h,
        ),
        figure("Speed [km/h]", "Speed against density", "v = Σd/Σt, the space-mean speed", &|it| {
            it.speed_mps.map_or(f64::NAN, |it| it * KMH_PER_MPS)
        }),
    ])
}

/// Points by the class of speed limit of their roads [km/h], if there are any.
fn grouped(points: impl Iterator<Item = (f64, [f64; 2])>) -> Vec<Scattered> {
    let mut groups = LIMITS.map(|(_, name)| Scattered { name: name.into(), points: vec![], means: vec![] });
    for (limit, point) in points {
        let group = LIMITS.iter().position(|(most, _)| limit <= *most).unwrap_or(LIMITS.len() - 1);
        groups[group].points.push(point);
    }
    for group in &mut groups {
        group.means = means(&group.points);
    }
    groups.into_iter().filter(|it| !it.points.is_empty()).collect()
}

fn caption(groups: &[Scattered], definition: &str) -> String {
    let number = |it: &Scattered| (it.name.clone(), counted(it.points.len() as u64));
    let boxes: Vec<String> = match groups {
        [only] => vec![format!("{} boxes", number(only).1)],
        several => {
            several.iter().map(number).map(|(name, count)| format!("{count} boxes with {name}")).collect()
        }
    };
    format!(
        "Edie's definitions in boxes of about 500 m of all parallel lanes and 60 s: {definition}; vehicles are sampled once a \
         second. Small points are the boxes that are not empty, stronger where several coincide: n = {}. Large points are means over \
         classes of {CLASS} veh/km with at least {LEAST_BOXES} boxes, with Student's 95 % intervals over boxes. Neighbouring boxes \
         are correlated, so the intervals are somewhat too narrow.",
        boxes.join(", ")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roads_are_grouped_by_their_limits() {
        let groups = grouped([(30.0, [1.0, 1.0]), (120.0, [2.0, 2.0]), (40.0, [3.0, 3.0])].into_iter());
        let sizes: Vec<(&str, usize)> = groups.iter().map(|it| (it.name.as_str(), it.points.len())).collect();
        assert_eq!(sizes, [(LIMITS[0].1, 2), (LIMITS[2].1, 1)]);
    }
}
