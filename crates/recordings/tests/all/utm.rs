//! Positions from an origin in UTM come to where they are on the map.

use std::fs;

use laneweave_recordings::{Recording, State, Track, open};

use crate::datasets::{folder, ind, motorway};

/// A place in Aachen, and where it is in zone 32 by another computation of the series [m].
const PLACE: (f64, f64) = (50.78, 6.07);
const UTM: [f64; 2] = [293_450.315, 5_629_453.669];

#[test]
fn positions_are_moved_to_the_origin_of_the_map() {
    let folder = folder("utm");
    let written = motorway(0.04);
    let path = ind(&written, &folder);
    let [x, y] = [UTM[0] + 120.5, UTM[1] - 30.25];
    let meta = format!("recordingId,frameRate,xUtmOrigin,yUtmOrigin\n0,25,{x},{y}\n");
    fs::write(folder.join("00_recordingMeta.csv"), meta).expect("it can be written");
    let (mut recording, _) = open(&path, None).expect("it is sound");
    assert_eq!(recording.utm_origin, Some([x, y]));
    let before = recording.clone();
    recording.place(None);
    assert_eq!(recording, before, "a map in metres of its own");
    recording.place(Some(PLACE));
    recording.place(Some(PLACE));
    let first =
        |it: &Recording| -> State { it.tracks.first().map(|it: &Track| it.states[0]).expect("it has some") };
    let (from, to) = (first(&before), first(&recording));
    assert!((to.x - from.x - 120.5).abs() < 0.01 && (to.y - from.y + 30.25).abs() < 0.01, "{from:?} {to:?}");
}
