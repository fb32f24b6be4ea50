//! The order of the modules: no import goes from a lower room to a higher one, and no two files import each other.
//!
//! An import is a `use` or a path in the code, from one file of `src/` to the file that defines the item, through
//! all re-exports on the way. What `#[cfg(test)]` guards does not count, nor do comments and method calls.
//!
//! Parents and children: `mod child;` is no import, and neither is a re-export (`pub use child::Item;`, also with
//! `pub(crate)`) of a name that the parent's own code does not use. So a child may import what is defined in its parent's
//! `mod.rs`, if that only lists and re-exports the child. A parent that calls its child, while the child uses the
//! parent's types, is a circle like any other: the types belong in a file of their own, below both.
//!
//! `lib.rs` is the door for other crates: inside, `crate::room::Item` is written, never `crate::Item`.
//!
//! Breaks that these tests caught, one at a time: re-exports not followed; paths outside of `use` left out; names of
//! child modules without `self::` left out; test modules counted; a raw string's quotes taken for its end; a re-export
//! counted though unused, or not counted though used; names of `pub use child::*` taken for the parent's; two rooms exchanged in [`ROOMS`].

mod circles;
mod imports;
mod modules;
mod tokens;

use std::fmt::Write;
use std::path::Path;

use circles::circles;
use imports::{Found, imports};
use modules::Files;

/// The rooms from the ground up.
const ROOMS: [&str; 24] = [
    "simd",
    "spectrum",
    "clock",
    "file",
    "geometry",
    "params",
    "sampling",
    "image",
    "shape",
    "interaction",
    "texture",
    "bxdf",
    "material",
    "check",
    "light",
    "accel",
    "camera",
    "film",
    "scene",
    "integrator",
    "render",
    "scene_file",
    "metrics",
    "bin",
];

/// The room of a file in `src/`: its place in [`ROOMS`].
fn room(file: &str) -> usize {
    let name = file.trim_start_matches("src/").trim_end_matches(".rs");
    let name = name.split('/').next().unwrap_or_default();
    if name == "lib" {
        return ROOMS.len();
    }
    let place = ROOMS.iter().position(|&room| room == name);
    place.unwrap_or_else(|| panic!("{file}: the room `{name}` has no place in ROOMS"))
}

/// The files of `src/`.
fn sources() -> Files {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (mut files, mut folders) = (Files::new(), vec![root.join("src")]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("src is there") {
            let path = entry.expect("src can be listed").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let name = path
                    .strip_prefix(root)
                    .expect("it is in there")
                    .to_string_lossy()
                    .replace('\\', "/");
                files.insert(name, std::fs::read_to_string(&path).expect("it can be read"));
            }
        }
    }
    files
}

/// Files with names in a few words each.
fn files(texts: &[(&str, &str)]) -> Files {
    texts.iter().map(|&(file, text)| (file.into(), text.into())).collect()
}

/// `from -> to` for each two files.
fn pairs(found: &Found) -> Vec<String> {
    found.imports.keys().map(|(from, to)| format!("{from} -> {to}")).collect()
}

#[test]
fn no_files_import_each_other() {
    let found = imports(&sources());
    assert!(found.imports.len() > 100, "only {} imports were found", found.imports.len());
    let mut message = String::new();
    for circle in circles(&found.imports) {
        writeln!(message, "{} files: {:?}", circle.files.len(), circle.files).unwrap();
        for step in circle.shortest.windows(2) {
            let names = &found.imports[&(step[0].to_owned(), step[1].to_owned())];
            writeln!(message, "    {} -> {} {names:?}", step[0], step[1]).unwrap();
        }
    }
    assert!(message.is_empty(), "circles of imports:\n{message}");
}

#[test]
fn no_import_runs_up() {
    let mut message = String::new();
    for ((from, to), names) in imports(&sources()).imports {
        if room(&from) < room(&to) {
            writeln!(message, "{from} -> {to} {names:?}").unwrap();
        }
    }
    assert!(message.is_empty(), "imports that run up:\n{message}");
}

#[test]
fn no_import_goes_through_lib_rs() {
    let found = imports(&sources());
    assert!(found.through_the_door.is_empty(), "{:#?}", found.through_the_door);
}

