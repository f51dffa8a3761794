//! Episodes: how they begin, go on and end.

use laneweave::{FaultKind, Simulation};
use laneweave_learning::{Action, Autoreset, Batch, Choice, Rewards, TERMS, Task};
use laneweave_test_data::map;

use crate::{Driven, populations, short, template};

const SEEDS: [u64; 4] = [1, 2, 3, 99];

/// Some action for each world, other ones in each step.
fn some(step: usize, worlds: usize) -> Vec<f64> {
    (0..worlds).map(|world| ((3 * step + 7 * world) % Choice::ALL.len()) as f64).collect()
}

#[test]
fn worlds_do_the_same_alone_and_together_on_any_number_of_threads() {
    for autoreset in [Autoreset::NextStep, Autoreset::SameStep] {
        let task = short(Task { limit_s: 12.0, ..Task::default() });
        let new = |seeds: &[u64], threads| Driven::new("ramps.osm", task.clone(), seeds, threads, autoreset);
        let mut together = [new(&SEEDS, 1), new(&SEEDS, 2)];
        let mut alone = SEEDS.map(|seed| new(&[seed], 1));
        let mut ended = 0;
        for step in 0..40 {
            let actions = some(step, SEEDS.len());
            together.iter_mut().for_each(|it| it.act(&actions));
            for (world, alone) in alone.iter_mut().enumerate() {
                alone.act(&actions[world..=world]);
                for together in &together {
                    assert_eq!(alone.seen(0), together.seen(world), "world {world}, step {step}");
                    assert_eq!(alone.rewards[0].to_bits(), together.rewards[world].to_bits());
                    let ends = |it: &Driven, world: usize| (it.terminated[world], it.truncated[world]);
                    assert_eq!(ends(alone, 0), ends(together, world));
                }
                ended += usize::from(alone.terminated[0] || alone.truncated[0]);
            }
        }
        assert!(ended >= SEEDS.len(), "{ended} episodes have ended");
    }
}

#[test]
fn a_seed_repeats_its_episodes_and_the_next_ones_are_others() {
    let task = Task { starts: 64, ..short(Task::default()) };
    let mut driven = Driven::new("ramps.osm", task, &[5], 1, Autoreset::Disabled);
    let mut episodes = Vec::new();
    for seed in [Some(5), None, None, Some(5), None, None] {
        driven.reset(&[Some(seed)]);
        let begins = driven.seen(0).to_vec();
        (0..10).for_each(|step| driven.act(&some(step, 1)));
        episodes.push((begins, driven.seen(0).to_vec()));
    }
    assert_eq!(episodes[..3], episodes[3..]);
    assert!(episodes[0] != episodes[1] && episodes[1] != episodes[2]);
    // A world that is not among those that begin anew goes on.
    let goes_on = driven.seen(0).to_vec();
    driven.reset(&[None]);
    assert_eq!(driven.seen(0), goes_on);
}

#[test]
fn both_ways_of_beginning_the_next_episode_show_the_same() {
    let task = short(Task { limit_s: 5.0, ..Task::default() });
    let new = |autoreset| Driven::new("ramps.osm", task.clone(), &[3], 1, autoreset);
    let (mut next, mut same) = (new(Autoreset::NextStep), new(Autoreset::SameStep));
    for step in 0..5 {
        [&mut next, &mut same].into_iter().for_each(|it| it.act(&some(step, 1)));
    }
    assert!(next.truncated[0] && same.truncated[0] && !next.terminated[0]);
    assert_eq!(next.seen(0), &same.last_observations, "the last of the episode");
    next.act(&[0.0]);
    assert_eq!((next.rewards[0], next.truncated[0]), (0.0, false), "the action has no effect");
    assert_eq!(next.seen(0), same.seen(0), "the first of the next one");
}

