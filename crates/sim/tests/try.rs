#[path = "roads/drivers.rs"]
mod drivers;
use laneweave_sim::*;
use laneweave_maps::{load, ReadOptions};
use std::path::Path;
#[test]
fn try_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let maps = std::env::var("MAPS").unwrap_or("maps/motorway_2_lanes.osm:2400 maps/motorway_4_lanes.osm:6000 maps/on_ramp.osm:4000 maps/off_ramp.osm:4000 maps/lane_drop.osm:3000 maps/ramps.osm:4500 ../shared/data/lanelet2/four_track_highway.osm:4000".into());
    for item in maps.split(' ') { for agg in [0.12, 1.0] {
        let (map, total) = item.split_once(':').unwrap();
        let network = load(&root.join(map), &ReadOptions::default()).unwrap().network;
        if agg < 0.5 { println!("{map}: {} chains, entrances {:?} exits {:?} drops {:?}", network.chains.len(), network.entrances.iter().map(|g| (g.id, g.chains.len())).collect::<Vec<_>>(), network.exits.iter().map(|g| (g.id, g.chains.len())).collect::<Vec<_>>(), network.lane_drops); }
        let demand = drivers::demand(&network, total.parse().unwrap(), 0.1, &[agg, 1.0 - agg]);
        let mut world = World::new(network, vec![drivers::aggressive(), drivers::conservative()], demand, Setup { step: 0.1, seed: 1, threads: 1 }).unwrap();
        let t = std::time::Instant::now();
        let mut aborted = 0;
        for _ in 0..18000 { world.step(); aborted += world.events().iter().filter(|e| matches!(e, Event::LaneChange(c) if !c.is_completed)).count(); }
        let wall = t.elapsed().as_secs_f64();
        let tally = world.tally();
        let c = world.counts();
        let km = tally.distance / 1000.0;
        println!("  agg {agg}: arrived {} entered {} left {} on {} waiting {} | {:.1} m/s {:.0} vehkm lc/km {:.3} (d {} r {} ab {aborted}) | col {} over {} stuck {} missed {} ({:.1}%) emerg {} ({:.2}/100km) | {:.1} M/s {:x}", world.arrived(), c.entered, c.left, world.on_road(), world.waiting(), tally.distance/(tally.updates as f64*0.1), km, (c.discretionary_changes + c.route_changes) as f64/km, c.discretionary_changes, c.route_changes, tally.collisions, c.overlaps, tally.stuck, tally.missed_turns, 100.0*tally.missed_turns as f64/c.entered as f64, tally.emergency_brakings, 100.0*tally.emergency_brakings as f64/km, tally.updates as f64/wall/1e6, world.state_hash());
    }}
}