#[test]
fn re_exports_lead_to_the_file_that_defines() {
    let found = imports(&files(&[
        ("src/lib.rs", "mod a; pub mod b; pub use b::Thing;"),
        ("src/a.rs", "use crate::b::{Thing as Other, deep::{self, Most}}; fn f() { deep::g() }"),
        ("src/b/mod.rs", "mod one; pub mod deep; pub use one::Thing;"),
        ("src/b/one.rs", "pub struct Thing;"),
        ("src/b/deep/mod.rs", "mod two; pub use two::*; pub fn g() {}"),
        ("src/b/deep/two.rs", "pub struct Most;"),
    ]));
    let expected = [
        "src/a.rs -> src/b/deep/mod.rs",
        "src/a.rs -> src/b/deep/two.rs",
        "src/a.rs -> src/b/one.rs",
    ];
    assert_eq!(pairs(&found), expected);
    assert!(found.through_the_door.is_empty());
}

#[test]
fn tests_comments_strings_and_visibility_are_no_imports() {
    let text = r##"
        //! [`crate::b::Thing`]
        /* use crate::b::Thing; /* nested */ use crate::b::Thing; */
        pub(in crate::b) const S: &str = r#"" use crate::b::Thing; "#;
        const C: [char; 2] = ['"', '\''];
        fn f<'a>(x: &'a str) -> impl Sized + use<'a> { x }
        #[cfg(test)]
        mod tests { use crate::b::Thing; fn f() { crate::b::g() } }
        #[cfg(test)]
        use crate::b::Thing;
    "##;
    let found =
        imports(&files(&[("src/lib.rs", "mod a; mod b;"), ("src/a.rs", text), ("src/b.rs", "")]));
    assert_eq!(pairs(&found), [""; 0]);
}

#[test]
fn parents_import_children_that_their_code_uses() {
    let child = ("src/a/child.rs", "use super::Base; pub struct Thing(Base); pub fn g() {}");
    let parent =
        |text: &str| imports(&files(&[("src/lib.rs", "mod a;"), ("src/a/mod.rs", text), child]));
    let up = "src/a/child.rs -> src/a/mod.rs";
    let down = "src/a/mod.rs -> src/a/child.rs";
    assert_eq!(pairs(&parent("mod child; pub(crate) use child::Thing; struct Base;")), [up]);
    for text in [
        "mod child; pub use child::Thing; struct Base; fn f(_: Thing) {}",
        "mod child; use child::Thing; struct Base;",
        "mod child; struct Base; fn f() { child::g() }",
        "mod child; struct Base; mod inner { fn f() { super::child::g() } }",
    ] {
        let found = parent(text);
        assert_eq!(pairs(&found), [up, down], "{text}");
        let circles = circles(&found.imports);
        assert_eq!(circles.len(), 1);
        assert_eq!(circles[0].shortest, ["src/a/child.rs", "src/a/mod.rs", "src/a/child.rs"]);
    }
}

#[test]
fn imports_through_lib_rs_are_found() {
    let found = imports(&files(&[
        ("src/lib.rs", "mod a; mod b; pub use b::Thing;"),
        ("src/a.rs", "use crate::Thing;\nuse super::Thing as Other;"),
        ("src/b.rs", "pub struct Thing;"),
        ("src/bin/lobe/main.rs", "use lobe::Thing;"),
    ]));
    assert_eq!(pairs(&found), ["src/a.rs -> src/b.rs", "src/bin/lobe/main.rs -> src/b.rs"]);
    let door: Vec<&String> = found.through_the_door.iter().collect();
    assert_eq!(door, ["src/a.rs: crate::Thing, line 1", "src/a.rs: super::Thing, line 2"]);
}

#[test]
fn the_shortest_circle_of_each_group_is_found() {
    let found = imports(&files(&[
        ("src/lib.rs", "mod a; mod b; mod c; mod d; mod e;"),
        ("src/a.rs", "use crate::b::B; pub struct A;"),
        ("src/b.rs", "use crate::c::C; use crate::d::D; pub struct B;"),
        ("src/c.rs", "use crate::a::A; pub struct C;"),
        ("src/d.rs", "use crate::b::B; use crate::e::E; pub struct D;"),
        ("src/e.rs", "pub struct E;"),
    ]));
    let circles = circles(&found.imports);
    assert_eq!(circles.len(), 1);
    assert_eq!(circles[0].files.len(), 4);
    assert_eq!(circles[0].shortest, ["src/b.rs", "src/d.rs", "src/b.rs"]);
}
