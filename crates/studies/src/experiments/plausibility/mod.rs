//! Are these drivers plausible? What they do, beside published values.

mod bends;
mod capacity;
mod changes;
mod courtesy;
mod cut_ins;
mod following;
mod lanes;
mod lights;
mod outcomes;
mod safety;
mod speeds;

use laneweave::Fault;

use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, csv_of, table_of};

/// Measures everything.
pub(crate) fn plausibility(effort: &Effort) -> Result<Finding, Fault> {
    let cut_ins = cut_ins::cut_ins_beside_recorded(effort)?;
    let rows = [
        changes::rows(effort)?,
        lanes::rows(effort)?,
        speeds::rows(effort)?,
        following::rows(effort)?,
        capacity::rows(effort)?,
        lights::rows(effort)?,
        bends::rows(effort)?,
        courtesy::rows(effort)?,
        safety::rows(effort)?,
        cut_ins.rows,
    ]
    .concat();
    let text = format!(
        "# Are these drivers plausible?\n\n\
         What the drivers that come with laneweave do, beside published values. Every value is a mean over {} seeds with its 95 % \
         interval. It is inside if the mean is in the range. Sources marked *m* are cited from memory. Ranges without a source are \
         ours.\n\n{}\n## Cut-ins\n\n\
         A cut-in is a lane change before a follower within 4 s. Simulated and recorded traffic were watched in the same way.\n\n{}",
        effort.seeds,
        table_of(&rows),
        cut_ins.table
    );
    Ok(Finding { text, tables: vec![("plausibility".into(), csv_of(&rows))], figures: Vec::new(), rows })
}