#[test]
fn who_brakes_stands_and_who_drives_into_the_vehicle_ahead_collides() {
    let task = short(Task { action: Action::Continuous, decision_s: 0.5, limit_s: 120.0, ..Task::default() });
    let mut driven = Driven::new("ramps.osm", task, &[1, 2, 3], 1, Autoreset::Disabled);
    (0..30).for_each(|_| driven.act(&[-1.0, 0.0, -1.0, 0.0, -1.0, 0.0]));
    for world in 0..3 {
        let (simulation, ego) = driven.batch.simulation(world).expect("three worlds");
        assert_eq!(simulation.vehicle(ego).expect("it is on the road").speed_mps, 0.0);
        assert_eq!((driven.term(world, "standing"), driven.term(world, "speed")), (1.0, 0.0));
    }
    // At full acceleration each comes upon somebody.
    for _ in 0..200 {
        driven.act(&[1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
    }
    assert_eq!(driven.terminated, [true; 3]);
    let collided: Vec<bool> = (0..3).map(|it| driven.term(it, "collision") == 1.0).collect();
    assert!(collided.contains(&true), "{collided:?}");
    // A world that is over stays as it is until it is reset.
    let time = driven.batch.simulation(0).expect("three worlds").0.time_s();
    driven.act(&[1.0; 6]);
    assert_eq!(driven.batch.simulation(0).expect("three worlds").0.time_s(), time);
}

#[test]
fn a_path_ends_where_the_action_says() {
    let task = short(Task { action: Action::Pose, ..Task::default() });
    let mut driven = Driven::new("ramps.osm", task, &[8], 1, Autoreset::Disabled);
    let pose = |it: &Driven| {
        let (simulation, ego) = it.batch.simulation(0).expect("one world");
        let state = simulation.vehicle(ego).expect("it is on the road");
        (state.x_m, state.y_m, state.heading_rad)
    };
    let (x, y, heading) = pose(&driven);
    driven.act(&[20.0, 0.4, 0.01]);
    let (sine, cosine) = heading.sin_cos();
    let (x_after, y_after, heading_after) = pose(&driven);
    let expected = (x + 20.0 * cosine - 0.4 * sine, y + 20.0 * sine + 0.4 * cosine);
    assert!((x_after - expected.0).hypot(y_after - expected.1) < 1e-6);
    assert!((heading_after - heading - 0.01).abs() < 1e-9);
}

#[test]
fn the_reward_is_the_weighted_sum_of_its_terms() {
    let rewards = Rewards { speed: 2.0, delay: -0.25, discomfort: -3.0, ..Rewards::default() };
    let task = short(Task { rewards, ..Task::default() });
    let mut driven = Driven::new("ramps.osm", task, &[4], 1, Autoreset::NextStep);
    driven.act(&[3.0]);
    let weights = [2.0, -0.25, -0.5, -0.5, -3.0, -1.0, -0.05, -5.0, -20.0];
    let sum: f64 = weights.iter().zip(&driven.terms).map(|(weight, term)| weight * term).sum();
    assert!((driven.rewards[0] - sum).abs() < 1e-12 && TERMS.len() == weights.len());
    assert!(driven.term(0, "speed") > 0.1 && driven.term(0, "discomfort") > 0.0);
    assert!((driven.term(0, "speed") + driven.term(0, "delay") - 1.0).abs() < 1e-6);
}

#[test]
fn the_ego_comes_from_its_entrance_and_goes_to_its_destination() {
    let simulation = Simulation::builder(map("weaving.osm")).build().expect("the map is sound");
    let (entrance, _) = simulation.origins()[1];
    let destination = simulation.destinations()[1];
    let task = Task { entrances: vec![entrance], destinations: vec![destination], ..Task::default() };
    let mut driven = Driven::new("weaving.osm", short(task), &[1], 1, Autoreset::Disabled);
    for _ in 0..5 {
        let (simulation, ego) = driven.batch.simulation(0).expect("one world");
        let state = simulation.vehicle(ego).expect("it is on the road");
        assert_eq!((state.lanelet, state.destination), (entrance, Some(destination)));
        driven.reset(&[Some(None)]);
    }
}

#[test]
fn a_copy_goes_on_as_the_world_does() {
    let mut driven = Driven::new("ramps.osm", short(Task::default()), &[6], 1, Autoreset::NextStep);
    driven.act(&[1.0]);
    let mut copy = driven.batch.copy(0).expect("one world");
    (0..10).for_each(|_| copy.advance());
    driven.act(&[1.0]);
    assert_eq!(copy.state_hash(), driven.batch.simulation(0).expect("one world").0.state_hash());
}

#[test]
fn what_cannot_be_is_refused_with_a_remedy() {
    let new = |task: Task, seeds: &[u64]| Batch::new(populations("ramps.osm"), short(task), seeds, 1).err();
    let usual = Task::default;
    let refused = [
        (new(Task { decision_s: 0.25, ..usual() }, &[1]), "choose a multiple of the step of 0.1 s"),
        (new(Task { limit_s: f64::NAN, ..usual() }, &[1]), "choose a multiple"),
        (new(usual(), &[]), "give one for each world"),
        (new(Task { entrances: vec![12345.into()], ..usual() }, &[1]), "name entrances"),
        (Batch::new(Vec::new(), usual(), &[1], 1).err(), "give one or more"),
        (Batch::new(populations("ramps.osm"), short(usual()), &[1], 0).err(), "choose 1 to 256"),
        (Batch::new(populations("ramps.osm"), short(usual()), &[1], 1_000_000).err(), "choose 1 to 256"),
        (
            Batch::new(vec![("a".into(), template("ramps.osm"))], Task { starts: 0, ..usual() }, &[1], 1)
                .err(),
            "choose 1",
        ),
    ];
    for (fault, remedy) in refused {
        let fault = fault.expect("it is refused");
        assert!(fault.to_string().contains(remedy) && fault.kind == FaultKind::Value, "{fault}");
    }
    let mut driven = Driven::new("ramps.osm", short(usual()), &[1], 1, Autoreset::NextStep);
    let fault = driven.batch.reset(&[None], &mut [0.0]).expect_err("too few places");
    assert!(fault.to_string().contains("give it"), "{fault}");
    for number in [5.0, -1.0, 0.5, f64::NAN] {
        let fault = driven.refused(&[number]);
        assert!(fault.to_string().contains("choose 0 to 4"), "{fault}");
    }
}
