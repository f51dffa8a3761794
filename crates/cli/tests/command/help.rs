//! Help texts: what they show can be done, and they can be read.

use crate::program::{Folder, at_home, without_first_duration};

/// Longest line of a help text.
const WIDTH: usize = 100;

/// All commands with subcommands, as they are typed after the name of the program, each with its help text.
fn helps() -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut open = vec![String::new()];
    while let Some(command) = open.pop() {
        let text = Folder::new().laneweave(&format!("{command} --help")).text();
        let listed = text.split_once("\nCommands:\n").map_or("", |(_, rest)| rest);
        let names = listed.lines().take_while(|it| !it.is_empty()).filter(|it| !it.starts_with("   "));
        let names = names.filter_map(|it| it.split_whitespace().next()).filter(|it| *it != "help");
        open.extend(names.map(|it| format!("{command} {it}").trim_start().to_owned()));
        found.push((command, text));
    }
    assert!(found.len() > 15, "{found:?}");
    found
}

/// The command lines that a help text shows, without the name of the program.
fn examples(help: &str) -> Vec<&str> {
    let (_, text) = help.split_once("\nExamples:\n").unwrap_or_default();
    assert!(text.lines().all(|it| it.starts_with("  laneweave") || it.starts_with("  # ")), "broken: {text}");
    text.lines().filter_map(|it| it.strip_prefix("  laneweave")).collect()
}

#[test]
fn every_example_works() {
    for (command, help) in helps() {
        let folder = at_home();
        let shown = examples(&help);
        assert!((1..=4).contains(&shown.len()), "{command}: {help}");
        for example in shown {
            // What is written by way of the shell goes nowhere, and what lies at home lies here.
            let line = example.split(" > ").next().unwrap().replace("~/", "home/");
            let line = match line.split_whitespace().next() {
                // Others ask what became of it.
                Some("run") if ["explain", "branch"].contains(&command.as_str()) => line,
                // A second stands for all.
                Some("run") => format!("{line} --duration 1 --warmup 0").replace("--warmup 240", ""),
                None => "run scenarios/demo.toml --duration 1".into(),
                Some(_) => line,
            };
            // Said twice, the last one would not count: what the example says goes first.
            let line = without_first_duration(&line);
            let run = folder.laneweave(&line);
            let errors = run.errors();
            // In our towns drivers take turns at the limit, too; and where no demand is given, it is said.
            let is_quiet =
                errors.lines().all(|it| it.starts_with("warning: map: ") || it.contains("demand: "));
            assert!(run.code() == 0 && is_quiet, "{command}: laneweave {line}: {errors}");
        }
    }
}

#[test]
fn help_texts_fit_on_a_hundred_columns() {
    for (command, help) in helps() {
        for line in help.lines() {
            assert!(line.chars().count() <= WIDTH, "{command}: {line}");
        }
        // A paragraph that was broken by hand and again by the program has a short line in its midst.
        let (_, notes) = help.split_once("-h, --help").unwrap();
        let prose = notes.split("\nExamples:").next().unwrap().lines().skip(1).collect::<Vec<_>>();
        for pair in prose.windows(2).filter(|it| it.iter().all(|line| !line.is_empty())) {
            let is_broken = pair[0].len() < WIDTH / 2 && !pair[0].starts_with(' ');
            assert!(!is_broken, "{command}: {}", pair[0]);
        }
    }
}
