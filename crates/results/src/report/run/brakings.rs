//! Where vehicles brake hard, and what for.

use laneweave_sim::BrakingCause;

use super::RunReport;
use crate::report::{Align, Table, counted};

/// Maximum of places in the list.
const PLACES: usize = 10;

/// The places with most hard brakings.
pub(super) fn table(run: &RunReport) -> Table {
    use Align::{Numbers, Words};
    let places = run.record.brakings.worst(PLACES);
    let caption = format!("Hard brakings, beyond 4 m/s²: the {} places with most of them.", places.len());
    let mut table = Table::new(caption, &[("lanelet", Words), ("count", Numbers), ("for", Words)]);
    for (lanelet, counts) in places {
        let causes = BrakingCause::ALL.iter().zip(counts).filter(|(_, count)| *count > 0);
        let words: Vec<String> = causes.map(|(cause, count)| format!("{count} {}", cause.name())).collect();
        table.row([lanelet.to_string(), counted(counts.iter().sum()), words.join(", ")]);
    }
    table
}
