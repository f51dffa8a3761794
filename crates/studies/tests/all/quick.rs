//! Experiments in small: they run, and what they find is the same for any number of threads.

use laneweave_studies::experiments::{EXPERIMENTS, Effort, Experiment, Finding};

fn found(experiment: &Experiment, threads: usize) -> Finding {
    let least = Effort { seeds: 1, length: 0.005, threads };
    experiment.run(&least).expect("built-in maps and styles")
}

/// Number of cells of a line of CSV.
fn cells(line: &str) -> usize {
    line.split('"').step_by(2).map(|it| it.matches(',').count()).sum::<usize>() + 1
}

#[test]
fn experiments_find_words_and_tables_and_threads_change_nothing() {
    // Those in towns take minutes in tests.
    let short = |it: &&Experiment| ["plausibility", "C1"].contains(&it.name);
    for experiment in EXPERIMENTS.iter().filter(short) {
        let finding = found(experiment, 2);
        assert!(finding.text.starts_with("# "), "{}", finding.text);
        assert!(!finding.tables.is_empty(), "{}", experiment.name);
        for (name, table) in &finding.tables {
            let mut lines = table.lines().map(cells);
            let header = lines.next().expect("a header");
            assert!(name.starts_with(experiment.name) && lines.all(|it| it == header), "{name}: {table}");
        }
        for (name, figure) in &finding.figures {
            assert!(name.starts_with(experiment.name) && figure.starts_with("<svg"), "{name}");
            assert!(!figure.contains("NaN"), "{name}");
        }
        if experiment.name == "C1" {
            assert_eq!(found(experiment, 1), finding);
        }
    }
}
