//! Lane changes: how often, what for, how long.

use laneweave::Fault;
use laneweave::maps::Law;
use laneweave::study::{Moments, mean};
use laneweave::style::Model;

use crate::experiments::drive::{between, drive, drive_all, over};
use crate::experiments::effort::Effort;
use crate::experiments::finding::Row;
use crate::experiments::measures::median;
use crate::experiments::motorway_rates::{rate, ratio, ratio_row};
use crate::experiments::plausibility::outcomes;
use crate::experiments::seen::Seen;
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// Flows [veh/h per lane].
const FLOWS: [f64; 5] = [300.0, 500.0, 700.0, 1100.0, 1500.0];
/// From this flow on the rate is asked for.
const BUSY: f64 = 700.0;

const RATES: &str = ".124 highD (lower bound), .225 US commuters (Olsen et al.), .5 (Knoop et al. 2012)";
const GAINS: &str = "1.65 m/s realised (Ahmed et al. 2022), 2 m/s wished (Vissim, m)";
const LAGS: &str = "26.6 uncongested, 13.9 congested (Hill 2015, m); the range is ours";
const DURATIONS: &str =
    "6.28, sd 2.0 (Olsen et al.), 5–6 (Toledo, Zohar 2007), lognormal (Wang, Li, Li 2014)";
const OURS: &str = "ours: what separates drivers from coins";

pub(super) fn rows(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let mut rows = Vec::new();
    for lanes in [2, 3] {
        let with = |model| FLOWS.map(|flow| Traffic { model, ..Traffic::on_motorway(lanes, flow) });
        let ours = drive(effort, &with(None))?;
        let mobil = drive(effort, &with(Some(Model::Mobil)))?;
        for (flow, (ours, mobil)) in FLOWS.iter().zip(ours.iter().zip(&mobil)) {
            let at = format!("{flow:.0} veh/h/lane on {lanes} lanes");
            if *flow >= BUSY {
                rows.extend(of_flow(&at, ours, mobil));
            }
            if lanes == 3 {
                rows.push(ratio_row(*flow, Law::UnitedStates, between(ours, mobil, ratio)));
            }
        }
    }
    rows.extend(four_lanes(effort)?);
    rows.extend(german_ratios(effort)?);
    rows.extend(signs(effort)?);
    rows.extend(durations(effort)?);
    Ok(rows)
}

/// Rate, gain and reversals on four lanes.
fn four_lanes(effort: &Effort) -> Result<[Row; 4], Fault> {
    const FLOW: f64 = 1100.0;
    let with = |model| Traffic { model, ..Traffic::on_motorway(4, FLOW) };
    let [ours, mobil] = &drive_all(effort, [None, Some(Model::Mobil)].map(with))?;
    Ok(of_flow(&format!("{FLOW:.0} veh/h/lane on 4 lanes"), ours, mobil))
}

/// The ratios of rates under the law of Germany, and what comes of changes there.
fn german_ratios(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let law = Law::Germany;
    let with = |model| FLOWS.map(|flow| Traffic { model, law, ..Traffic::on_motorway(3, flow) });
    let [ours, mobil] = [None, Some(Model::Mobil)].map(|model| drive(effort, &with(model)));
    let (ours, mobil) = (ours?, mobil?);
    let pairs = FLOWS.iter().zip(ours.iter().zip(&mobil));
    let mut rows: Vec<Row> =
        pairs.map(|(flow, (ours, mobil))| ratio_row(*flow, law, between(ours, mobil, ratio))).collect();
    let busy = FLOWS.iter().zip(&ours).filter(|(flow, _)| **flow >= BUSY);
    rows.extend(busy.flat_map(|(flow, ours)| outcomes::of_law(*flow, ours)));
    Ok(rows)
}

/// Rate, gain, gap and reversals at one flow.
fn of_flow(at: &str, ours: &[Seen], mobil: &[Seen]) -> [Row; 4] {
    [
        Row {
            what: format!("discretionary changes per veh-km, {at}"),
            unit: "1/veh-km",
            value: over(ours, rate),
            range: [0.2, 0.6],
            source: RATES,
        },
        Row {
            what: format!("anticipated gain of a discretionary change, {at}"),
            unit: "m/s",
            value: over(ours, |it| it.gains.estimate().map(|it| it.mean)),
            range: [1.0, 2.5],
            source: GAINS,
        },
        Row {
            what: format!("accepted gap to the new follower, median, {at}"),
            unit: "m",
            value: over(ours, |it| median(&it.gaps[1])),
            range: [13.0, 40.0],
            source: LAGS,
        },
        Row {
            what: format!("share reversed within 30 s, less MOBIL's, {at}"),
            unit: "points",
            value: between(ours, mobil, |ours, mobil| Some(100.0 * (reversed(ours)? - reversed(mobil)?))),
            range: [f64::NEG_INFINITY, 3.0],
            source: "MOBIL on the same traffic",
        },
    ]
}

