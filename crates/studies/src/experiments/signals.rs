//! The delay at a light beside Webster's formula.

use laneweave::study::{Estimated, Interval, Sheet, Signal, estimates};
use laneweave::{Event, Fault, Simulation};

use crate::experiments::drive::{between, each, over, steps};
use crate::experiments::effort::Effort;
use crate::experiments::finding::{Finding, Row, cells_of, csv_of, table_of};
use crate::experiments::traffic::{Arriving, Road, Traffic};

/// The approach from the west, and the exit straight on: their smallest lanelet ids.
const STRAIGHT_ON: [&str; 2] = ["1", "79"];
/// Length of a cycle, greens, and a green that does not end [s].
const CYCLE: f64 = 60.0;
const GREENS: [f64; 2] = [20.0, 30.0];
const LASTING: f64 = 3590.0;
/// Greens with which the saturation flow is measured [s].
const MEASURED_AT: [f64; 2] = [20.0, 40.0];
/// A demand beyond saturation [veh/h].
const TOO_MUCH: f64 = 1500.0;
/// Degrees of saturation, and how far the delay may be from Webster's, where this is judged.
const SATURATIONS: [(f64, Option<f64>); 4] =
    [(0.3, None), (0.5, Some(0.1)), (0.7, Some(0.1)), (0.9, Some(0.15))];
/// Simulated time before anything is measured, and measured time [s].
const TIMES: [f64; 2] = [300.0, 3200.0];

/// What a run measured.
#[derive(Clone, Copy)]
struct Measured {
    /// Vehicles that completed their trip [veh/h].
    flow: f64,
    /// Mean time of a trip [s].
    duration: f64,
}

/// Cars that go straight on through a light with this green in each cycle [s].
fn traffic(green: f64, flow: f64) -> Traffic {
    let cycle = if green < CYCLE { CYCLE } else { green + 20.0 };
    Traffic {
        road: Road::Crossing { cycle, green },
        demand: Arriving::Between(vec![(STRAIGHT_ON, flow)]),
        trucks: 0.0,
        times: TIMES,
        ..Traffic::on_motorway(1, 0.0)
    }
}

fn measure(simulation: &mut Simulation) -> Measured {
    let mut durations = Vec::new();
    steps(simulation, |_, events| {
        durations.extend(events.iter().filter_map(|it| match it {
            Event::Completed { duration_s, .. } => Some(*duration_s),
            _ => None,
        }));
    });
    let [_, measured] = simulation.run_steps();
    let count = durations.len() as f64;
    let flow = 3600.0 * count / (f64::from(measured) * simulation.step_s());
    Measured { flow, duration: durations.iter().sum::<f64>() / count.max(1.0) }
}

/// The saturation flow [veh/h], and how much shorter the effective green is than the green [s].
fn saturation(effort: &Effort) -> Result<[f64; 2], Fault> {
    let runs = each(effort, &MEASURED_AT.map(|it| traffic(it, TOO_MUCH)), measure)?;
    let mean = |runs: &[Measured]| over(runs, |it| Some(it.flow)).map_or(0.0, |it| it.mean);
    let [short, long] = [mean(&runs[0]), mean(&runs[1])].map(|it| it * CYCLE / 3600.0);
    let flow = (long - short) / (MEASURED_AT[1] - MEASURED_AT[0]);
    Ok([3600.0 * flow, MEASURED_AT[0] - short / flow])
}

/// Drives lights at all degrees of saturation, and compares.
pub(crate) fn signals(effort: &Effort) -> Result<Finding, Fault> {
    let [saturation_veh_h, lost] = saturation(effort)?;
    let light = |green: f64, arrivals_veh_h: f64| Signal {
        cycle_s: CYCLE,
        green_s: green - lost,
        arrivals_veh_h,
        saturation_veh_h,
    };
    let (mut rows, mut series) = (Vec::new(), Vec::new());
    let mut csv = String::from("green_s,saturation,flow_veh_h,delay_s,half_width,replications,webster_s\n");
    for green in GREENS {
        let flow = |x: f64| x * saturation_veh_h * (green - lost) / CYCLE;
        let kinds = SATURATIONS.map(|(x, _)| [green, LASTING].map(|green| traffic(green, flow(x))));
        let runs = each(effort, kinds.as_flattened(), measure)?;
        let mut points = Vec::new();
        for ((x, tolerance), runs) in SATURATIONS.iter().zip(runs.chunks(2)) {
            let [at_light, free] = [&runs[0], &runs[1]];
            let webster = |it: &Measured| light(green, it.flow).random_delay_s();
            let ratio = |it: &Measured, free: &Measured| Some((it.duration - free.duration) / webster(it)?);
            let delay = between(at_light, free, |it, free| Some(it.duration - free.duration));
            let flow = over(at_light, |it| Some(it.flow)).map_or(0.0, |it| it.mean);
            if let Some(delay) = delay {
                let expected = light(green, flow).random_delay_s();
                let expected = expected.map_or(String::new(), |it| it.to_string());
                csv += &format!("{green},{x},{flow},{},{expected}\n", cells_of(&delay));
                points.push(Estimated { at: flow, value: delay.mean, interval: delay.interval() });
            }
            rows.extend(tolerance.map(|tolerance| Row {
                what: format!("delay divided by Webster's, degree of saturation {x}, green of {green:.0} s"),
                unit: "",
                value: between(at_light, free, ratio),
                range: [1.0 - tolerance, 1.0 + tolerance],
                source: "Webster (1958, m)",
            }));
        }
        series.push((format!("green of {green:.0} s"), points));
        series.push((format!("Webster, {green:.0} s"), curve(|x| light(green, flow(x)))));
    }
    let labels = ["Flow [veh/h]", "Control delay [s]"];
    let figure = estimates(Sheet::Page, "Delay at a light with a cycle of 60 s", labels, &series).svg;
    Ok(Finding {
        text: words(&rows, [saturation_veh_h, lost], effort),
        tables: vec![("signals".into(), csv), ("signals_ratio".into(), csv_of(&rows))],
        figures: vec![("signals".into(), figure)],
        rows,
    })
}

/// Webster's delay over the degrees of saturation of a light.
fn curve(light: impl Fn(f64) -> Signal) -> Vec<Estimated> {
    let point = |number: u32| {
        let light = light(0.95 * f64::from(number) / 20.0);
        let value = light.random_delay_s()?;
        Some(Estimated { at: light.arrivals_veh_h, value, interval: Interval { lower: value, upper: value } })
    };
    (1..=20).filter_map(point).collect()
}

fn words(rows: &[Row], [saturation, lost]: [f64; 2], effort: &Effort) -> String {
    format!(
        "# The delay at a light, beside Webster's formula\n\n\
         One lane, cars that arrive at random and go straight on, a light with a cycle of 60 s. The delay is the time of a trip less that of the \
         same trip at a light that stays green. The saturation flow is measured with a queue that never ends, from greens of 20 and 40 s: \
         {saturation:.0} veh/h, with an effective green {lost:.1} s shorter than the green. {} seeds.\n\n{}",
        effort.seeds,
        table_of(rows)
    )
}
