//! Help texts: their examples work, and they are readable.

use crate::command::program::{Folder, at_home, without_first_duration};

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
            // Output to the shell is dropped; files of the home folder are in the test's folder.
            let line = example.split(" > ").next().unwrap().replace("~/", "home/");
            let line = match line.split_whitespace().next() {
                // Experiments take minutes: the arguments are read, and nothing runs.
                Some("reproduce") => format!("{line} --help"),
                // It ends when the user says so, and has tests of its own.
                Some("view") => format!("{line} --help"),
                // Fits take a minute, and have tests of their own.
                Some("fit") if !line.contains("--plan") => format!("{line} --plan"),
                // For other commands the results are used.
                Some("run")
                    if ["explain", "branch", "render", "observe", "recording join", "replay", "fit"]
                        .contains(&command.as_str()) =>
                {
                    line
                }
                // One second is enough for the test.
                Some("run") => format!("{line} --duration 1 --warmup 0").replace("--warmup 240", ""),
                None => "run scenarios/demo.toml --duration 1".into(),
                Some(_) => line,
            };
            // An option given twice would have its last value: that of the example has priority.
            let line = without_first_duration(&line);
            let run = folder.laneweave(&line);
            let errors = run.errors();
            // In our towns drivers take turns at the limit, too; and without a demand, the default is reported.
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
        // A paragraph with line breaks by hand and by the program has a short line in its middle.
        let (_, notes) = help.split_once("-h, --help").unwrap();
        let prose = notes.split("\nExamples:").next().unwrap().lines().skip(1).collect::<Vec<_>>();
        for pair in prose.windows(2).filter(|it| it.iter().all(|line| !line.is_empty())) {
            let is_broken = pair[0].len() < WIDTH / 2 && !pair[0].starts_with(' ');
            assert!(!is_broken, "{command}: {}", pair[0]);
        }
    }
}
