//! Traffic lights: each link index of a program is a light, called `PROGRAM:INDEX`, for the movements that have it.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use laneweave_network::{Id, Phase, Program};

use super::movement::Movement;
use super::net::Net;
use super::program::{LightPhase, LightProgram, Programs};
use super::right_of_way::Rules;
use crate::map::Map;
use crate::problem::Problem;
use crate::rule::RuleKind;

/// What a light shows, by its character in the state of a phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shown {
    Green,
    Yellow,
    Red,
}

impl Shown {
    /// Red and yellow together are red: nobody drives off yet. Lights that are off let drivers go by the rules of the
    /// junction, and so does a green arrow after a stop.
    fn of(character: char) -> Option<Shown> {
        Some(match character {
            'G' | 'g' | 'O' | 'o' | 's' => Shown::Green,
            'y' | 'Y' => Shown::Yellow,
            'r' | 'R' | 'u' | 'U' => Shown::Red,
            _ => return None,
        })
    }
}

/// Adds the lights. Returns their programs.
pub(super) fn add(
    net: &Net,
    movements: &[Movement],
    rules: &mut Rules,
    problems: &mut Vec<Problem>,
) -> BTreeMap<Id, Program> {
    let programs = by_name(&net.programs);
    let mut lights: BTreeMap<(&str, usize), Vec<&Movement>> = BTreeMap::new();
    for movement in movements {
        if let Some((name, index)) = &movement.connection.light {
            lights.entry((name, *index)).or_default().push(movement);
        }
    }
    let mut found = BTreeMap::new();
    for ((name, index), movements) in lights {
        let id = Id::from(format!("{name}:{index}").as_str());
        rules.add_light(id, &movements.iter().map(|it| it.lanelet).collect::<Vec<_>>());
        let (what, remedy) = match programs.get(name).map(|it| program(it, index)) {
            Some(Some(program)) => {
                found.insert(id, program);
                continue;
            }
            Some(None) => (
                format!("the program of its light {name} has no sound state {index}, so it gets another one"),
                "give each phase a duration and a state of the letters G, g, y, r",
            ),
            None => {
                (format!("its light {name} has no program, so it gets one"), "add a tlLogic with this id")
            }
        };
        problems.push(movements[0].problem(&what, remedy));
    }
    found
}

/// The programs that run, by their names.
fn by_name(programs: &Programs) -> HashMap<&str, &LightProgram> {
    programs.all.iter().map(|it| (it.id.as_str(), it)).collect()
}

/// Replaces the programs of lights of `map` that `programs` names. Returns the names of programs that no light has, or
/// that are not sound.
pub(super) fn replace(map: &mut Map, programs: &Programs) -> Vec<String> {
    let named = by_name(programs);
    let mut wrong: BTreeSet<&str> = named.keys().copied().collect();
    let lights = map.rules.iter().filter(|it| it.kind == RuleKind::TrafficLight);
    for id in lights.map(|it| it.id) {
        let text = id.to_string();
        let Some((name, index)) = text.rsplit_once(':') else { continue };
        let Some((name, whole)) = named.get_key_value(name) else { continue };
        let part = index.parse().ok().and_then(|index| program(whole, index));
        if let Some(part) = part {
            wrong.remove(name);
            map.programs.insert(id, part);
        }
    }
    wrong.into_iter().map(str::to_owned).collect()
}

/// The part of a program for one movement.
fn program(whole: &LightProgram, index: usize) -> Option<Program> {
    let shown = |it: &LightPhase| Shown::of(it.state.chars().nth(index)?);
    let states: Vec<Shown> = whole.phases.iter().map(shown).collect::<Option<_>>()?;
    let cycle: f64 = whole.phases.iter().map(|it| it.duration).sum();
    let is_sound =
        whole.phases.iter().all(|it| it.duration > 0.0) && cycle.is_finite() && whole.offset.is_finite();
    if !is_sound || states.is_empty() {
        return None;
    }
    if states.iter().all(|it| *it == Shown::Green) {
        return Some(Program { cycle, phases: Vec::new() });
    }
    let mut from = whole.offset;
    let mut phases: Vec<Phase> = Vec::new();
    let count = states.len();
    for (number, (state, phase)) in states.iter().zip(&whole.phases).enumerate() {
        let before = states[(number + count - 1) % count];
        let until = from + phase.duration;
        match (state, phases.last_mut()) {
            (Shown::Green, Some(last)) if before == Shown::Green => last.to = until,
            (Shown::Green, _) => phases.push(Phase { from, to: until, yellow: 0.0 }),
            (Shown::Yellow, Some(last)) if before != Shown::Red => last.yellow += phase.duration,
            (Shown::Yellow, _) => phases.push(Phase { from, to: from, yellow: phase.duration }),
            (Shown::Red, _) => {}
        }
        from = until;
    }
    if phases.is_empty() {
        // It is always red.
        phases.push(Phase { from: 0.0, to: 0.0, yellow: 0.0 });
    }
    Some(Program { cycle, phases })
}

#[cfg(test)]
mod tests {
    use super::*;
    use laneweave_network::LightState;

    /// What a light with this index shows in each second of a cycle, after the states of phases of so many seconds.
    fn seconds(phases: &[(f64, &str)], index: usize, offset: f64) -> String {
        let phases = phases.iter().map(|it| LightPhase { duration: it.0, state: it.1.to_owned() }).collect();
        let whole = LightProgram { id: "J".into(), offset, phases };
        let program = program(&whole, index).expect("it is sound");
        let letter = |second: u32| match program.state(f64::from(second) + 0.5) {
            LightState::Green => 'G',
            LightState::Yellow => 'y',
            LightState::Red => 'r',
        };
        (0..program.cycle as u32).map(letter).collect()
    }

    #[test]
    fn each_second_shows_what_the_phases_say() {
        let phases = [(3.0, "Grs"), (2.0, "yrr"), (1.0, "rur"), (4.0, "rGr"), (1.0, "gyr")];
        assert_eq!(seconds(&phases, 0, 0.0), "GGGyyrrrrrG");
        assert_eq!(seconds(&phases, 1, 0.0), "rrrrrrGGGGy");
        assert_eq!(seconds(&phases, 2, 0.0), "GGGrrrrrrrr");
        assert_eq!(seconds(&phases, 0, 2.0), "rGGGGyyrrrr");
        assert_eq!(seconds(&[(5.0, "r"), (3.0, "r")], 0, 1.0), "rrrrrrrr");
        assert_eq!(seconds(&[(5.0, "G"), (3.0, "g")], 0, 1.0), "GGGGGGGG");
        assert_eq!(seconds(&[(2.0, "y"), (2.0, "r"), (1.0, "G"), (1.0, "y")], 0, 0.0), "yyrrGy");
        assert_eq!(seconds(&[(2.0, "r"), (2.0, "y"), (1.0, "G"), (1.0, "r")], 0, 0.0), "rryyGr");
    }

    #[test]
    fn a_program_that_is_not_sound_is_none() {
        let of = |state: &str, duration: f64| {
            let phases = vec![LightPhase { duration, state: state.to_owned() }];
            program(&LightProgram { id: "J".into(), offset: 0.0, phases }, 1)
        };
        assert!(of("GG", 5.0).is_some());
        assert_eq!(
            [of("G", 5.0), of("Gx", 5.0), of("GG", 0.0), of("GG", f64::NAN)],
            [None, None, None, None]
        );
    }
}
