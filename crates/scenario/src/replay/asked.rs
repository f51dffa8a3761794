//! What a scenario asks of a replay: whether it makes sense, and who is to become a driver.

use std::collections::BTreeSet;

use laneweave_recordings::{Matched, Recording};
use laneweave_sim::{Purpose, Random};

use super::part;
use crate::fault::Fault;
use crate::recording::elsewhere;
use crate::scenario::{LONGEST, Origin, Replay, Scenario};

/// The seed of the random numbers that choose who reacts. It is always the same: so the same vehicles react whatever
/// the seed of the run.
const CHOICE: u64 = 1;

/// The ids of the vehicles that are to become drivers.
pub(super) fn chosen(
    recording: &Recording,
    replay: &Replay,
    origin: &Origin,
) -> Result<BTreeSet<i64>, Fault> {
    let vehicles: BTreeSet<i64> =
        recording.tracks.iter().filter(|it| it.class.is_vehicle()).map(|it| it.id).collect();
    if let Some(unknown) = replay.reactive_ids.iter().find(|it| !vehicles.contains(it)) {
        let known = |id: &i64| match recording.names.get(id) {
            Some(name) => format!("{id} ({name})"),
            None => id.to_string(),
        };
        let known: Vec<String> = vehicles.iter().take(10).map(known).collect();
        let place = origin.place(&["replay", "reactive_ids"]);
        let what = format!("the recording has no motor vehicle {unknown}");
        return Err(Fault::new(
            place,
            what,
            format!("choose among its vehicles, such as {}", known.join(", ")),
        ));
    }
    if !replay.reactive_ids.is_empty() {
        return Ok(replay.reactive_ids.iter().copied().collect());
    }
    let random = Random::new(CHOICE);
    let draw = |it: &i64| random.uniform(part::subject(*it), Purpose::Reaction, 0);
    Ok(vehicles.into_iter().filter(|it| draw(it) < replay.reactive_share).collect())
}

/// Checks the numbers of a replay.
pub(super) fn check_numbers(replay: &Replay, origin: &Origin) -> Result<(), Fault> {
    let check = |key, what: &str, value: f64, to: f64, unit: &str| {
        if (0.0..=to).contains(&value) {
            return Ok(());
        }
        let place = origin.place(&["replay", key]);
        Err(Fault::new(place, format!("{what} of {value}{unit}"), format!("choose 0 to {to}{unit}")))
    };
    check("reactive_share", "a share", replay.reactive_share, 1.0, "")?;
    check("reactive_from_s", "a time", replay.reactive_from_s, LONGEST, " s")?;
    if replay.reactive_share > 0.0 && !replay.reactive_ids.is_empty() {
        let place = origin.place(&["replay", "reactive_ids"]);
        return Err(Fault::new(place, "ids and a share of the vehicles that react", "give only one of them"));
    }
    let is_reactive = replay.reactive_share > 0.0 || !replay.reactive_ids.is_empty();
    if is_reactive && !replay.is_asked() {
        let place = origin.place(&["replay"]);
        return Err(Fault::new(
            place,
            "vehicles that react, of no recording",
            "name it: recording = [\"FILE\"]",
        ));
    }
    Ok(())
}

/// Checks that the recording is one of the place of the map.
pub(super) fn check_place(matched: &Matched, scenario: &Scenario) -> Result<(), Fault> {
    let (states, unmatched) = matched.count_states();
    if 2 * unmatched <= states {
        return Ok(());
    }
    let problem = elsewhere(matched.recording, matched.network);
    Err(Fault::new(scenario.map.display(), problem.what, problem.remedy))
}
