//! Writes track files.

use std::io::{self, Write};

use crate::recording::{Recording, RoadUser, Track};

/// The columns that are written.
const HEADER: &str = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width";

/// Writes a recording as a track file, numbers to the millimetre, as the dataset gives them.
///
/// # Errors
/// If `out` cannot be written to.
pub fn write(recording: &Recording, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{HEADER}")?;
    for track in &recording.tracks {
        write_track(track, &field(recording.name(track.id)), recording.step, out)?;
    }
    Ok(())
}

/// A text as a field: in quotes, if it would be another one without.
fn field(text: String) -> String {
    if text.contains(['"', ',', ';', '\t', '\r', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text
    }
}

fn write_track(track: &Track, id: &str, step: f64, out: &mut impl Write) -> io::Result<()> {
    let Track { length, width, .. } = track;
    let class = name(track.class);
    for state in &track.states {
        let time_ms = (state.frame as f64 * step * 1000.0).round() as i64;
        let (vx, vy) = (state.speed * state.heading.cos(), state.speed * state.heading.sin());
        writeln!(
            out,
            "{id},{},{time_ms},{class},{:.3},{:.3},{vx:.3},{vy:.3},{:.3},{length:.2},{width:.2}",
            state.frame, state.x, state.y, state.heading
        )?;
    }
    Ok(())
}

/// The dataset's name of a class; it has one name for pedestrians and cyclists together.
fn name(class: RoadUser) -> &'static str {
    match class {
        RoadUser::Other => "pedestrian/bicycle",
        class => class.name(),
    }
}
