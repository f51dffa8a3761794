//! Drivers of the true style match a recording better than others, and part from it less.

use laneweave::scenario::Origin;
use laneweave::style::Model;
use laneweave_studies::replay::{Asked, Matched, replay};
use laneweave_test_data::map;

use crate::replayed::set_up::{observed, of_style, replayed, written};

#[test]
fn on_a_recording_of_our_motorway_the_true_style_wins() {
    let recording = written(&observed(&of_style("ramps.osm", "conservative", 3000.0, 240.0), 0.1));
    let run = |style: &str, models: &[Model]| {
        let mut scenario = replayed(recording.clone(), map("ramps.osm"), 0.3);
        scenario.styles = [(style.to_owned(), 1.0)].into();
        scenario.output.dir = recording.with_extension(style);
        let asked = Asked { rollouts: 6, models: models.to_vec(), threads: 2 };
        let done = replay(&scenario, &Origin::default(), &asked, "a test", |_| (), || false);
        done.expect("it runs").report.expect("it was not interrupted")
    };
    let report = run("conservative", &[Model::Null, Model::Mobil]);
    let other = run("aggressive", &[]);
    let whole = |it: &Matched| it.score.whole;
    let [own, null, mobil] = [0, 1, 2].map(|it| &report.models[it]);
    let figures = [own, null, mobil, &other.models[0]].map(whole);
    assert!(report.reactive > 30 && own.score.drivers > 30, "{} drivers", report.reactive);
    assert!(figures[1..].iter().all(|it| *it < figures[0]), "{figures:?}");
    let null = null.difference.expect("it has one");
    assert!(null.mean + null.half_width < 0.0, "the null model is worse for sure: {null:?}");
    let share = own.parting.parted_share;
    assert!(share > 0.05 && share < 0.6, "{share} of the drivers part");
    assert!(other.models[0].parting.parted_share > share);
}
