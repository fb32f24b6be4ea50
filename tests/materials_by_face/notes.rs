//! Notes about what is left out of MTL files.

use crate::mtl::parse;

fn notes(text: impl AsRef<[u8]>) -> Vec<String> {
    parse(text).notes.iter().map(|note| note.to_string()).collect()
}

/// Each note whole, with its line. Seen to fail with negative colours and with models above 10 taken. Caught: fractions of any size
/// without a note.
#[test]
fn what_is_left_out_is_noted() {
    let color = "expected one or three numbers that are finite and not negative; it is left out";
    let number = "expected a finite number; it is left out";
    let map = "expected options with their numbers, and the name of an image; it is left out";
    for (line, note) in [
        ("shine 3", "the key `shine` is not known".into()),
        ("map_Ks a.png", "the key `map_Ks` is not known".into()),
        ("Kd", format!("Kd is ``, {color}")),
        ("Kd 1 2", format!("Kd is `1 2`, {color}")),
        ("Kd 1 2 3 4", format!("Kd is `1 2 3 4`, {color}")),
        ("Kd 1 -0.5 1", format!("Kd is `1 -0.5 1`, {color}")),
        ("kD 1 nan 1", format!("kD is `1 nan 1`, {color}")),
        ("Ke inf", format!("Ke is `inf`, {color}")),
        ("Ks 1e39 0 0", format!("Ks is `1e39 0 0`, {color}")),
        ("Kd spectral gold.rfl", format!("Kd is `spectral gold.rfl`, {color}")),
        ("Tf xyz 1 1 1", format!("Tf is `xyz 1 1 1`, {color}")),
        ("Kd 0,5 0,5 0,5", format!("Kd is `0,5 0,5 0,5`, {color}")),
        ("Ns high", format!("Ns is `high`, {number}")),
        ("Ns", format!("Ns is ``, {number}")),
        ("Ni 1 2", format!("Ni is `1 2`, {number}")),
        ("d -halo 0.5", format!("d is `-halo 0.5`, {number}")),
        ("Tr inf", format!("Tr is `inf`, {number}")),
        ("Pr nan", format!("Pr is `nan`, {number}")),
        (
            "illum 2.0",
            "illum is `2.0`, expected a whole number from 0 to 10; it is left out".into(),
        ),
        ("illum -1", "illum is `-1`, expected a whole number from 0 to 10; it is left out".into()),
        ("illum 11", "illum is `11`, expected a whole number from 0 to 10; it is left out".into()),
        ("map_Kd", format!("map_Kd is ``, {map}")),
        ("map_Kd -s 1 1 1", format!("map_Kd is `-s 1 1 1`, {map}")),
        ("map_Kd -s a.png", format!("map_Kd is `-s a.png`, {map}")),
        ("map_Kd -o nan 1 a.png", format!("map_Kd is `-o nan 1 a.png`, {map}")),
        ("map_Kd -what 1 a.png", format!("map_Kd is `-what 1 a.png`, {map}")),
        ("map_Kd -", format!("map_Kd is `-`, {map}")),
        ("norm -bm", format!("norm is `-bm`, {map}")),
        ("\u{1b}[31m 1", "the key `\\u{1b}[31m` is not known".into()),
    ] {
        let text = format!("newmtl x\nNi 1.25\n{line}\nPm 0.5\n");
        assert_eq!(notes(&text), [format!("line 3: {note}")]);
        // The rest holds.
        let material = &parse(&text).materials[0];
        assert_eq!((material.pm, material.kd, material.ni), (Some(0.5), None, Some(1.25)));
    }
    // Fractions above 1 are kept, as products with images may be below.
    for line in ["Kd 2 0 0", "Ks 1.5", "Tf 0 0 3", "d 1.5", "Tr 2", "Pr 7", "Pm 1.01"] {
        let (key, value) = line.split_once(' ').unwrap();
        let text = format!("newmtl x\n{line}");
        let note = format!("line 2: {key} is `{value}`: what is above 1 counts as 1");
        assert_eq!(notes(&text), [note]);
    }
    assert_eq!(parse("newmtl x\nKd 2 0 0\nKe 9").materials[0].kd, Some([2.0, 0.0, 0.0]));
    assert_eq!(notes("newmtl x\nKd 1\nKs 1\nKe 9\nd 1\nNs 900\nNi 1.5"), [""; 0]);
    assert_eq!(
        notes("Kd 1 1 1\nnewmtl x\nnewmtl\nnewmtl x\n"),
        [
            "line 1: `Kd` stands above the first newmtl; it is left out",
            "line 3: a newmtl has no name: no face can have it",
            "line 4: material `x` stands there twice; the first one holds",
        ]
    );
}

/// The same thing once a file, at its first line, with a count. Seen to fail with a note for each line, and without a limit.
#[test]
fn notes_stand_once() {
    let lines = "shine 1\nPcr 1\nshine 1\nNs high\nNs low\n".repeat(1000);
    let text = format!("newmtl x\n{lines}{}", "newmtl x\n".repeat(999));
    assert_eq!(
        notes(format!("shine 1\n{text}")),
        [
            "line 1: `shine` stands above the first newmtl; it is left out",
            "line 3: the key `shine` is not known (the same in 1999 more lines)",
            "line 4: the key `Pcr` is not known (the same in 999 more lines)",
            "line 6: Ns is `high`, expected a finite number; it is left out (the same in 999 more lines)",
            "line 7: Ns is `low`, expected a finite number; it is left out (the same in 999 more lines)",
            "line 5003: material `x` stands there twice; the first one holds (the same in 998 more lines)",
        ]
    );
    assert_eq!(
        notes("newmtl x\na\nb\na\n"),
        [
            "line 2: the key `a` is not known (the same in 1 more line)",
            "line 3: the key `b` is not known"
        ]
    );
    // What is no MTL file takes a page, not all memory.
    let junk: String = (0..100_000).map(|i| format!("key{i} 1\n")).collect();
    let notes = notes(format!("newmtl x\n{junk}"));
    assert_eq!((notes.len(), &*notes[99]), (101, "line 101: the key `key99` is not known"));
    assert_eq!(notes[100], "line 102: 99900 more lines are not understood");
}
