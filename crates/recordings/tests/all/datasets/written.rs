//! Recordings written in the layouts of datasets.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use laneweave_recordings::{Recording, RoadUser, State, Track};

const FEET: f64 = 0.3048;

/// The rows of all tracks.
fn rows(recording: &Recording, mut row: impl FnMut(&mut String, &Track, &State)) -> String {
    let mut text = String::new();
    for track in &recording.tracks {
        for state in &track.states {
            row(&mut text, track, state);
        }
    }
    text
}

fn velocity(state: &State) -> (f64, f64) {
    (state.speed * state.heading.cos(), state.speed * state.heading.sin())
}

fn save(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, text).expect("it can be written");
    path
}

/// The files of highD: boxes in an image, in which y points down.
pub(crate) fn highd(recording: &Recording, folder: &Path) -> PathBuf {
    let mut meta = String::from("id,width,height,initialFrame,finalFrame,numFrames,class,drivingDirection\n");
    for it in &recording.tracks {
        let class = if it.class == RoadUser::Truck { "Truck" } else { "Car" };
        writeln!(meta, "{},{},{},1,2,2,{class},1", it.id, it.length, it.width).expect("it can be written");
    }
    save(folder, "01_tracksMeta.csv", &meta);
    let rate = 1.0 / recording.step;
    save(folder, "01_recordingMeta.csv", &format!("id,frameRate,locationId\n1,{rate},2\n"));
    let text = rows(recording, |text, track, it| {
        let (vx, vy) = velocity(it);
        let (x, y) = (it.x - track.length / 2.0, -it.y - track.width / 2.0);
        writeln!(
            text,
            "{},{},{x:.2},{y:.2},{:.2},{:.2},{vx:.2},{:.2},0,0,4",
            it.frame, track.id, track.length, track.width, -vy
        )
        .expect("it can be written");
    });
    let header = "frame,id,x,y,width,height,xVelocity,yVelocity,xAcceleration,yAcceleration,laneId\n";
    save(folder, "01_tracks.csv", &format!("{header}{text}"))
}

/// The files of inD, rounD and exiD.
pub(crate) fn ind(recording: &Recording, folder: &Path) -> PathBuf {
    let mut meta = String::from("recordingId,trackId,initialFrame,finalFrame,numFrames,width,length,class\n");
    for it in &recording.tracks {
        let class = if it.class == RoadUser::Truck { "truck_bus" } else { it.class.name() };
        writeln!(meta, "0,{},1,2,2,{},{},{class}", it.id, it.width, it.length).expect("it can be written");
    }
    save(folder, "00_tracksMeta.csv", &meta);
    let rate = 1.0 / recording.step;
    save(folder, "00_recordingMeta.csv", &format!("recordingId,locationId,frameRate\n0,1,{rate}\n"));
    let text = rows(recording, |text, track, it| {
        let (vx, vy) = velocity(it);
        let degrees = it.heading.to_degrees().rem_euclid(360.0);
        writeln!(
            text,
            "0,{},{},0,{:.5},{:.5},{degrees:.5},{:.5},{:.5},{vx:.5},{vy:.5}",
            track.id, it.frame, it.x, it.y, track.width, track.length
        )
        .expect("it can be written");
    });
    let header =
        "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length,xVelocity,yVelocity\n";
    save(folder, "00_tracks.csv", &format!("{header}{text}"))
}

/// The file of NGSIM: feet, the middle of the front, milliseconds since 1970.
pub(crate) fn ngsim(recording: &Recording, folder: &Path) -> PathBuf {
    let text = rows(recording, |text, track, it| {
        let (sin, cos) = it.heading.sin_cos();
        let (x, y) = (it.x + track.length / 2.0 * cos, it.y + track.length / 2.0 * sin);
        let class = if track.class == RoadUser::Truck { 3 } else { 2 };
        let time = 1_118_846_980_200 + (1000.0 * recording.step * it.frame as f64).round() as i64;
        writeln!(
            text,
            "{},{},437,{time},{:.3},{:.3},{:.3},{:.3},{class},{:.3},0,2,us-101",
            track.id,
            it.frame,
            x / FEET,
            y / FEET,
            track.length / FEET,
            track.width / FEET,
            it.speed / FEET
        )
        .expect("it can be written");
    });
    let header = "Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,v_Length,v_Width,v_Class,v_Vel,v_Acc,Lane_ID,Location\n";
    save(folder, "ngsim.csv", &format!("{header}{text}"))
}
