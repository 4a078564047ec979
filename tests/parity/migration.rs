//! The names of this library in `docs/migration.md` exist.

use std::collections::BTreeSet;
use std::path::Path;

const DOCUMENT: &str = include_str!("../../docs/migration.md");

/// Public names of one source file, and all of its words.
struct Source {
    public: BTreeSet<String>,
    words: BTreeSet<String>,
}

impl Source {
    fn of(text: &str) -> Self {
        let words: Vec<&str> =
            text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|w| !w.is_empty()).collect();
        let mut public = BTreeSet::new();
        for (i, _) in words.iter().enumerate().filter(|(_, word)| **word == "pub") {
            let mut rest =
                words[i + 1..].iter().copied().skip_while(|w| ["async", "unsafe"].contains(w)).peekable();
            match rest.next() {
                // Constants and constant functions.
                Some("const") => {
                    rest.next_if_eq(&"fn");
                    public.extend(rest.next().map(str::to_owned));
                }
                Some("fn" | "struct" | "enum" | "trait" | "type" | "mod" | "static") => {
                    public.extend(rest.next().map(str::to_owned));
                }
                _ => {}
            }
        }
        let used = text.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
        for list in used {
            let words = list.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            public.extend(words.filter(|w| !w.is_empty()).map(str::to_owned));
        }
        Self { public, words: words.into_iter().map(str::to_owned).collect() }
    }
}

/// All source files of a crate.
fn sources(name: &str) -> Vec<Source> {
    fn gather(folder: &Path, found: &mut Vec<Source>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                gather(&path, found);
            } else if path.extension().is_some_and(|e| e == "rs") {
                found.push(Source::of(&std::fs::read_to_string(&path).unwrap()));
            }
        }
    }
    let mut found = Vec::new();
    gather(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("crates/raysect-{name}/src")), &mut found);
    found
}

/// What is missing of a path like `math::Point3D::vector_to`.
fn missing(sources: &[Source], path: &[&str]) -> Option<String> {
    let is_public = |name: &str| sources.iter().any(|s| s.public.contains(name));
    if let Some(name) = path.iter().find(|name| !is_public(name)) {
        return Some((*name).to_owned());
    }
    let [.., owner, name] = path else { return None };
    let is_type = owner.starts_with(char::is_uppercase);
    let together = sources.iter().any(|s| s.public.contains(*name) && s.words.contains(*owner));
    (is_type && !together).then(|| format!("{owner}::{name}"))
}

/// Paths in code type that begin with one of our crates.
fn paths(text: &str) -> Vec<Vec<&str>> {
    let crates = ["math", "core", "primitive", "optical", "observer"];
    let code = text.split('`').skip(1).step_by(2);
    code.map(|path| path.split("::").collect::<Vec<_>>())
        .filter(|path| path.len() > 1 && crates.contains(&path[0]))
        .collect()
}

fn faults(text: &str) -> Vec<String> {
    let paths = paths(text);
    let mut faults = Vec::new();
    for name in ["math", "core", "primitive", "optical", "observer"] {
        let sources = sources(name);
        for path in paths.iter().filter(|path| path[0] == name) {
            if let Some(missing) = missing(&sources, &path[1..]) {
                faults.push(format!("{}: {missing} is not there", path.join("::")));
            }
        }
    }
    faults
}

#[test]
fn every_name_in_the_table_exists() {
    let count = paths(DOCUMENT).len();
    assert!(count > 250, "{count}");
    let faults = faults(DOCUMENT);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn names_that_do_not_exist_are_told() {
    let wrong = "`math::Point3D::vector_too` `math::Sphere` `core::World::vector_to` `optical::library::shott` \
                 `primitive::mesh::oi::import_obj` `observer::Frame::save_everything`";
    assert_eq!(faults(wrong).len(), 6, "{:?}", faults(wrong));
    assert!(faults("`math::Point3D::vector_to` and `optical::library::schott`, `f64::clamp`").is_empty());
}

#[test]
fn the_rows_of_a_table_have_as_many_cells_as_its_head() {
    let cells = |line: &str| line.replace("\\|", "").matches('|').count();
    let mut head = None;
    for line in DOCUMENT.lines() {
        if !line.starts_with('|') {
            head = None;
            continue;
        }
        assert_eq!(cells(line), *head.get_or_insert(cells(line)), "{line}");
        assert_eq!(line.matches('`').count() % 2, 0, "{line}");
    }
}