/// Share of discretionary changes that are reversed.
fn reversed(seen: &Seen) -> Option<f64> {
    let all = seen.gains.estimate()?.replications;
    Some(f64::from(seen.reversed) / all as f64)
}

/// How many times as likely a desire is for a driver held up beside a free lane as on a free road.
fn held_up(seen: &Seen) -> Option<f64> {
    let it = &seen.counters;
    let chance = |desires: u64, all: u64| (all > 0).then(|| desires as f64 / all as f64);
    let free = chance(it.free_desires, it.free_considerations).filter(|it| *it > 0.0)?;
    Some(chance(it.held_up_desires, it.held_up_considerations)? / free)
}

/// The signs that separate drivers from coins, at 1,100 veh/h/lane on three lanes.
fn signs(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let with = |model| Traffic { model, ..Traffic::on_motorway(3, 1100.0) };
    let models = [None, Some(Model::ConstantHazard), Some(Model::Null)];
    let [ours, coin, null] = &drive_all(effort, models.map(with))?;
    let of_style = |seen: &Seen, style: &str| {
        seen.of_style.get(style).and_then(|(changes, km)| (*km > 0.0).then(|| f64::from(*changes) / km))
    };
    let by_style = |seen: &Seen| Some(of_style(seen, "aggressive")? - of_style(seen, "conservative")?);
    let difference = over(ours, by_style).map(|it| {
        // The least difference that the interval allows.
        laneweave::study::Estimate { mean: it.interval().lower, half_width: 0.0, ..it }
    });
    let row = |what: &str, unit, value, range| Row { what: what.into(), unit, value, range, source: OURS };
    let mut rows = vec![
        row(
            "desire when held up beside a free lane ÷ on a free road",
            "",
            over(ours, held_up),
            [3.0, f64::INFINITY],
        ),
        row("the same of a constant hazard", "", over(coin, held_up), [f64::NEG_INFINITY, 3.0]),
        row(
            "share of discretionary changes that gain speed",
            "%",
            over(ours, |it| Some(100.0 * f64::from(it.gaining) / it.gains.estimate()?.replications as f64)),
            [70.0, 100.0],
        ),
        row(
            "rate of aggressive less that of conservative drivers, lower end of the interval",
            "1/veh-km",
            difference,
            [0.0, f64::INFINITY],
        ),
        row("discretionary changes per veh-km without incentives", "1/veh-km", over(null, rate), [0.0, 0.02]),
    ];
    rows.extend(outcomes::beside_coin(ours, coin));
    Ok(rows)
}

/// Durations of free changes on a motorway, and of pressed ones before ramps.
fn durations(effort: &Effort) -> Result<Vec<Row>, Fault> {
    let ramps = Traffic {
        road: Road::Own("ramps.osm"),
        demand: Arriving::Total(4000.0),
        ..Traffic::on_motorway(3, 1100.0)
    };
    let [free, ramps] = &drive_all(effort, [Traffic::on_motorway(3, 1100.0), ramps])?;
    let of = |seen: &Seen, kind: usize| {
        let mut moments = Moments::default();
        seen.durations[kind].iter().for_each(|it| moments.add(*it));
        moments.estimate()
    };
    let skew = |seen: &Seen| {
        let logs: Vec<f64> = seen.durations[0].iter().map(|it| it.ln()).collect();
        let it = mean(&logs).filter(|it| it.replications > 2)?;
        let cube = |log: &f64| ((log - it.mean) / it.standard_deviation).powi(3);
        Some(logs.iter().map(cube).sum::<f64>() / logs.len() as f64)
    };
    let row = |what: &str, unit, value, range, source| Row { what: what.into(), unit, value, range, source };
    Ok(vec![
        row(
            "duration of a discretionary change",
            "s",
            over(free, |it| of(it, 0).map(|it| it.mean)),
            [5.0, 6.0],
            DURATIONS,
        ),
        row(
            "its standard deviation",
            "s",
            over(free, |it| of(it, 0).map(|it| it.standard_deviation)),
            [1.5, 2.5],
            DURATIONS,
        ),
        row("skewness of its logarithm, 0 if lognormal", "", over(free, skew), [-0.5, 0.5], DURATIONS),
        row(
            "duration of a route-driven change before ramps, as a share of that of a discretionary one there",
            "",
            over(ramps, |it| Some(of(it, 1)?.mean / of(it, 0)?.mean)),
            [0.5, 1.0],
            "shorter when pressed; ours",
        ),
    ])
}
