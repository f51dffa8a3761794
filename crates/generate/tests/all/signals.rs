//! Made programs of lights: sound on every map, and as an engineer would draw them.

use std::collections::BTreeSet;

use laneweave_generate::{Grid, grid, random};
use laneweave_maps::{Map, regulations};
use laneweave_network::{DrivingSide, LightIndex, LightTraffic, Network, Position, SignalPlan};

fn network(map: &Map) -> Network {
    map.network.clone().regulated(&regulations(map))
}

/// One junction of streets with so many lanes in each direction.
fn junction(lanes: usize, driving_side: DrivingSide) -> Network {
    let wanted = Grid { rows: 1, columns: 1, lanes, driving_side, ..Grid::default() };
    let drawing = grid(&wanted).expect("the numbers are in range");
    network(&drawing.build().expect("the drawing is sound"))
}

/// The plans for this flow everywhere [veh/h].
fn plans(network: &Network, flow: f64) -> Vec<SignalPlan> {
    let traffic = LightTraffic { flow: &|_| flow / 3600.0, saturation: &|_| 0.5 };
    network.lights().programs(&traffic)
}

#[test]
fn lanes_that_only_turn_across_oncoming_traffic_are_protected_from_much_of_it() {
    for side in [DrivingSide::Right, DrivingSide::Left] {
        // Streets of three lanes have a lane for such turns.
        let junction = junction(3, side);
        let sizes = |flow: f64| -> Vec<usize> {
            let plans = plans(&junction, flow);
            assert_eq!(plans.len(), 1);
            plans[0].turns.iter().map(|it| it.lights.len()).collect()
        };
        assert_eq!(sizes(60.0), [6, 6], "{side:?}");
        assert_eq!(sizes(300.0), [2, 4, 2, 4], "{side:?}");
    }
}

/// Checks that `plans` never show green to lights that exclude each other, and green to each light.
#[track_caller]
fn check(network: &Network, plans: &[SignalPlan]) {
    let conflicts = network.light_conflicts();
    let mut seen: BTreeSet<LightIndex> = BTreeSet::new();
    for plan in plans {
        let own: BTreeSet<LightIndex> = plan.lights().collect();
        assert!(own.iter().all(|it| seen.insert(*it)), "a light has two programs");
        assert!(plan.turns.len() >= 2);
        let shortest: f64 = plan.turns.iter().map(|it| 5.0 + it.yellow + it.all_red).sum();
        assert!(plan.cycle() > 19.9 && plan.cycle() < f64::max(120.0, shortest) + 1e-6, "{}", plan.cycle());
        for turn in &plan.turns {
            assert!(turn.green >= 4.9 && turn.yellow == 3.0 && turn.all_red >= 2.0);
            let both = |it: &[LightIndex; 2]| it.iter().all(|light| turn.lights.contains(light));
            assert!(!conflicts.iter().any(|it| !it.is_ordered && both(&it.lights)));
        }
    }
    // Who conflicts with nobody needs no program.
    let rivals = conflicts.iter().flat_map(|it| it.lights);
    assert!(rivals.into_iter().all(|it| seen.contains(&it)), "a light is never green");
}

#[test]
fn made_programs_are_sound_on_random_maps_for_random_flows() {
    for seed in 7001..7041_u64 {
        let map = random(seed);
        let network = network(&map.drawing.build().unwrap());
        check(&network, &network.junctions.made);
        for amount in [0.0, 30.0, 400.0, 2000.0] {
            // Flows that differ from chain to chain by a factor of up to ten.
            let spread =
                |at: Position| 0.1 + 0.9 * ((at.chain.at() as f64 * 0.618 + seed as f64 * 0.37).fract());
            let flow = |at: Position| amount * spread(at) / 3600.0;
            let traffic = LightTraffic { flow: &flow, saturation: &|_| 0.5 };
            check(&network, &network.lights().programs(&traffic));
        }
    }
}
