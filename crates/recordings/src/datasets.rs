//! The layouts of datasets that we know, and how to recognise them by the header of a table.
//!
//! Columns, units and frames are from the descriptions of the datasets: INTERACTION (Zhan et al. 2019), highD
//! (Krajewski et al. 2018), inD, rounD, exiD (Bock et al. 2020, Krajewski et al. 2020, Moers et al. 2022), NGSIM (US
//! DOT 2006).

use std::collections::BTreeMap;

use crate::recording::RoadUser;
use crate::table::{AngleUnit, Axes, Columns, Dialect, Fields, Layout, LengthUnit, Point, TimeUnit, Units};

/// A dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dataset {
    /// INTERACTION: one file.
    Interaction,
    /// highD: positions of boxes in an image; classes and frame rate in files beside it.
    HighD,
    /// inD, rounD or exiD: classes and frame rate in files beside it.
    InD,
    /// NGSIM: feet, ids that are used again.
    Ngsim,
}

/// The first columns of NGSIM's text files, which have no header.
const NGSIM_HEADER: &str = "Vehicle_ID Frame_ID Total_Frames Global_Time Local_X Local_Y Global_X Global_Y v_Length \
                            v_Width v_Class v_Vel";
/// The classes of NGSIM by their numbers.
const NGSIM_CLASSES: [(&str, RoadUser); 3] =
    [("1", RoadUser::Motorcycle), ("2", RoadUser::Car), ("3", RoadUser::Truck)];
const INTERACTION_CLASSES: [(&str, RoadUser); 8] = [
    ("car", RoadUser::Car),
    ("van", RoadUser::Car),
    ("truck", RoadUser::Truck),
    ("bus", RoadUser::Bus),
    ("motorcycle", RoadUser::Motorcycle),
    ("bicycle", RoadUser::Bicycle),
    ("pedestrian", RoadUser::Pedestrian),
    // The dataset does not distinguish these.
    ("pedestrian/bicycle", RoadUser::Other),
];

impl Dataset {
    /// All of them.
    pub const ALL: [Dataset; 4] = [Dataset::Interaction, Dataset::HighD, Dataset::InD, Dataset::Ngsim];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Dataset::Interaction => "INTERACTION",
            Dataset::HighD => "highD",
            Dataset::InD => "inD, rounD, exiD",
            Dataset::Ngsim => "NGSIM",
        }
    }

    /// The dataset whose columns a table has that begins with `start`; `None` if it is of none that we know.
    pub fn of_start(start: &[u8]) -> Option<Dataset> {
        Dialect::first_row(start, Dataset::of_row)?
    }

    fn of_row(first: &Fields) -> Option<Dataset> {
        let has = |name: &str| first.place(&[name]).is_some();
        // What sets a dataset apart from the others.
        let marks = |it: &Dataset| match it {
            Dataset::Interaction => has("track_id"),
            Dataset::HighD => has("xVelocity") && has("height") && has("id"),
            Dataset::InD => has("xCenter") && has("trackId"),
            Dataset::Ngsim => has("Vehicle_ID") && has("Local_X") || is_ngsim_without_header(first),
        };
        Dataset::ALL.into_iter().find(marks)
    }

    /// How its tables are read.
    pub fn layout(self) -> Layout {
        match self {
            Dataset::Interaction => interaction(),
            Dataset::HighD => highd(),
            Dataset::InD => ind(),
            Dataset::Ngsim => ngsim(),
        }
    }

    /// Whether the classes and the frame rate of its tables are in files beside them.
    pub fn has_other_files(self) -> bool {
        matches!(self, Dataset::HighD | Dataset::InD)
    }
}

/// Whether a row is one of the published text files: 18 numbers on motorways, 24 in towns.
fn is_ngsim_without_header(row: &Fields) -> bool {
    matches!(row.len(), 18 | 24)
        && row.iter().all(|it| str::from_utf8(it).is_ok_and(|it| it.parse::<f64>().is_ok()))
}

fn some(name: &str) -> Option<String> {
    Some(name.to_owned())
}

fn classes(of: &[(&str, RoadUser)]) -> BTreeMap<String, RoadUser> {
    of.iter().map(|(name, class)| ((*name).to_owned(), *class)).collect()
}

fn interaction() -> Layout {
    Layout {
        units: Units { time: TimeUnit::Milliseconds, ..Units::default() },
        // Tables of its challenges hold many short recordings.
        same: some("case_id"),
        classes: classes(&INTERACTION_CLASSES),
        ..Layout::of_columns(Columns {
            track: "track_id".into(),
            frame: some("frame_id"),
            time: some("timestamp_ms"),
            class: some("agent_type"),
            x: "x".into(),
            y: "y".into(),
            vx: some("vx"),
            vy: some("vy"),
            heading: some("psi_rad"),
            length: some("length"),
            width: some("width"),
            speed: None,
        })
    }
}

fn highd() -> Layout {
    Layout {
        point: Point::Corner,
        axes: Axes::YDown,
        frames_per_second: Some(25.0),
        ..Layout::of_columns(Columns {
            track: "id".into(),
            frame: some("frame"),
            x: "x".into(),
            y: "y".into(),
            vx: some("xVelocity"),
            vy: some("yVelocity"),
            // Of the box in the image, along the road.
            length: some("width"),
            width: some("height"),
            ..Columns::default()
        })
    }
}

fn ind() -> Layout {
    Layout {
        units: Units { angle: AngleUnit::Degrees, ..Units::default() },
        frames_per_second: Some(25.0),
        same: some("recordingId"),
        ..Layout::of_columns(Columns {
            track: "trackId".into(),
            frame: some("frame"),
            x: "xCenter".into(),
            y: "yCenter".into(),
            vx: some("xVelocity"),
            vy: some("yVelocity"),
            heading: some("heading"),
            length: some("length"),
            width: some("width"),
            ..Columns::default()
        })
    }
}

fn ngsim() -> Layout {
    /// A vehicle is on a site of 640 m for some minutes at most; its id is used again in the next quarter of an hour
    /// [s].
    const PAUSE: f64 = 30.0;
    Layout {
        units: Units { length: LengthUnit::Feet, time: TimeUnit::Milliseconds, ..Units::default() },
        point: Point::Front,
        frames_per_second: Some(10.0),
        reused_after_s: Some(PAUSE),
        same: some("Location"),
        header: Some(NGSIM_HEADER.split(' ').map(str::to_owned).collect()),
        classes: classes(&NGSIM_CLASSES),
        ..Layout::of_columns(Columns {
            track: "Vehicle_ID".into(),
            time: some("Global_Time"),
            class: some("v_Class"),
            x: "Local_X".into(),
            y: "Local_Y".into(),
            speed: some("v_Vel"),
            length: some("v_Length"),
            width: some("v_Width"),
            ..Columns::default()
        })
    }
}
