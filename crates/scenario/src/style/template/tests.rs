use std::collections::BTreeSet;

use laneweave_models::change::{Courtesy, Mcdm, Rule, Safety};
use laneweave_models::follow::FollowingModel;
use laneweave_models::{Alertness, Attention, Manner, Reading};

use super::*;
use crate::style::{BUILT_IN, built_in};

fn template(name: &str) -> StyleTemplate {
    let text = built_in(name).unwrap().text.into();
    StyleTemplate::parse(&Source { path: name.into(), text }).unwrap()
}

#[test]
fn a_style_with_a_distribution_is_512_drivers_with_its_mean_and_deviation() {
    let template = template("aggressive");
    assert_eq!(template.driver_parameters(), 512);
    let draw = |number| template.draw(&Random::new(1), 0, number).unwrap().speed_factor;
    let factors: Vec<f64> = (0..512).map(draw).collect();
    let mean = factors.iter().sum::<f64>() / 512.0;
    let sd = (factors.iter().map(|it| (it - mean) * (it - mean)).sum::<f64>() / 511.0).sqrt();
    // Three standard errors of 512 draws with mean 1.12 and deviation 0.08.
    assert!((mean - 1.12).abs() < 0.0106, "mean {mean}");
    assert!((sd - 0.08).abs() < 0.0075, "deviation {sd}");
    assert!(factors.iter().all(|it| (0.85..=1.4).contains(it)));
}

#[test]
fn a_style_without_distributions_is_one_driver() {
    let template = template("paper-conservative");
    assert_eq!(template.driver_parameters(), 1);
    assert_eq!(template.draw(&Random::new(1), 0, 0).unwrap(), *template.typical());
}

#[test]
fn draws_depend_on_seed_style_and_number_only() {
    let template = template("conservative");
    let factor = |seed, style, number| template.draw(&Random::new(seed), style, number).unwrap().speed_factor;
    assert_eq!(factor(1, 0, 7), factor(1, 0, 7));
    let all = [factor(1, 0, 7), factor(1, 0, 8), factor(1, 1, 7), factor(2, 0, 7)];
    assert!((1..4).all(|i| all[..i].iter().all(|it| *it != all[i])), "{all:?}");
}

#[test]
fn a_distribution_for_one_key_leaves_the_draws_of_the_others_unchanged() {
    let text = built_in("conservative").unwrap().text;
    let time_gap = "time_gap = { distribution = \"uniform\", low = 1.0, high = 1.4 }";
    let own = text.replace("time_gap = 1.2", time_gap);
    let own = StyleTemplate::parse(&Source { path: "own".into(), text: own }).unwrap();
    let time_gap = models::Parameter::TimeGap;
    let usual = template("conservative");
    assert!(own.parameters().len() > usual.parameters().len() && usual.parameters().len() > 1);
    for number in 0..512 {
        let [mut with, without] = [&own, &usual].map(|it| it.draw(&Random::new(1), 3, number).unwrap());
        assert_ne!(time_gap.value(&with), time_gap.value(&without));
        *time_gap.place(&mut with).unwrap() = 1.2;
        assert_eq!(with, without);
    }
}

#[test]
fn the_number_of_a_key_is_that_of_every_release_and_no_other_key_has_it() {
    // The test vectors of FNV-1a's authors.
    assert_eq!([&b""[..], b"a", b"foobar"].map(fnv_1a), [0x811c_9dc5, 0xe40c_292c, 0xbf9c_f968]);
    let numbers: BTreeSet<u32> =
        models::Parameter::ALL.iter().map(|it| fnv_1a(it.key().as_bytes())).collect();
    assert_eq!(numbers.len(), models::Parameter::ALL.len());
}

