//! What holds of every recording that was cleaned.

use laneweave_recordings::{CleaningReport, Recording};

/// # Panics
/// If it is not clean.
pub fn check((recording, report): &(Recording, CleaningReport)) {
    for track in &recording.tracks {
        assert!(!track.states.is_empty());
        assert!(track.states.windows(2).all(|pair| pair[1].frame == pair[0].frame + 1), "frames are missing");
        let is_finite = |it: &f64| it.is_finite();
        assert!(track.states.iter().all(|it| [it.x, it.y, it.speed, it.heading].iter().all(is_finite)));
        assert!((0.1..=30.0).contains(&track.length) && (0.1..=4.0).contains(&track.width));
    }
    let states: usize = recording.tracks.iter().map(|it| it.states.len()).sum();
    assert!(states <= 4 * report.states);
    assert!(report.to_string().starts_with(&report.states.to_string()));
}
