mod roads;
#[path = "roads/drivers.rs"]
mod drivers;
use laneweave_sim::*;
#[test]
fn try_it() {
    for (lanes, total, agg) in [(2, 2400.0, 0.12), (3, 3600.0, 0.12), (3, 3600.0, 1.0)] {
        let network = roads::straight(lanes, 5000.0, 33.33);
        let demand = drivers::demand(&network, total, 0.1, &[agg, 1.0 - agg]);
        let mut world = World::new(network, vec![drivers::aggressive(), drivers::conservative()], demand, Setup { step: 0.1, seed: 1, threads: 1 }).unwrap();
        let t = std::time::Instant::now();
        for _ in 0..18000 { world.step(); }
        let wall = t.elapsed().as_secs_f64();
        let tally = world.tally();
        println!("{lanes} {total} {agg}: arrived {} {:?} on road {} waiting {}\n{:?}", world.arrived(), world.counts(), world.on_road(), world.waiting(), tally);
        println!("  {:.1} M updates/s; speed {:.1}; lc/vehkm {:.3}; hash {:x}", tally.updates as f64/wall/1e6, tally.distance/(tally.updates as f64*0.1), (world.counts().discretionary_changes + world.counts().route_changes) as f64/(tally.distance/1000.0), world.state_hash());
        println!("  held-up hazard {:.4} free {:.4}", tally.held_up_desires as f64/tally.held_up_considerations as f64, tally.free_desires as f64/tally.free_considerations as f64);
    }
}