#[test]
fn several_parameters_are_drawn_independently_of_each_other() {
    let text = built_in("conservative").unwrap().text.replace(
        "time_gap = 1.2",
        "time_gap = { distribution = \"lognormal\", mean = 1.2, sd = 0.3, min = 0.5, max = 3 }",
    );
    let template = StyleTemplate::parse(&Source { path: "own".into(), text }).unwrap();
    let paths: Vec<String> = template.parameters().iter().map(|it| it.path.join(".")).collect();
    assert_eq!(
        paths,
        [
            "follow.time_gap",
            "manner.change_duration",
            "manner.pressed_duration",
            "safety.max_deceleration",
            "safety.min_gap",
            "safety.min_lag_gap",
            "safety.min_time_to_collision",
            "speed_factor"
        ]
    );
    let pairs: Vec<(f64, f64)> = (0..512)
        .map(|number| template.draw(&Random::new(1), 0, number).unwrap())
        .map(|style| match style.follow {
            FollowingModel::IdmPlus(it) => (it.time_gap, style.speed_factor),
            other => panic!("{other:?}"),
        })
        .collect();
    let sum = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
    let (gap, factor) = (sum(&|it| it.0) / 512.0, sum(&|it| it.1) / 512.0);
    let together = sum(&|it| (it.0 - gap) * (it.1 - factor));
    let apart = sum(&|it| (it.0 - gap).powi(2)) * sum(&|it| (it.1 - factor).powi(2));
    // Three standard errors of a correlation that is not there.
    assert!((together / apart.sqrt()).abs() < 0.133);
}

#[test]
fn the_built_in_styles_have_the_papers_weights_in_both_readings() {
    for (name, weights, beta, reading) in [
        ("aggressive", [1.26, 0.58, 0.03, 0.61, 0.9], 1.1, Reading::Repaired),
        ("conservative", [0.44, 0.41, 0.09, 1.72, 0.9], 2.3, Reading::Repaired),
        ("paper-aggressive", [1.26, 0.58, 0.03, 0.61, 0.0], 1.1, Reading::Literal),
        ("paper-conservative", [0.44, 0.41, 0.09, 1.72, 0.0], 2.3, Reading::Literal),
    ] {
        let LaneChangeModel::Mcdm(it) = template(name).typical().change.clone() else { panic!("{name}") };
        let found =
            [it.speed.weight, it.route.weight, it.comfort.weight, it.courtesy.weight, it.urgency.weight];
        assert_eq!((found, it.comfort.beta), (weights, beta), "{name}");
        let others = [it.comfort.reading, it.courtesy.reading, it.returning.reading];
        assert_eq!((it.speed.reading, others), (reading, [reading; 3]), "{name}");
        assert_eq!(it.route.reading, reading.into(), "{name}");
        let decision = match reading {
            Reading::Literal => (Rule::Threshold, 0.0, 0.0),
            Reading::Repaired => (Rule::Logit, 0.007, 0.000875),
        };
        assert_eq!((it.rule, it.theta, it.sigma), decision, "{name}");
    }
}

#[test]
fn the_other_characters_are_the_conservative_driver_but_for_what_their_names_say() {
    let usual = template("conservative").typical().clone();
    let LaneChangeModel::Mcdm(table) = usual.change.clone() else { panic!("conservative") };
    let with_courtesy = |weight| {
        let courtesy = Courtesy { weight, ..table.courtesy };
        LaneChangeModel::Mcdm(Mcdm { courtesy, ..table.clone() })
    };
    let with_manner = |yield_deceleration| Manner { yield_deceleration, ..usual.manner };
    let attention = Attention {
        epoch: 1.0,
        concentrated_for: 15.0,
        inattentive_for: 60.0,
        inattentive: Alertness { epoch: 2.0, sight: 150.0, comfort: 5.0 },
    };
    for (name, expected) in [
        ("inattentive", Style { attention, ..usual.clone() }),
        ("altruistic", Style { change: with_courtesy(3.44), manner: with_manner(3.0), ..usual.clone() }),
        ("egoistic", Style { change: with_courtesy(0.0), manner: with_manner(0.0), ..usual.clone() }),
    ] {
        let found = template(name).typical().clone();
        let description = found.description.clone();
        assert_eq!(found, Style { name: name.into(), description, ..expected });
    }
}

