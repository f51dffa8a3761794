//! Vehicles that touched each other: the first incidents, and the remedy.

use laneweave_sim::Incident;
use laneweave_study::seconds;
use laneweave_study::units::KMH_PER_MPS;

use super::RunReport;
use crate::report::{Align, Table, counted};

/// Collisions and overlaps among the problems, each with their number and the remedy.
pub(super) fn problems(run: &RunReport) -> Vec<(&'static str, String, String)> {
    let first = run.summary.first_incident.map_or(String::new(), |it| format!("first {}; ", it.to_text()));
    let kinds = [
        (
            run.summary.collisions,
            "Collisions",
            "this should not happen: report it with the map, the command and the seed",
        ),
        (
            run.summary.overlaps,
            "Overlaps of two vehicles",
            "check there whether lanes of the map overlap without being connected (laneweave check); if not, report it with the map, the command and the seed",
        ),
    ];
    let found = kinds.into_iter().filter(|(count, ..)| *count > 0);
    let problem = |(count, what, remedy)| {
        (what, counted(count), format!("{first}the table incidents lists all of them; {remedy}"))
    };
    found.map(problem).collect()
}

/// The first incidents.
pub(super) fn table(run: &RunReport) -> Table {
    use Align::{Numbers, Words};
    let (listed, all) = (run.record.incidents.len(), run.summary.incidents);
    let caption = format!("Incidents: the first {listed} of {}, as in the table incidents.", counted(all));
    let columns = [
        ("time [s]", Numbers),
        ("kind", Words),
        ("lanelets", Words),
        ("vehicles", Words),
        ("speeds [km/h]", Words),
        ("depth [m]", Numbers),
    ];
    let mut table = Table::new(caption, &columns);
    for incident in &run.record.incidents {
        table.row(row(run, incident));
    }
    table
}

fn row(run: &RunReport, incident: &Incident) -> [String; 6] {
    let &Incident { kind, time, vehicles: [one, other], places, speeds, depth, .. } = incident;
    let [here, there] = places.map(|it| run.network.lanelet_at(it).0.id);
    let [speed, other_speed] = speeds.map(|it| it * KMH_PER_MPS);
    [
        seconds(time).to_string(),
        kind.name().into(),
        format!("{here} and {there}"),
        format!("{one} and {other}"),
        format!("{speed:.1} and {other_speed:.1}"),
        format!("{depth:.2}"),
    ]
}
