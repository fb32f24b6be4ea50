//! The reader of MTL: values of all keys, and notes about what is left out.

use std::fs;

use lobe::shape::{MtlLibrary, MtlMaterial, parse_mtl, read_mtl};

use crate::folder;

pub fn parse(text: impl AsRef<[u8]>) -> MtlLibrary {
    parse_mtl("m.mtl", text.as_ref()).unwrap()
}

/// Materials without a note.
#[track_caller]
fn good(text: impl AsRef<[u8]>) -> Vec<MtlMaterial> {
    let library = parse(text);
    assert_eq!(library.notes, []);
    library.materials
}

const LINES: [&str; 22] = [
    "Kd 0.1 0.2 0.3",
    "Ks 0.4",
    "Ke 30 20 1e1",
    "Tf 1 0.5 .25",
    "Ns 96.078431",
    "Ni 1.45",
    "d 0.75",
    "Tr 0.25",
    "Pr 0.5",
    "Pm 1",
    "illum 7",
    "map_Kd a.png",
    "map_Ke b.png",
    "map_d c.png",
    "map_Pr d.png",
    "map_Pm e.png",
    "map_Bump f.png",
    "norm g.png",
    "# a comment",
    // Ambient light is passed over.
    "Ka 1 1 1",
    "map_Ka h.png",
    "",
];

fn assert_all(material: &MtlMaterial) {
    assert_eq!((material.kd, material.ks), (Some([0.1, 0.2, 0.3]), Some([0.4; 3])));
    assert_eq!((material.ke, material.tf), (Some([30.0, 20.0, 10.0]), Some([1.0, 0.5, 0.25])));
    let numbers = [material.ns, material.ni, material.d, material.tr, material.pr, material.pm];
    assert_eq!(numbers.map(Option::unwrap), [96.078_43, 1.45, 0.75, 0.25, 0.5, 1.0]);
    assert_eq!(material.illum, Some(7));
    let MtlMaterial { map_kd, map_ke, map_d, map_pr, map_pm, map_bump, norm, .. } = material;
    let maps = [map_kd, map_ke, map_d, map_pr, map_pm, map_bump, norm];
    let files = maps.map(|map| map.as_ref().unwrap().file.clone());
    assert_eq!(files.concat(), "a.pngb.pngc.pngd.pnge.pngf.pngg.png");
}

/// Seen to fail with `Ks`, `Pr` and `map_d` bound to a neighbour's field, and with keys or `newmtl` of one case alone.
#[test]
fn keys_stand_in_any_order_and_case() {
    for shift in 0..LINES.len() {
        let mut lines = LINES;
        lines.rotate_left(shift);
        if shift % 2 == 1 {
            lines.reverse();
        }
        let text = format!("newmtl x\n{}\n", lines.join("\n"));
        assert_all(&good(&text)[0]);
        let in_case = |change: fn(&str) -> String| {
            let line = |line: &str| match line.split_once(' ') {
                Some((key, rest)) => format!("\t {} \t{rest} ", change(key)),
                None => line.to_owned(),
            };
            text.lines().map(line).collect::<Vec<_>>().join("\r\n")
        };
        assert_all(&good(in_case(str::to_uppercase))[0]);
        assert_all(&good(in_case(str::to_lowercase))[0]);
    }
    for key in ["bump", "map_bump", "BUMP"] {
        assert!(good(format!("newmtl x\n{key} f.png"))[0].map_bump.is_some());
    }
    for key in ["norm", "map_Kn", "map_norm"] {
        assert!(good(format!("newmtl x\n{key} f.png"))[0].norm.is_some());
    }
    // Of one name the first is kept, with its lines alone.
    let kept = parse("newmtl x\nNs 1\nnewmtl\nNs 2\nnewmtl x\nNs 3\nnewmtl y\nNs 4").materials;
    let kept: Vec<_> = kept.iter().map(|material| (&*material.name, material.ns)).collect();
    assert_eq!(kept, [("x", Some(1.0)), ("y", Some(4.0))]);
    // Nothing is there that no line says, and the last line holds.
    assert_eq!(good("newmtl x")[0].kd, None);
    assert_eq!(good("newmtl x\nNs 1\nNs 2")[0].ns, Some(2.0));
}

/// Marks, ends of lines, comments and continuations are those of OBJ.
#[test]
fn text_may_be_written_in_many_ways() {
    let plain = "newmtl a b\nKd 0.25 0.5 1\nnewmtl c\nmap_Kd -s 2 3 4 x y.png\n";
    let expected = good(plain);
    let [a, c] = &expected[..] else { panic!("{expected:?}") };
    assert_eq!((&*a.name, a.line, &*c.name, c.line), ("a b", 1, "c", 3));
    for text in [
        plain.trim_end().to_owned(),
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        plain.replace('\n', " \t\n"),
        plain.replace('\n', " # a comment \\\n"),
        plain.replace("5 1", "5 \\\n 1").replace("c\nmap", "c \nmap"),
        format!("\u{FEFF}{plain}"),
    ] {
        let found = good(&text);
        let without_lines = |materials: &[MtlMaterial]| {
            materials.iter().map(MtlMaterial::without_lines).collect::<Vec<_>>()
        };
        assert_eq!(without_lines(&found), without_lines(&expected), "{text:?}");
    }
    assert_eq!(parse(""), MtlLibrary::default());
    assert_eq!(parse("# nothing\n\n\u{FEFF}"), MtlLibrary::default());
}