#[test]
fn the_cautious_keep_longer_gaps_than_the_conservative_everywhere_and_drive_slower() {
    let [cautious, usual] = ["cautious", "conservative"].map(|it| template(it).typical().clone());
    let (FollowingModel::IdmPlus(gaps), FollowingModel::IdmPlus(usual_gaps)) =
        (cautious.follow, usual.follow)
    else {
        panic!("both follow by IDM+")
    };
    assert!(gaps.time_gap > usual_gaps.time_gap && gaps.jam_gap > usual_gaps.jam_gap);
    assert!(cautious.safety.min_gap > usual.safety.min_gap);
    assert!(cautious.safety.min_time_to_collision > usual.safety.min_time_to_collision);
    assert!(cautious.safety.max_deceleration < usual.safety.max_deceleration);
    assert!(cautious.manner.tightest > usual.manner.tightest);
    assert!(cautious.yielding.critical_gap > usual.yielding.critical_gap);
    assert!(cautious.speed_factor < usual.speed_factor);
    assert_eq!(cautious.change, usual.change);
}

#[test]
fn every_number_of_a_style_is_a_parameter_and_no_other_key_is() {
    fn numbers(table: &Table, path: &str, found: &mut Vec<String>) {
        for (key, value) in table {
            let path = format!("{path}{key}");
            match value {
                Value::Table(inner) => numbers(inner, &format!("{path}."), found),
                Value::Float(_) => found.push(path),
                _ => {}
            }
        }
    }
    let (mut used, mut unbounded) = (BTreeSet::new(), BTreeSet::new());
    for follow in ["idm", "fvdm", "acc", "ovm", "gfm", "krauss", "gipps", "newell", "idm+"] {
        for change in ["mcdm", "mobil", "lmrs", "constant-hazard"] {
            let text = format!("name = \"x\"\nfollow.model = {follow:?}\nchange.model = {change:?}");
            let mut style: Style = toml::from_str(&text).unwrap();
            let mut found = Vec::new();
            numbers(&Table::try_from(&style).unwrap(), "", &mut found);
            let mut style_has = |it: &models::Parameter| it.place(&mut style).is_some();
            let parameters: BTreeSet<_> =
                models::Parameter::ALL.iter().copied().filter(|it| style_has(it)).collect();
            let keys: BTreeSet<_> = parameters.iter().map(|it| it.key().to_string()).collect();
            assert_eq!(keys, found.into_iter().collect());
            unbounded.extend(parameters.iter().filter(|it| it.range() == Range::ANY).map(|it| it.key()));
            used.extend(parameters);
        }
    }
    assert_eq!(used.len(), models::Parameter::ALL.len());
    assert!(unbounded.iter().all(|it| it.ends_with(".weight") || *it == "change.theta"), "{unbounded:?}");
}

#[test]
fn a_parameter_is_the_number_at_its_key() {
    let mut style = template("conservative").typical().clone();
    for parameter in models::Parameter::ALL {
        let Some(place) = parameter.place(&mut style) else { continue };
        *place = 7.5;
        let table = Value::Table(Table::try_from(&style).unwrap());
        let found = parameter.key().split('.').try_fold(&table, |inner, key| inner.get(key));
        assert_eq!(found.and_then(Value::as_float), Some(7.5), "{}", parameter.key());
        assert_eq!(Value::try_from(parameter).unwrap(), Value::String(parameter.key().into()));
    }
}

/// A style with draws of its threshold and its first weight.
fn fitted(draws: &str) -> Result<StyleTemplate, Fault> {
    let table = "[fit]\ndraws_of = [\"change.theta\", \"change.speed.weight\"]";
    let text = format!("{}\n{table}\ndraws = {draws}\n", built_in("conservative").unwrap().text);
    StyleTemplate::parse(&Source { path: "own.toml".into(), text })
}

