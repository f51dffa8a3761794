//! Completions and manual pages.

use std::fs;
use std::process::Command;

use crate::command::program::Folder;

#[test]
fn every_shell_is_told_of_commands_styles_and_models() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = folder.laneweave(&format!("completions {shell}"));
        assert_eq!((run.code(), run.errors().as_str()), (0, ""));
        let expected: &[&str] = match shell {
            // These shells complete only the names of options.
            "elvish" | "powershell" => &["scenario", "--warmup"],
            _ => &["scenario", "warmup", "altruistic=1", "paper-conservative", "lmrs-lanes", "parquet"],
        };
        for word in expected {
            assert!(run.text().contains(word), "{shell}: {word}");
        }
    }
    let run = folder.laneweave("completions cmd");
    assert_eq!(run.code(), 2);
    assert!(run.errors().contains("[possible values: bash, elvish, fish, powershell, zsh]"));
}

#[test]
fn bash_reads_its_completions_and_completes_names() {
    let folder = Folder::new();
    let script = folder.laneweave("completions bash").text();
    fs::write(folder.path().join("c.sh"), script).unwrap();
    let complete = "source ./c.sh; COMP_WORDS=(laneweave run --model l); COMP_CWORD=3; \
                    _laneweave laneweave l --model; echo ${COMPREPLY[@]}";
    let bash = |arguments: &[&str]| Command::new("bash").args(arguments).current_dir(folder.path()).output();
    let Ok(checked) = bash(&["-n", "c.sh"]) else {
        eprintln!("skipped: no bash here");
        return;
    };
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
    let completed = bash(&["-c", complete]).unwrap();
    assert_eq!(String::from_utf8_lossy(&completed.stdout), "lmrs lmrs-lanes\n");
}

#[test]
fn every_command_has_a_page() {
    let folder = Folder::new();
    let run = folder.laneweave("man share/man1");
    assert_eq!((run.code(), run.errors().as_str()), (0, ""));
    let pages: Vec<_> = fs::read_dir(folder.path().join("share/man1")).unwrap().map(Result::unwrap).collect();
    assert_eq!(run.text(), format!("{} pages are written into share/man1\n", pages.len()));
    let names: Vec<String> = pages.iter().map(|it| it.file_name().into_string().unwrap()).collect();
    for name in ["laneweave.1", "laneweave-run.1", "laneweave-scenario-new.1", "laneweave-generate-grid.1"] {
        assert!(names.iter().any(|it| it == name), "{names:?}");
    }
    for page in pages {
        let text = fs::read_to_string(page.path()).unwrap();
        for section in [".SH NAME", ".SH SYNOPSIS", ".SH OPTIONS"] {
            assert!(text.contains(section), "{:?}: {section}", page.path());
        }
        // Warnings of the typesetter, if it is installed.
        let typeset = Command::new("groff").args(["-man", "-ww", "-z"]).arg(page.path()).output();
        if let Ok(typeset) = typeset {
            let warnings = String::from_utf8_lossy(&typeset.stderr).into_owned();
            assert!(typeset.status.success() && warnings.is_empty(), "{:?}: {warnings}", page.path());
        }
    }
}

#[test]
fn pages_need_a_folder() {
    let folder = Folder::new().with("taken", "");
    let run = folder.laneweave("man taken/man1");
    assert_eq!(run.code(), 2);
    assert!(run.errors().starts_with("error: taken/man1: cannot be created as the folder for the pages: "));
}