/// Seen to fail with names of files cut at blanks, and with bytes that are no UTF-8 replaced.
#[test]
fn names_are_of_any_text() {
    let names =
        |text: &[u8]| good(text).into_iter().map(|material| material.name).collect::<Vec<_>>();
    assert_eq!(
        names(b"newmtl  dark oak \t\nnewmtl Eiche (gro\xDF)\n"),
        ["dark oak", "Eiche (groß)"]
    );
    assert_eq!(names("newmtl Eiche (groß)".as_bytes()), ["Eiche (groß)"]);
    assert_eq!(names(b"newmtl \"x\"\nNEWMTL y"), ["\"x\"", "y"]);
    let file = |text: &[u8]| good([b"newmtl x\n", text].concat())[0].map_kd.clone().unwrap().file;
    assert_eq!(file(b"map_Kd B\xF6den\\my floor.jpg"), "Böden\\my floor.jpg");
    assert_eq!(file(b"map_Kd \"my floor.jpg\""), "my floor.jpg");
}

/// Seen to fail with `-o` read as `-s`, with `-mm` reversed, and with names cut at blanks.
#[test]
fn maps_have_options() {
    let map = |text: &str| good(format!("newmtl x\nmap_Kd {text}"))[0].map_kd.clone().unwrap();
    let all = map(
        "-blendu on -blendv off -boost 2 -cc on -clamp ON -imfchan l -mm 0.25 2 -o 1 2 3 -s 4 5 6 -t 7 8 9 \
         -texres 512 -type sphere -BM 0.5 a b.png",
    );
    assert_eq!((&*all.file, all.scale, all.offset), ("a b.png", [4.0, 5.0, 6.0], [1.0, 2.0, 3.0]));
    assert_eq!((all.base_gain, all.bump, all.is_clamped), ([0.25, 2.0], 0.5, true));
    assert_eq!(all.channel, Some('l'));
    let plain = map("a-s.png");
    assert_eq!((&*plain.file, plain.scale, plain.offset), ("a-s.png", [1.0; 3], [0.0; 3]));
    assert_eq!((plain.base_gain, plain.bump), ([0.0, 1.0], 1.0));
    assert_eq!((plain.is_clamped, plain.channel), (false, None));
    // Fewer numbers than an option may have; the last of two equal options holds.
    let fewer = map("-s 2 -o 0.5 0.25 -mm 0.5 -clamp on -clamp off -s 3 9.png");
    assert_eq!(
        (fewer.scale, fewer.offset, fewer.base_gain),
        ([3.0, 1.0, 1.0], [0.5, 0.25, 0.0], [0.5, 1.0])
    );
    assert_eq!((fewer.is_clamped, &*fewer.file), (false, "9.png"));
}

/// Many materials take time that grows with their number only.
#[test]
fn many_materials_are_read() {
    let text: String =
        (0..200_000).map(|i| format!("newmtl a material of a long name {i}\n")).collect();
    assert_eq!(good(text).len(), 200_000);
}

/// Files that cannot be read, with whole messages. Caught: a limit of no file.
#[test]
fn files_that_cannot_be_read() {
    let folder = folder("mtl-unreadable");
    let message = |name: &str| read_mtl(&folder.join(name)).unwrap_err().to_string();
    let at = |name: &str| folder.join(name).display().to_string();
    fs::create_dir(folder.join("folder.mtl")).unwrap();
    assert_eq!(message("no.mtl"), format!("{}: there is no such file", at("no.mtl")));
    assert_eq!(
        message("folder.mtl"),
        format!("{}: is a directory, expected an MTL file", at("folder.mtl"))
    );
    let long = [b"newmtl x\nKd ", &b"1".repeat(1 << 20)[..]].concat();
    fs::write(folder.join("long.mtl"), &long).unwrap();
    let expected = "cannot be read: a line is longer than 1 MiB: is it an MTL file?";
    assert_eq!(message("long.mtl"), format!("{}: {expected}", at("long.mtl")));
    // A comment may have any length.
    fs::write(folder.join("comment.mtl"), long.escape_ascii().to_string().replace("Kd", "#"))
        .unwrap();
    assert!(read_mtl(&folder.join("comment.mtl")).is_ok());
    // It has no blocks on the disk.
    fs::File::create(folder.join("large.mtl")).unwrap().set_len((128 << 20) + 1).unwrap();
    let expected = "cannot be read: it is larger than 128 MiB, the most that is read";
    assert_eq!(message("large.mtl"), format!("{}: {expected}", at("large.mtl")));
    #[cfg(unix)]
    {
        let pipe = folder.join("pipe.mtl");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        std::os::unix::fs::symlink("/dev/zero", folder.join("device.mtl")).unwrap();
        for name in ["pipe.mtl", "device.mtl"] {
            let expected =
                "cannot be read: it is a pipe, a socket or a device, expected an ordinary file";
            assert_eq!(message(name), format!("{}: {expected}", at(name)));
        }
    }
}