#[test]
fn a_fitted_style_has_draws_of_its_parameters() {
    let template = fitted("[[4.0, 0.1], [5.0, 0.2]]").unwrap();
    assert_eq!(template.draws(), 2);
    let numbers = |it: &StyleTemplate| match &it.typical().change {
        LaneChangeModel::Mcdm(Mcdm { theta, speed, courtesy, .. }) => (*theta, speed.weight, courtesy.weight),
        _ => panic!("another model"),
    };
    assert_eq!(numbers(&template.drawn(1).unwrap()), (5.0, 0.2, 1.72));
    assert_eq!(numbers(&template), (0.007, 0.44, 1.72));
    // All that is not drawn stays, with its random numbers.
    let drivers = |it: &StyleTemplate| it.draw(&Random::new(1), 0, 7).unwrap().speed_factor;
    assert_eq!(drivers(&template.drawn(0).unwrap()), drivers(&template));
    let error = template.drawn(2).unwrap_err();
    assert_eq!(
        error.what,
        "the style conservative has 2 draws of its parameters, from number 0 on, but none has number 2"
    );
    // Another lane-change model has no such parameters.
    assert_eq!(
        template
            .with_change(&LaneChangeModel::Mobil(laneweave_models::change::Mobil::default()))
            .unwrap()
            .draws(),
        0
    );
}

#[test]
fn draws_that_are_no_numbers_are_refused_with_their_place() {
    for (draws, what) in [
        ("7", "draws are no lists of numbers"),
        ("[[1.0, 2.0], [\"a\", 2.0]]", "draws are no lists of numbers"),
        ("[[1.0, 2.0], [1.0]]", "draw 2 has 1 numbers for 2 keys"),
    ] {
        let error = fitted(draws).unwrap_err();
        assert_eq!(error.what, what);
        assert!(error.place.starts_with("own.toml:"), "{}", error.place);
    }
    // A value out of its range.
    let template = fitted("[[4.0, 0.1]]").unwrap();
    let text = "draws_of = [\"safety.min_gap\"]\ndraws = [[-1.0]]";
    let text = format!("{}\n[fit]\n{text}\n", built_in("conservative").unwrap().text);
    let wrong = StyleTemplate::parse(&Source { path: "own.toml".into(), text }).unwrap();
    assert_eq!(wrong.drawn(0).unwrap_err().what, "safety.min_gap is -1");
    assert!(template.drawn(0).is_ok());
}

#[test]
fn a_driver_is_drawn_as_if_the_file_had_its_numbers() {
    for built_in in BUILT_IN {
        let template = template(built_in.name);
        let value = |it: &Parameter| it.distribution.value(0.3);
        let filled = fill(&template.table, &template.parameters, value).unwrap();
        assert_eq!(template.typical_with(value), Some(filled), "{}", built_in.name);
    }
}

/// Drivers of the built-in style `name`.
fn drawn(name: &str) -> Vec<Style> {
    let template = template(name);
    (0..template.driver_parameters()).map(|it| template.draw(&Random::new(1), 0, it).unwrap()).collect()
}

#[test]
fn what_gaps_are_accepted_differs_between_drivers_but_not_in_the_styles_of_the_paper() {
    for name in ["paper-aggressive", "paper-conservative"] {
        assert!(drawn(name).iter().all(|it| it.safety == Safety::default()), "{name}");
    }
    for name in ["aggressive", "altruistic", "cautious", "conservative", "egoistic", "inattentive", "mobil"] {
        let (drivers, typical) = (drawn(name), template(name).typical().clone());
        assert_eq!(drivers.len(), 512);
        let keys = [
            models::Parameter::MinGap,
            models::Parameter::MinLagGap,
            models::Parameter::MinTimeToCollision,
            models::Parameter::MaxDeceleration,
        ];
        for key in keys {
            let median = key.value(&typical).unwrap();
            let below = drivers.iter().filter(|it| key.value(it).unwrap() < median).count();
            // Three standard errors of a half.
            assert!((222..=290).contains(&below), "{name}: {below} by {}", key.key());
        }
        assert!(drivers.iter().all(|it| it.manner.misperception == 0.0), "{name}");
    }
    // ln 1.5 lies (ln 3.2 − σ²/2 − ln 1.5)/σ = 1.91 below the mean of the logarithms, with σ² = ln(1 + (1.2/3.2)²):
    // 2.8 % of 512 drivers, within three standard errors.
    let hasty = drawn("conservative").iter().filter(|it| it.safety.min_time_to_collision < 1.5).count();
    assert!((3..=26).contains(&hasty), "{hasty}");
}
