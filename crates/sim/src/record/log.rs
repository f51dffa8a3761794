//! All that is remembered of a run.

use serde::{Deserialize, Serialize};

use crate::record::counts::Counts;
use crate::record::events::Event;
use crate::record::incidents::Touching;
use crate::record::journal::Journal;
use crate::record::ledger::Ledger;
use crate::record::records::Records;
use crate::record::trips::Trips;

/// Changes under way, trips, counts and incidents.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Log {
    pub(crate) records: Records,
    pub(crate) trips: Trips,
    /// Where trips are recorded.
    pub(crate) journal: Option<Journal>,
    /// There too, what happens on the lanelets.
    pub(crate) ledger: Option<Ledger>,
    /// What happened in the last step.
    #[serde(skip)]
    pub(crate) events: Vec<Event>,
    /// Who touches whom.
    pub(crate) touching: Touching,
    /// Whether it is looked for overlaps at every step.
    #[serde(skip)]
    pub(crate) is_audited: bool,
    pub(crate) counts: Counts,
}
