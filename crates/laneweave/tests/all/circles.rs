//! Files that do not import each other in a circle, so that each can be read after those that it imports.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::crates::rust_files;

/// A module as the names that lead to it in its crate.
type Module = Vec<String>;

/// Crates, and modules in them: no file of these is part of a circle.
const WITHOUT: [(&str, &[&str]); 4] =
    [("maps", &[]), ("network", &[]), ("sim", &["step", "world"]), ("studies", &["fit"])];

/// The module that a file of `source` is.
fn module(source: &Path, file: &Path) -> Module {
    let below = file.strip_prefix(source).expect("it is in there").with_extension("");
    let names = below.iter().map(|it| it.to_string_lossy().into_owned());
    names.filter(|it| !["mod", "lib", "main"].contains(&it.as_str())).collect()
}

/// The paths in a text that begin with `crate` or `super`; of a group each one.
fn paths(text: &str) -> Vec<Vec<&str>> {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let is_name = |it: char| it.is_alphanumeric() || it == '_';
    let mut found = Vec::new();
    for (at, start) in code.match_indices("crate::").chain(code.match_indices("super::")) {
        if code[..at].ends_with("::") || code[..at].ends_with(is_name) {
            continue;
        }
        let mut path = Vec::new();
        let mut rest = &code[at..];
        while let Some((name, after)) = rest.split_once("::").filter(|(name, _)| name.chars().all(is_name)) {
            path.push(name);
            rest = after;
        }
        assert_eq!(path[0], &start[..5]);
        let items = match rest.strip_prefix('{') {
            Some(group) => group.split('}').next().unwrap_or_default(),
            None => rest.split(|it| !is_name(it)).next().unwrap_or_default(),
        };
        for item in items.split(',') {
            let name = item.trim().split(|it| !is_name(it)).next().unwrap_or_default();
            found.push(path.iter().copied().chain([name]).collect());
        }
    }
    found
}

/// The module to which `path` leads from module `own`; none if that is the root of the crate, or another crate.
fn target(own: &[String], path: &[&str], modules: &BTreeSet<Module>) -> Option<Module> {
    let up = path.iter().take_while(|it| **it == "super").count();
    let mut full: Module = own[..if up > 0 { own.len().saturating_sub(up) } else { 0 }].to_vec();
    full.extend(path[up.max(1)..].iter().map(|it| it.to_string()));
    (1..=full.len()).rev().map(|count| full[..count].to_vec()).find(|it| modules.contains(it))
}

/// For each module of a crate those that it imports.
fn imports(source: &Path) -> BTreeMap<Module, BTreeSet<Module>> {
    let files: Vec<(Module, PathBuf)> =
        rust_files(source).into_iter().map(|file| (module(source, &file), file)).collect();
    let modules: BTreeSet<Module> = files.iter().map(|it| it.0.clone()).filter(|it| !it.is_empty()).collect();
    let mut imports = BTreeMap::new();
    for (own, file) in files.iter().filter(|it| !it.0.is_empty()) {
        let text = fs::read_to_string(file).expect("it is text");
        let code = text.lines().filter(|it| !it.trim_start().starts_with("//"));
        let code = code.collect::<Vec<_>>().join("\n");
        let there = paths(&code).into_iter().filter_map(|path| target(own, &path, &modules));
        imports.insert(own.clone(), there.filter(|it| it != own).collect());
    }
    imports
}

/// The modules that can be reached from `from`.
fn reachable(imports: &BTreeMap<Module, BTreeSet<Module>>, from: &Module) -> BTreeSet<Module> {
    let (mut reached, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(module) = open.pop() {
        open.extend(imports[module].iter().filter(|it| reached.insert((*it).clone())));
    }
    reached
}

#[test]
fn files_import_each_other_in_no_circle() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (name, part) in WITHOUT {
        let imports = imports(&crates.join(name).join("src"));
        let parts =
            imports.keys().filter(|it| it.iter().zip(part).filter(|(a, b)| a == b).count() == part.len());
        let parts: Vec<&Module> = parts.collect();
        assert!(!parts.is_empty() && imports.values().map(BTreeSet::len).sum::<usize>() > 40, "{name}");
        for module in parts {
            let others = reachable(&imports, module);
            let back = others.iter().find(|it| imports[*it].contains(module));
            assert!(!others.contains(module), "{name}: {module:?} imports what imports it, {back:?}");
        }
    }
}

#[test]
fn a_path_leads_to_the_module_that_it_names() {
    let found = paths("use crate::map::{Map, rule::Rule};\nlet it = super::super::size::Size(1); //");
    assert_eq!(found[0], ["crate", "map", "Map"]);
    assert_eq!(found[1], ["crate", "map", "rule"]);
    assert_eq!(found[2], ["super", "super", "size", "Size"]);
    let module = |names: &[&str]| -> Module { names.iter().map(|it| it.to_string()).collect() };
    let modules = BTreeSet::from([module(&["size"]), module(&["map", "rule"])]);
    let own = module(&["map", "rule"]);
    assert_eq!(target(&own, &found[1], &modules), Some(own.clone()));
    assert_eq!(target(&own, &found[2], &modules), Some(module(&["size"])));
    assert_eq!(target(&own, &["crate", "Map"], &modules), None);
}
