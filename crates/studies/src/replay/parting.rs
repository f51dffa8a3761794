//! How far reactive drivers part from what was recorded of them.

use std::collections::BTreeMap;

use serde::Serialize;

use super::trace::Trace;

/// A speed that differs by more has parted [m/s].
const PARTED: f64 = 2.0;
/// Within this time [s].
const WITHIN: f64 = 5.0;
/// Times at which differences are told [s].
const TIMES: [f64; 10] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0];

/// How far reactive drivers part from their records.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Parting {
    /// Reactive drivers that were recorded for 5 s or more, over all rollouts.
    pub drivers: usize,
    /// Share of them whose speed parts by more than 2 m/s within 5 s.
    pub parted_share: f64,
    /// The differences after some times.
    pub after: Vec<PartedAfter>,
}

/// The mean differences of reactive drivers after some time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PartedAfter {
    /// Time since they became drivers [s].
    pub time_s: f64,
    /// Drivers that were recorded so long, over all rollouts.
    pub drivers: usize,
    /// Mean absolute difference of the speeds [m/s].
    pub speed_mps: f64,
    /// Mean distance between the places [m].
    pub distance_m: f64,
    /// Mean distance of the recorded places from where the same vehicles would be at constant speed, straight on [m].
    pub constant_speed_m: f64,
}

impl Parting {
    /// How far the drivers of `rollouts` part from `record`, in steps of `dt` [s].
    pub(super) fn of(record: &BTreeMap<i64, Trace>, rollouts: &[BTreeMap<i64, Trace>], dt: f64) -> Parting {
        let pairs: Vec<(&Trace, &Trace)> = rollouts
            .iter()
            .flat_map(|it| it.iter().filter_map(|(id, trace)| Some((record.get(id)?, trace))))
            .collect();
        let steps = |time: f64| (time / dt).round() as usize;
        let long = pairs.iter().filter(|(record, _)| record.samples.len() > steps(WITHIN));
        let (mut drivers, mut parted) = (0, 0);
        for (record, driven) in long {
            drivers += 1;
            let both = record.samples.iter().zip(&driven.samples).take(steps(WITHIN) + 1);
            parted += usize::from(both.into_iter().any(|(a, b)| (a.speed - b.speed).abs() > PARTED));
        }
        let parted_share = if drivers == 0 { 0.0 } else { parted as f64 / drivers as f64 };
        let after = TIMES.iter().filter_map(|time| after(&pairs, *time, steps(*time))).collect();
        Parting { drivers, parted_share, after }
    }
}

fn after(pairs: &[(&Trace, &Trace)], time_s: f64, step: usize) -> Option<PartedAfter> {
    let both =
        pairs.iter().filter_map(|(a, b)| Some((a.samples.get(step)?, b.samples.get(step)?, &a.samples[0])));
    let (mut drivers, mut speed, mut distance, mut constant) = (0, 0.0, 0.0, 0.0);
    for (a, b, first) in both {
        drivers += 1;
        speed += (a.speed - b.speed).abs();
        distance += apart(a.at, b.at);
        let (sin, cos) = first.heading.sin_cos();
        let way = first.speed * time_s;
        constant += apart(a.at, [first.at[0] + way * cos, first.at[1] + way * sin]);
    }
    let count = drivers as f64;
    (drivers > 0).then(|| PartedAfter {
        time_s,
        drivers,
        speed_mps: speed / count,
        distance_m: distance / count,
        constant_speed_m: constant / count,
    })
}

fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
