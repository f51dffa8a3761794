//! Pictures of traffic from above.

use laneweave::scenario::Origin;
use laneweave_test_data::map;
use laneweave_viewer::{Camera, Live, Pictures, Rerun, Snapshot, Source, render};
use tiny_skia::Pixmap;

fn asked(camera: Camera) -> Pictures {
    Pictures { camera, size: [400, 300], every_s: 1.0, from_s: Some(60.0), until_s: Some(62.0) }
}

/// The pictures with their times.
fn pictures(source: &mut dyn Source, asked: Pictures) -> Vec<(f64, Pixmap)> {
    let mut all = Vec::new();
    let count = render(source, asked, |number, time_s, png| {
        assert_eq!(number as usize, all.len());
        all.push((time_s, Pixmap::decode_png(png).expect("a picture")));
        Ok(())
    });
    assert_eq!(count.expect("pictures") as usize, all.len());
    all
}

fn live() -> Live {
    let (scenario, origin) = Origin::open(&map("ramps.osm")).expect("a map");
    Live::new(&scenario, &origin, std::env::temp_dir()).expect("a simulation")
}

/// Red, green and blue of the pixel in the middle.
fn middle(picture: &Pixmap) -> [u8; 3] {
    let pixel = picture.pixel(200, 150).expect("a pixel");
    [pixel.red(), pixel.green(), pixel.blue()]
}

#[test]
fn a_camera_that_follows_a_vehicle_has_it_in_its_middle() {
    let mut source = live();
    let all = pictures(&mut source, asked(Camera::Map));
    assert_eq!(all.iter().map(|it| it.0.round()).collect::<Vec<f64>>(), [60.0, 61.0, 62.0]);
    let mut snapshot = Snapshot::default();
    source.see(&Default::default(), &mut snapshot);
    let car = snapshot.vehicles[0];
    let at = Camera::Place { x: car.at[0], y: car.at[1], width: 60.0 };
    // The first picture is of now; styles have colours, and the road is grey.
    let own = [[0, 114, 178], [230, 159, 0]][usize::from(car.style)];
    for camera in [at, Camera::Follow(car.id)] {
        let now = Pictures { from_s: Some(62.0), ..asked(camera) };
        assert_eq!(middle(&pictures(&mut source, now)[0].1), own);
    }
    // 30 m beside the road there is only the ground, and above it nobody.
    let beside = Camera::Place { x: car.at[0], y: car.at[1] + 2000.0, width: 60.0 };
    let picture = &pictures(&mut source, Pictures { from_s: Some(62.0), ..asked(beside) })[0].1;
    assert_eq!(middle(picture), [206, 215, 196]);
}

#[test]
fn a_run_has_the_same_pictures_each_time() {
    let dir = std::env::temp_dir().join(format!("laneweave-pictures-{}", std::process::id()));
    let simulation = laneweave::Simulation::builder(map("ramps.osm")).duration_s(70.0).build();
    simulation.expect("a simulation").run_to_results(&dir).expect("results");
    let draw = || pictures(&mut Rerun::open(&dir).expect("a run"), asked(Camera::Map));
    let (once, again) = (draw(), draw());
    assert_eq!(once.len(), 3);
    assert!(once.iter().zip(&again).all(|(a, b)| a.1.data() == b.1.data()));
    assert_ne!(once[0].1.data(), once[1].1.data());
    let _ = std::fs::remove_dir_all(dir);
}

#[test]
fn a_simulation_without_an_end_needs_one() {
    let asked = Pictures { until_s: None, ..asked(Camera::Map) };
    let fault = render(&mut live(), asked, |_, _, _| Ok(())).expect_err("no end");
    assert!(fault.remedy.contains("--until"));
}
