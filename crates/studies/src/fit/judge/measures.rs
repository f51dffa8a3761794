//! What is measured of traffic, by name.

use laneweave_study::quantile;
use laneweave_study::units::{KMH_PER_MPS, SECONDS_PER_HOUR};

use super::tally::{CLASSES, OFFERED, Tally, rate};

/// A measure with its value.
pub(super) struct Measured {
    pub(super) key: String,
    /// Its name, with the unit.
    pub(super) name: String,
    /// None, if there was nothing to measure.
    pub(super) value: Option<f64>,
    /// What was counted, if it is a rate of counts.
    pub(super) count: Option<u32>,
}

impl Measured {
    fn of(key: &str, name: &str, value: Option<f64>) -> Measured {
        Measured { key: key.to_owned(), name: name.to_owned(), value, count: None }
    }

    /// A rate of lane changes.
    fn rate(key: String, name: String, changes: u32, metres: f64) -> Measured {
        Measured {
            key,
            name: format!("{name} [1/veh-km]"),
            value: rate(changes, metres),
            count: Some(changes),
        }
    }
}

/// What is measured, with the classes of density between these bounds [veh/km], for so many lanes.
pub(super) fn measured(tally: &Tally, thirds: [f64; CLASSES - 1], lanes: usize) -> Vec<Measured> {
    let mut all = rates(tally, lanes);
    all.extend(by_density(tally, thirds));
    all.extend(of_changes(tally));
    all.extend(of_offered_gaps(tally));
    all.extend(of_cut_ins(tally));
    all.extend(of_motion(tally));
    all
}

/// How often lanes are changed: all in all, by kind, and by lane.
fn rates(tally: &Tally, lanes: usize) -> Vec<Measured> {
    let [metres, _] = tally.exposure();
    let kinds =
        [("discretionary", "discretionary"), ("route", "for the route"), ("unknown", "of unknown kind")];
    let mut all = vec![Measured::rate("rate".into(), "lane changes".into(), tally.changes(), metres)];
    let of_kind = kinds.iter().zip(tally.kinds);
    all.extend(
        of_kind.map(|((key, name), it)| Measured::rate(format!("rate_{key}"), (*name).into(), it, metres)),
    );
    all.extend((0..lanes).map(|number| {
        let (metres, changes) = tally.lanes.get(number).copied().unwrap_or_default();
        let lane = number + 1;
        Measured::rate(format!("rate_lane_{lane}"), format!("from lane {lane}"), changes, metres)
    }));
    all
}

/// How often lanes are changed, how fast traffic is, and how much of it flows, by class of density.
fn by_density(tally: &Tally, [low, high]: [f64; CLASSES - 1]) -> Vec<Measured> {
    let names = [
        ("light", format!("below {low:.0} veh/km of lane")),
        ("middle", format!("{low:.0} to {high:.0} veh/km of lane")),
        ("dense", format!("from {high:.0} veh/km of lane on")),
    ];
    let classes = tally.by_density([low, high]);
    let each = || names.iter().zip(&classes);
    let rates = each()
        .map(|((key, name), it)| Measured::rate(format!("rate_{key}"), name.clone(), it.changes, it.metres));
    let speeds = each().map(|((key, name), it)| {
        let value = ratio(KMH_PER_MPS * it.metres, it.seconds);
        Measured::of(&format!("speed_{key}_kmh"), &format!("speed {name} [km/h]"), value)
    });
    let flows = each().map(|((key, name), it)| {
        let value = ratio(SECONDS_PER_HOUR * it.metres, it.area);
        Measured::of(&format!("flow_{key}_veh_per_h"), &format!("flow {name} [veh/h]"), value)
    });
    rates.chain(speeds).chain(flows).collect()
}

/// Gains, gaps and durations of lane changes.
fn of_changes(tally: &Tally) -> [Measured; 5] {
    let faster = tally.gains.iter().filter(|it| **it > 0.0).count() as f64;
    let half = |values: &[f64]| quantile(values, 0.5);
    [
        Measured::of(
            "faster_share_pct",
            "to the faster lane [%]",
            ratio(100.0 * faster, tally.gains.len() as f64),
        ),
        Measured::of("speed_gain_mps", "anticipated gain of speed, median [m/s]", half(&tally.gains)),
        Measured::of("lead_gap_m", "gap to the new leader, median [m]", half(&tally.gaps[0])),
        Measured::of("lag_gap_m", "gap to the new follower, median [m]", half(&tally.gaps[1])),
        Measured::of("duration_s", "duration of a change, median [s]", half(&tally.durations)),
    ]
}

/// P(accept | gap): the share of the gaps of each length that drivers took, at a look each second in the ten seconds
/// before their changes began. Who never changed lanes is not asked: whether it wanted to is not seen.
fn of_offered_gaps(tally: &Tally) -> impl Iterator<Item = Measured> {
    let [short, long] = OFFERED;
    let names = [
        ("short", format!("below {short:.0} m")),
        ("middle", format!("of {short:.0} to {long:.0} m")),
        ("long", format!("from {long:.0} m on")),
    ];
    let shares = tally.offered.map(|[offered, taken]| ratio(100.0 * f64::from(taken), f64::from(offered)));
    names.into_iter().zip(shares).map(|((key, name), share)| {
        Measured::of(&format!("accepted_{key}_pct"), &format!("gaps taken of those {name} [%]"), share)
    })
}

/// How near followers are before whom lanes are changed: most of them are not, so that medians say little.
fn of_cut_ins(tally: &Tally) -> [Measured; 3] {
    let most = |values: &[f64]| quantile(values, 0.95);
    [
        Measured::of(
            "headway_p5_s",
            "headway at a cut-in, 5 % have less [s]",
            quantile(&tally.headways, 0.05),
        ),
        Measured::of("inverse_ttc_p95", "1/TTC at a cut-in, 5 % have more [1/s]", most(&tally.inverse_times)),
        Measured::of(
            "drac_p95_mps2",
            "braking needed at a cut-in, 5 % more [m/s²]",
            most(&tally.needed_braking),
        ),
    ]
}

/// How fast traffic is.
fn of_motion(tally: &Tally) -> [Measured; 4] {
    let [metres, seconds] = tally.exposure();
    let pace = |share: f64| quantile(&tally.paces, share);
    [
        Measured::of("speed_kmh", "mean speed [km/h]", ratio(KMH_PER_MPS * metres, seconds)),
        Measured::of("pace_s_per_km", "travel time, median [s/km]", pace(0.5)),
        Measured::of("pace_p10_s_per_km", "travel time, a tenth take less [s/km]", pace(0.1)),
        Measured::of("pace_p90_s_per_km", "travel time, a tenth take more [s/km]", pace(0.9)),
    ]
}

fn ratio(of: f64, to: f64) -> Option<f64> {
    (to > 0.0).then(|| of / to)
}
