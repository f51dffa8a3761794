//! Many simulations that are stepped together.

use laneweave::{
    Class, Columns, Control, Fleet, Id, Lateral, Longitudinal, NewVehicle, Rows, SIGHT_COLUMNS, Simulation,
    Template, VehicleId,
};
use laneweave_test_data::map;

fn template() -> Template {
    let builder = Simulation::builder(map("ramps.osm")).vehicles_per_hour(3000.0).threads(1);
    builder.template().expect("the map is sound")
}

fn ego(simulation: &mut Simulation, lanelet: Id) -> VehicleId {
    let vehicle = NewVehicle {
        lanelet,
        position_m: 50.0,
        speed_mps: 20.0,
        class: Class::Car,
        style: "conservative".into(),
        destination: None,
    };
    simulation.insert(vehicle).expect("there is room")
}

fn hashes(fleet: &Fleet) -> Vec<u64> {
    fleet.simulations().iter().map(Simulation::state_hash).collect()
}

#[test]
fn a_fleet_on_any_number_of_threads_drives_as_its_simulations_do_alone() {
    let template = template();
    let seeds = [5, 1, 1, 9, 7];
    let alone = seeds.map(|seed| {
        let mut simulation = template.spawn(seed).expect("one thread");
        simulation.steps(600);
        simulation.state_hash()
    });
    assert!(alone[1] == alone[2] && alone[0] != alone[1]);
    for threads in [1, 2, 3] {
        let mut fleet = Fleet::new(&template, seeds, threads).expect("there are so many threads");
        (0..6).for_each(|_| fleet.step(100));
        assert_eq!(hashes(&fleet), alone, "{threads} threads");
        fleet.reset(3, 1).expect("there are five");
        fleet.step(600);
        assert_eq!(fleet.simulations()[3].state_hash(), alone[1], "{threads} threads");
    }
}

/// Columns for so many vehicles.
fn rows<'a>(basic: &'a mut Columns, count: usize) -> Rows<'a> {
    let Columns { id, lanelet, position_m, speed_mps, acceleration_mps2, x_m, y_m, z_m, heading_rad, .. } =
        basic;
    id.resize(count, 0);
    lanelet.resize(count, 0);
    acceleration_mps2.resize(count, 0.0);
    [&mut *position_m, speed_mps, x_m, y_m, z_m, heading_rad]
        .into_iter()
        .for_each(|it| it.resize(count, 0.0));
    Rows { id, lanelet, position_m, speed_mps, acceleration_mps2, x_m, y_m, z_m, heading_rad }
}

#[test]
fn columns_of_a_fleet_are_those_of_its_simulations_one_after_the_other() {
    let mut fleet = Fleet::new(&template(), 1..=4, 2).expect("two threads");
    fleet.step(900);
    let (mut all, mut one, mut counts) = (Columns::with_poses(), Columns::with_poses(), [0; 4]);
    let total = fleet.columns(rows(&mut all, 500), &mut counts).expect("there is room");
    let mut begin = 0;
    for (simulation, count) in fleet.simulations().iter().zip(counts) {
        simulation.columns(&mut one);
        let range = begin..begin + count as usize;
        assert_eq!((one.len(), &all.id[range.clone()]), (count as usize, &one.id[..]));
        assert_eq!(all.speed_mps[range.clone()], one.speed_mps);
        assert_eq!(all.heading_rad[range.clone()], one.heading_rad);
        assert_eq!(all.x_m[range], one.x_m);
        begin += count as usize;
    }
    assert!(begin == total && total > 100, "{total} vehicles");
    let fault = fleet.columns(rows(&mut all, total - 1), &mut counts).expect_err("too few rows");
    assert!(fault.to_string().contains(&format!("give each column {total} rows or more")), "{fault}");
    let fault = fleet.columns(rows(&mut all, total), &mut counts[1..]).expect_err("too few counts");
    assert!(fault.to_string().contains("counts has 3 places; give it 4"), "{fault}");
}

#[test]
fn a_vehicle_sees_itself_and_the_nearest_in_the_frame_of_its_lane() {
    let mut fleet = Fleet::new(&template(), 1..=3, 1).expect("one thread");
    let lanelet = fleet.simulations()[0].lanelets()[0];
    let egos: Vec<VehicleId> =
        (0..3).map(|it| ego(fleet.simulation(it).expect("there are three"), lanelet)).collect();
    let control = Control::Drive { longitudinal: Longitudinal::Speed(15.0), lateral: Lateral::Keep };
    fleet.control(&[(0, egos[0], control), (2, egos[2], control)]).expect("they are there");
    fleet.step(200);
    fleet.simulation(1).expect("there are three").remove(egos[1]).expect("it is there");
    fleet.step(100);
    let width = SIGHT_COLUMNS.len();
    let mut sight = vec![f32::NAN; 3 * 6 * width];
    fleet.sight(&egos, 5, &mut sight).expect("all lengths fit");
    let rows: Vec<&[f32]> = sight.chunks_exact(width).collect();
    assert!(rows[6..12].iter().all(|it| it.iter().all(|it| *it == 0.0)), "the second one is gone");
    for (world, rows) in [(0, &rows[..6]), (2, &rows[12..])] {
        let simulation = &fleet.simulations()[world];
        let own = simulation.vehicle(egos[world]).expect("it is there");
        assert!(rows[0][1].abs() < 1e-3 && rows[0][2].abs() < 1e-3, "it is the origin: {:?}", rows[0]);
        assert!((rows[0][3] - 15.0).abs() < 0.1 && rows[0][4].abs() < 1e-3, "{:?}", rows[0]);
        // Those that are there come in the order of their distances, which are those on the map.
        let distance = |it: &&[f32]| f64::from(it[1]).hypot(f64::from(it[2]));
        let seen: Vec<f64> = rows[1..].iter().filter(|it| it[0] == 1.0).map(distance).collect();
        let mut true_ones: Vec<f64> = simulation
            .vehicles()
            .iter()
            .filter(|it| it.id != egos[world])
            .map(|it| (it.x_m - own.x_m).hypot(it.y_m - own.y_m))
            .collect();
        true_ones.sort_by(f64::total_cmp);
        assert!(!seen.is_empty() && seen.len() == true_ones.len().min(5));
        assert!(seen.iter().zip(&true_ones).all(|(a, b)| (a - b).abs() < 1e-2), "{seen:?} {true_ones:?}");
        assert!(rows[1..].iter().all(|it| it[2].abs() < 30.0), "it is a straight road");
    }
    let fault = fleet.sight(&egos, 4, &mut sight).expect_err("too long");
    assert!(fault.to_string().contains("give it 105"), "{fault}");
}

#[test]
fn what_a_fleet_cannot_do_is_refused_with_a_remedy() {
    let template = template();
    let refused = |fleet: Result<Fleet, laneweave::Fault>| fleet.err().expect("refused").to_string();
    assert!(refused(Fleet::new(&template, [], 1)).contains("give one for each simulation"));
    assert!(refused(Fleet::new(&template, [1], 0)).contains("choose 1 to 256"));
    let mut fleet = Fleet::new(&template, [1, 2], 1).expect("one thread");
    assert_eq!((fleet.len(), fleet.is_empty()), (2, false));
    let fault = fleet.reset(2, 1).expect_err("there are two").to_string();
    assert!(fault.contains("there is no simulation 2; choose 0 to 1"), "{fault}");
    let fault = fleet.control(&[(1, 77, Control::DRIVER)]).expect_err("nobody has this id").to_string();
    assert!(fault.starts_with("simulation 1: control of vehicle 77"), "{fault}");
}
