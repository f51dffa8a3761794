//! What a program sees.

use laneweave_learning::{
    Autoreset, Grid, LANELET_COLUMNS, LINK_COLUMNS, Lanes, OWN_COLUMNS, Observation, Task, VEHICLE_COLUMNS,
};

use crate::{Driven, short};

fn driven(name: &str, observation: Observation) -> Driven {
    Driven::new(name, short(Task { observation, ..Task::default() }), &[1, 2, 3, 4], 1, Autoreset::NextStep)
}

fn column(columns: &[&str], name: &str) -> usize {
    columns.iter().position(|it| it.starts_with(name)).expect("a known column")
}

#[test]
fn all_numbers_are_between_minus_one_and_one() {
    for name in ["ramps.osm", "roundabout.osm", "town.osm"] {
        for observation in [
            Observation::default(),
            Observation::Grid(Grid::default()),
            Observation::Lanes(Lanes { links: 0, ..Lanes::default() }),
        ] {
            let mut driven = driven(name, observation);
            for step in 0..20 {
                driven.act(&[1.0, 3.0, 0.0, f64::from(step % 5)]);
                assert!(driven.observations.iter().all(|it| (-1.0..=1.0).contains(it)), "{name}");
            }
        }
    }
}

#[test]
fn the_nearest_vehicles_come_first_in_the_frame_of_the_lane() {
    let mut driven = driven("ramps.osm", Observation::Kinematics { nearest: 5 });
    driven.act(&[1.0; 4]);
    for world in 0..4 {
        let (simulation, ego) = driven.batch.simulation(world).expect("four worlds");
        let own = simulation.vehicle(ego).expect("it is on the road");
        let seen = driven.seen(world);
        let speed = seen[column(&OWN_COLUMNS, "speed_mps")];
        assert!((f64::from(speed) * 40.0 - own.speed_mps).abs() < 1e-4);
        let mut distances: Vec<f64> = simulation
            .vehicles()
            .iter()
            .filter(|it| it.id != ego)
            .map(|it| (it.x_m - own.x_m).hypot(it.y_m - own.y_m))
            .collect();
        distances.sort_by(f64::total_cmp);
        let rows = seen[OWN_COLUMNS.len()..].chunks_exact(VEHICLE_COLUMNS.len());
        for (row, distance) in rows.zip(distances).filter(|it| it.1 < 95.0) {
            let [ahead, left] = [row[1] * 100.0, row[2] * 10.0].map(f64::from);
            assert_eq!(row[0], 1.0);
            // Further to the left than ten metres is not told apart.
            assert!(
                left.abs() > 9.99 || (ahead.hypot(left) - distance).abs() < 0.1,
                "{ahead} {left} {distance}"
            );
        }
    }
}

#[test]
fn a_vehicle_covers_the_cells_where_it_is() {
    let grid = Grid { ahead_m: 80.0, behind_m: 40.0, beside_m: 8.0, cell_m: [1.0, 0.5] };
    let mut driven = driven("ramps.osm", Observation::Grid(grid));
    driven.act(&[1.0; 4]);
    let (along, across) = (120, 32);
    let mut found = 0;
    for world in 0..4 {
        let (simulation, ego) = driven.batch.simulation(world).expect("four worlds");
        let own = simulation.vehicle(ego).expect("it is on the road");
        let cells = &driven.seen(world)[OWN_COLUMNS.len()..];
        let (vehicles, lanes) = (&cells[..along * across], &cells[2 * along * across..]);
        for other in simulation.vehicles().iter().filter(|it| it.id != ego) {
            // The road is straight, and leads to the east.
            let [ahead, left] = [other.x_m - own.x_m, other.y_m - own.y_m + own.offset_m];
            let is_inside =
                (-35.0..75.0).contains(&ahead) && left.abs() < 6.0 && other.heading_rad.abs() < 0.01;
            if is_inside {
                let cell = (ahead + 40.0) as usize * across + ((left + 8.0) / 0.5) as usize;
                assert_eq!(
                    (vehicles[cell], lanes[cell]),
                    (1.0, 1.0),
                    "{ahead} m ahead, {left} m to the left"
                );
                found += 1;
            }
        }
    }
    assert!(found > 4, "{found} vehicles");
}

#[test]
fn the_graph_names_the_own_lanelet_its_way_and_links_between_lanelets_that_are_there() {
    let lanes = Lanes { nearest: 2, ..Lanes::default() };
    let mut driven = driven("roundabout.osm", Observation::Lanes(lanes.clone()));
    driven.act(&[1.0; 4]);
    let columns = 2 * lanes.points + LANELET_COLUMNS.len();
    for world in 0..4 {
        let seen = &driven.seen(world)[OWN_COLUMNS.len() + lanes.nearest * VEHICLE_COLUMNS.len()..];
        let (lanelets, links) = seen.split_at(lanes.lanelets * columns);
        let rows: Vec<&[f32]> = lanelets.chunks_exact(columns).map(|it| &it[2 * lanes.points..]).collect();
        let count = rows.iter().filter(|it| it[0] == 1.0).count();
        assert_eq!(rows.iter().filter(|it| it[1] == 1.0).count(), 1, "one is its own");
        assert!(rows.iter().filter(|it| it[2] == 1.0).count() >= 2, "it drives on");
        let links: Vec<&[f32]> =
            links.chunks_exact(LINK_COLUMNS.len()).take_while(|it| it[0] >= 0.0).collect();
        assert!(!links.is_empty());
        for link in links {
            assert!(
                (link[0] as usize) < count && (link[1] as usize) < count && (0.0..=2.0).contains(&link[2])
            );
            if link[2] == 0.0 {
                // The second one begins where the first one ends.
                let [from, to] =
                    [link[0], link[1]].map(|it| &lanelets[it as usize * columns..][..2 * lanes.points]);
                let ends = &from[2 * lanes.points - 2..];
                let is_clipped = ends.iter().chain(&to[..2]).any(|it| it.abs() >= 1.0);
                assert!(
                    is_clipped || (ends[0] - to[0]).hypot(ends[1] - to[1]) < 0.01,
                    "{ends:?} {:?}",
                    &to[..2]
                );
            }
        }
    }
}
