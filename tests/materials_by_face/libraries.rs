//! Which files `mtllib` lines and maps name.

use std::path::Path;

use lobe::shape::read_obj;

use crate::{folder, write};

/// The files of an OBJ file's libraries, relative to its folder.
fn libraries(folder: &Path, lines: &str) -> Vec<String> {
    write(folder, "m.obj", format!("{lines}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    let read = read_obj(&folder.join("m.obj")).unwrap();
    let relative = |file: &std::path::PathBuf| {
        file.strip_prefix(folder).unwrap_or(file).to_str().unwrap().to_owned()
    };
    read.materials.libraries.iter().map(relative).collect()
}

/// Seen to fail with words taken before the whole, and with the whole alone. Caught: one file twice.
#[test]
fn a_line_names_one_file_or_several() {
    let folder = folder("libraries-lines");
    for name in ["a.mtl", "b.mtl", "c.mtl", "a.mtl b.mtl", "deep/d.mtl"] {
        write(&folder, name, "newmtl x\n");
    }
    for (lines, expected) in [
        ("mtllib a.mtl", vec!["a.mtl"]),
        ("mtllib a.mtl\nmtllib b.mtl", vec!["a.mtl", "b.mtl"]),
        // There is a file of that name.
        ("mtllib a.mtl b.mtl", vec!["a.mtl b.mtl"]),
        ("mtllib b.mtl \t a.mtl deep/d.mtl", vec!["b.mtl", "a.mtl", "deep/d.mtl"]),
        // One is missing: the line is one name, which a message can show.
        ("mtllib b.mtl no.mtl", vec!["b.mtl no.mtl"]),
        ("mtllib no.mtl", vec!["no.mtl"]),
        ("mtllib deep\\no.mtl", vec!["deep/no.mtl"]),
        // One file, however it is named.
        (
            "mtllib a.mtl\nmtllib ./a.mtl\nmtllib deep/../a.mtl\nmtllib b.mtl A.MTL",
            vec!["a.mtl", "b.mtl"],
        ),
    ] {
        assert_eq!(libraries(&folder, lines), expected, "{lines}");
    }
}

/// As other programs and other systems write them. Seen to fail with backslashes kept, with case that counts, and with paths of
/// another computer.
#[test]
fn names_of_other_systems_are_found() {
    let folder = folder("libraries-names");
    for name in ["Deep Down/Möbel.MTL", "x.mtl", "X2.mtl", "x2.MTL"] {
        write(&folder, name, "newmtl x\n");
    }
    for (line, expected) in [
        ("Deep Down\\Möbel.MTL", "Deep Down/Möbel.MTL"),
        (".\\deep down\\MÖBEL.mtl", "Deep Down/Möbel.MTL"),
        ("Deep Down/../X.MTL", "Deep Down/../x.mtl"),
        // Exact before the first in the order of names.
        ("x2.MTL", "x2.MTL"),
        ("x2.mtl", "X2.mtl"),
        ("C:\\Users\\me\\room\\X.mtl", "x.mtl"),
        ("/home/me/room/x.mtl", "x.mtl"),
        // A folder is no library.
        ("Deep Down", "Deep Down"),
    ] {
        assert_eq!(libraries(&folder, &format!("mtllib {line}")), [expected], "{line}");
    }
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        let name = std::ffi::OsStr::from_bytes(b"B\xF6den.mtl");
        std::fs::write(folder.join(name), "newmtl x\n").unwrap();
        let text = b"mtllib B\xF6den.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        write(&folder, "latin.obj", text);
        let read = read_obj(&folder.join("latin.obj")).unwrap();
        assert_eq!(read.materials.libraries, [folder.join(name)]);
        // A folder whose name is no text.
        let odd = folder.join(std::ffi::OsStr::from_bytes(b"odd\xFF"));
        write(&odd, "a.mtl", "newmtl x\n");
        write(&odd, "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        let read = read_obj(&odd.join("a.obj")).unwrap();
        assert_eq!(read.materials.libraries, [odd.join("a.mtl")]);
    }
}
