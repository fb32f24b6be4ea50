//! Reading OBJ: valid files, error messages for invalid ones, and that nothing panics.
//!
//! The comment of a test says with which deliberate break of the code it was seen to fail.

use std::fmt::Write;
use std::io::{self, BufReader, Read};
use std::path::PathBuf;

use lobe::glam::{Vec2, Vec3, vec2, vec3};
use lobe::shape::{MeshError, ObjMesh, SkippedLines, TriangleMesh, parse_obj, read_obj};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn parse(text: impl AsRef<[u8]>) -> ObjMesh {
    let text = text.as_ref();
    let shown = String::from_utf8_lossy(text);
    let read = parse_obj("m.obj", text).unwrap_or_else(|e| panic!("{e}\n{shown}"));
    assert_eq!(read.mesh.check(), Ok(()), "{shown}");
    read
}

fn refusal(text: impl AsRef<[u8]>) -> String {
    parse_obj("m.obj", text.as_ref()).expect_err("refused").to_string()
}

fn square() -> TriangleMesh {
    TriangleMesh {
        positions: vec![Vec3::ZERO, Vec3::X, vec3(1.0, 1.0, 0.0), Vec3::Y],
        indices: vec![[0, 1, 2], [0, 2, 3]],
        ..Default::default()
    }
}

// Broken by: cutting polygons into strips; negative indices off by one.
#[test]
fn polygons_become_fans() {
    assert_eq!(parse(format!("{SQUARE}f 1 2 3 4")).mesh, square());
    assert_eq!(parse(format!("{SQUARE}f -4 -3 -2 -1")).mesh, square());
    // Negative indices count from their own line, not from the end of the file.
    assert_eq!(
        parse(format!("{SQUARE}f -4 -3 -2\nv 7 8 9\nf -5 -3 -2\n")).mesh.indices,
        [[0, 1, 2], [0, 2, 3]]
    );
    let six = parse(format!("{SQUARE}v -1 1 0\nv -1 0 0\nf 1 2 3 4 5 6\n"));
    assert_eq!(six.mesh.indices, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
}

// Broken by: leaving out the byte order mark, the lone CR, CR LF as one end, or the backslash.
#[test]
fn text_may_be_written_in_many_ways() {
    let plain = format!("{SQUARE}f 1 2 3 4\n");
    for text in [
        plain.trim_end().to_owned(),
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        plain.replace('\n', "\n\r"),
        plain.replace('\n', " \t\n\n"),
        plain.replace('\n', " # a comment \\\n"),
        plain.replace('\n', "#\n"),
        plain.replace(' ', "\t \x0B\x0C"),
        plain.replace(' ', " \\\n "),
        plain.replace(' ', " \\ \r\n"),
        plain.replace("f 1", "  f +1"),
        format!("\u{FEFF}{plain}"),
        format!("\u{FEFF}{}\\", plain.trim_end()),
    ] {
        assert_eq!(parse(&text).mesh, square(), "{text:?}");
        // The same through a buffer that cuts every line to pieces.
        let read = parse_obj("m.obj", BufReader::with_capacity(1, text.as_bytes()));
        assert_eq!(read.unwrap().mesh, square(), "{text:?}");
    }
}

// Broken by: reading `l` lines as faces.
#[test]
fn names_materials_and_other_elements_are_passed_over() {
    let mut text = b"# caf\xE9\nmtllib nowhere\xE9.mtl\nmtllib\no caf\xE9\n".to_vec();
    text.extend(SQUARE.bytes());
    text.extend(b"g \xE9t\xE9 f\nusemtl vernis \xE0 ongles\nusemtl\ns \xE9\nf 1 2 3 # \xE9\no\n");
    text.extend(b"p 1 2\nl 1 2 3\nl 99\nvp 0.5 x\ncurv 0 1 99\nfoo\nF 1 2\nf 1 3 4\n");
    assert_eq!(parse(&text).mesh, square());
}

// Broken by: giving corners without a normal the first one; swapping texture coordinates and
// normals.
#[test]
fn normals_may_be_partial() {
    let lists = format!("{SQUARE}vt 0.25 0.5\nvt 1 0\nvn 0 0 2\nvn 0 0 0\n");
    let some = parse(format!("{lists}f 1 2//1 3//2\n")).mesh;
    assert_eq!(some.normals, [Vec3::ZERO, Vec3::Z, Vec3::ZERO, Vec3::ZERO]);
    assert_eq!(some.uvs, []);
    let some = parse(format!("{lists}f 1 2/2 3/-2\nf 1 3/1 4//\n")).mesh;
    assert_eq!(some.uvs, [Vec2::ZERO, vec2(1.0, 0.0), vec2(0.25, 0.5), Vec2::ZERO]);
    assert_eq!(some.normals, []);
    assert_eq!(some.indices, square().indices);
    // Only faces before and after have any.
    let some = parse(format!("{lists}f 1 2 3\nf 1/1/1 3/1/1 4/1/1\nf 1 2 4\n")).mesh;
    assert_eq!(some.positions[4..], [Vec3::ZERO, vec3(1.0, 1.0, 0.0), Vec3::Y]);
    assert_eq!(some.normals[2..], [Vec3::ZERO, Vec3::Z, Vec3::Z, Vec3::Z, Vec3::ZERO]);
    let uv = vec2(0.25, 0.5);
    assert_eq!(some.uvs[2..], [Vec2::ZERO, uv, uv, uv, Vec2::ZERO]);
    assert_eq!(some.indices, [[0, 1, 2], [4, 5, 3], [0, 1, 6]]);
}

// Broken by: `normal.normalize()` without scaling; keeping normals that are all zero.
#[test]
fn normals_get_unit_length() {
    let text = "vn 3e-30 0 4e-30\nvn 0 3e38 0\nvn 1e-45 0 0\nf 1//1 2//2 3//3\n";
    let normals = parse(format!("{SQUARE}{text}")).mesh.normals;
    assert!(normals[0].abs_diff_eq(vec3(0.6, 0.0, 0.8), 1e-6), "{}", normals[0]);
    assert_eq!(normals[1..], [Vec3::Y, Vec3::X, Vec3::ZERO]);
    // All that are named are zero; the one that is not is not named.
    let zero = parse(format!("{SQUARE}vn 0 -0 0\nvn 1 0 0\nf 1//1 2//1 3//1\n"));
    assert_eq!(zero.mesh.normals, []);
}

// Broken by: sending whole `v` lines on, so that tobj divides by w.
#[test]
fn further_numbers_are_passed_over() {
    for more in [" 2", " 0", " 0.1 0.2 0.3", " 1 0.1 0.2 0.3", " 0.5 0.5"] {
        let text = SQUARE.replace('\n', &format!("{more}\n"));
        assert_eq!(parse(text + "f 1 2 3 4").mesh, square(), "{more}");
    }
    let uvs = parse(format!("{SQUARE}vt 0.5\nvt 1 2 3\nf 1/1 2/2 3/2")).mesh.uvs;
    assert_eq!(uvs[..3], [vec2(0.5, 0.0), vec2(1.0, 2.0), vec2(1.0, 2.0)]);
}

// Broken by: checking positive indices at their own line.
#[test]
fn faces_may_come_first() {
    let forward = parse(format!("f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n{SQUARE}vn 0 0 1"));
    assert_eq!(forward.mesh, TriangleMesh { normals: vec![Vec3::Z; 4], ..square() });
}

// Broken by: leaving out the sort; swapping texture coordinates and normals.
#[test]
fn corners_share_a_vertex_if_all_their_indices_agree() {
    // A tent: two flat sides share an edge, and each gets its own copy of it.
    let text = format!(
        "{SQUARE}vn 1 0 0\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\nf 4//2 3//2 1//2\n"
    );
    let mesh = parse(text).mesh;
    assert_eq!(mesh.indices, [[0, 1, 2], [4, 5, 3], [3, 5, 4]]);
    assert_eq!(mesh.positions[4..], [Vec3::ZERO, vec3(1.0, 1.0, 0.0)]);
    assert_eq!(mesh.normals, [Vec3::X, Vec3::X, Vec3::X, Vec3::Y, Vec3::Y, Vec3::Y]);
}

// Broken by: an f32 cross product (the tiny triangle); counting used vertices.
#[test]
fn report_counts_what_is_odd() {
    let text =
        "v 0 0 0\nv 1 1 1\nv 3 3 3\nv 9 9 9\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\nf 1 1 2\nf 1 5 6\n";
    let read = parse(text);
    assert_eq!((read.report.degenerate_triangles, read.report.unused_vertices), (2, 1));
    assert_eq!((read.mesh.indices.len(), read.mesh.positions.len()), (3, 6));
}

/// Count and first line.
fn skipped(lines: SkippedLines) -> (usize, u64) {
    (lines.count, lines.first)
}

// Broken by: refusing such a face; the line of the last one.
#[test]
fn faces_with_few_corners_are_skipped_and_counted() {
    let read = parse(format!("{SQUARE}f 1 2\nf\nf 1 2 3\nf 1/ # 2 3\nf 1 3 4"));
    assert_eq!(read.mesh, square());
    assert_eq!(skipped(read.report.short_faces), (3, 5));
    assert_eq!(skipped(parse(format!("{SQUARE}f 1 2 3 4")).report.short_faces), (0, 0));
    // What they refer to has to exist all the same.
    assert_eq!(
        refusal(format!("{SQUARE}f 1 2 3\nf 1 9")),
        "m.obj:6: face refers to vertex 9, but the file has only 4 vertices"
    );
    assert_eq!(
        refusal(format!("{SQUARE}f 1 2")),
        "m.obj: has no faces: expected at least one line such as \"f 1 2 3\", found only 4 vertices"
    );
}

// Broken by: counting nothing; a keyword missing in the list; blank lines counted.
#[test]
fn unknown_keywords_are_skipped_and_counted() {
    let read = parse(format!("# vv\n{SQUARE}\nvv 0 0 0\n  F 1 2 3\nv0 0 0\nf 1 2 3 4\n"));
    assert_eq!(read.mesh, square());
    assert_eq!(skipped(read.report.unknown_lines), (3, 7));
    // The statements of the specification, which are no mistakes.
    let known = "g s mg o p l vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con bevel c_interp \
                 d_interp lod usemtl mtllib usemap maplib shadow_obj trace_obj ctech stech call csh bsp bzp cdc cdp res";
    let lines: String = known.split(' ').map(|keyword| format!("{keyword} 1 2 3\n")).collect();
    let read = parse(format!("{lines}{SQUARE}f 1 2 3 4\n \t\n"));
    assert_eq!(read.mesh, square());
    assert_eq!(skipped(read.report.unknown_lines), (0, 0));
}

// Broken by: byte order marks looked for at the start of the file alone, which lost a vertex.
#[test]
fn joined_files_keep_their_first_lines() {
    let bom = "\u{FEFF}";
    let text = format!(
        "{bom}v 0 0 0\n{bom}v 1 0 0\n{bom}{bom}v 1 1 0 # x\nv 0 \\\n{bom}1 0\n{bom}f 1 2 3 4"
    );
    for text in [text.clone(), text.replace('\n', "\r\n"), text.replace('\n', "\r")] {
        let read = parse(&text);
        assert_eq!(read.mesh, square(), "{text:?}");
        assert_eq!(skipped(read.report.unknown_lines), (0, 0), "{text:?}");
    }
}

// Broken by: a limit that comments count for, that continuations do not, or that is one byte less. Without a limit, the
// endless file fills the memory.
#[test]
fn long_lines_are_refused_and_long_comments_are_not() {
    const MIB: usize = 1 << 20;
    let too_long =
        "m.obj:5: line is longer than 1 MiB, which is the most an OBJ file may have: is it one?";
    let corners = " 1 2 3 4".repeat(25_000);
    assert_eq!(parse(format!("{SQUARE}f{corners}")).mesh.indices.len(), 99_998);
    let face = |length: usize| format!("{SQUARE}f 1 2 3 4{}", " ".repeat(length - 9));
    assert_eq!(parse(face(MIB)).mesh, square());
    assert_eq!(refusal(face(MIB + 1)), too_long);
    assert_eq!(refusal(format!("{SQUARE}f 1 2 3 4{}", " \\\n".repeat(MIB / 2))), too_long);
    let comment = "#".repeat(3 * MIB);
    for end in ["\n", "\r", "\r\n"] {
        let text = format!("{comment}{end}{SQUARE}f 1 2 {comment}\\{end}f 1 2 3 4 {comment}");
        let read = parse(text);
        assert_eq!(read.mesh, square());
        assert_eq!(skipped(read.report.short_faces), (1, 6));
    }
    let endless = BufReader::new(SQUARE.as_bytes().chain(io::repeat(0)));
    assert_eq!(parse_obj("m.obj", endless).unwrap_err().to_string(), too_long);
}

/// A pseudo-random generator (splitmix64); each trial has its own.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (x ^ (x >> 31)) as usize % n
    }
}

/// A file with these numbers of vertices, texture coordinates and normals, whose faces use all of them, in all
/// notations that tobj understands.
fn any_obj(counts: [usize; 3], faces: usize, random: &mut Random) -> String {
    let mut text = String::new();
    for (key, numbers, count) in [("v", 3, counts[0]), ("vt", 2, counts[1]), ("vn", 3, counts[2])] {
        for _ in 0..count {
            text += key;
            for _ in 0..numbers {
                write!(text, " {}e-3", random.below(20_000) as f32 / 7.0 + 1.0).unwrap();
            }
            text += "\n";
        }
    }
    for _ in 0..faces {
        text += "f";
        for _ in 0..3 + random.below(4) {
            for (kind, &count) in counts.iter().enumerate() {
                text += ["\t", "/", "/"][kind];
                if count > 0 {
                    let back = random.below(2) * (count + 1);
                    write!(text, "{}", (1 + random.below(count)) as i64 - back as i64).unwrap();
                }
            }
        }
        text += "\n";
    }
    text
}

// Broken by: `take(left)` left out or one more; comparing copies by vertex alone; closing faces
// without a line end. The sizes lie around that of the closing faces.
#[test]
fn every_corner_is_what_plain_tobj_reads() {
    let options = tobj::LoadOptions { triangulate: true, single_index: true, ..Default::default() };
    let sizes = [1, 2, 3, 5, 1023, 1024, 1025, 1026, 2049, 3000];
    for trial in 0..60 {
        let random = &mut Random(trial);
        let mut size = |least: usize| sizes[random.below(sizes.len())] * least.max(random.below(2));
        let counts = [size(1), size(0), size(0)];
        let text = any_obj(counts, 2000, random);
        let read = parse(&text);
        let theirs =
            tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| unreachable!()).unwrap();
        let (ours, theirs) = (read.mesh, &theirs.0[0].mesh);

        assert_eq!(ours.indices.len() * 3, theirs.indices.len(), "trial {trial}");
        assert_eq!(ours.normals.is_empty(), theirs.normals.is_empty(), "trial {trial}");
        assert_eq!(ours.uvs.is_empty(), theirs.texcoords.is_empty(), "trial {trial}");
        let mut distinct = std::collections::HashSet::new();
        for (i, (&a, &b)) in ours.indices.as_flattened().iter().zip(&theirs.indices).enumerate() {
            let (a, b) = (a as usize, b as usize);
            distinct.insert(a);
            assert_eq!(
                ours.positions[a],
                Vec3::from_slice(&theirs.positions[3 * b..]),
                "trial {trial}, corner {i}"
            );
            if !ours.uvs.is_empty() {
                assert_eq!(
                    ours.uvs[a],
                    Vec2::from_slice(&theirs.texcoords[2 * b..]),
                    "trial {trial}, corner {i}"
                );
            }
            if !ours.normals.is_empty() {
                let theirs = Vec3::from_slice(&theirs.normals[3 * b..]).normalize();
                assert!(ours.normals[a].abs_diff_eq(theirs, 1e-6), "trial {trial}, corner {i}");
            }
        }
        // As many vertices in use as there are different corners, and only the file's own unused.
        assert_eq!(distinct.len() * 3, theirs.positions.len(), "trial {trial}");
        assert_eq!(
            ours.positions.len() - distinct.len(),
            read.report.unused_vertices,
            "trial {trial}"
        );
    }
}

// Broken by: naming the last part of a continued line; letting pass index 0, NaN, a
// no-break space, one index too many at either end; `1.#IND` cut at its comment sign.
#[test]
fn wrong_lines_are_refused_with_their_place() {
    let cases: &[(&str, &str)] = &[
        ("f 1 2 0", "m.obj:5: face refers to vertex 0, but OBJ counts from 1"),
        (
            "vt 1 1\nf 1/1 2/0 3/1",
            "m.obj:6: face refers to texture coordinate 0, but OBJ counts from 1",
        ),
        ("f 1 2 3//0", "m.obj:5: face refers to normal 0, but OBJ counts from 1"),
        (
            "\nf 1 2 99\nf 1 2 100",
            "m.obj:6: face refers to vertex 99, but the file has only 4 vertices",
        ),
        (
            "f 1 2 3\nf 1 2 5\nf 1 2 9\nv 1 1 1",
            "m.obj:7: face refers to vertex 9, but the file has only 5 vertices",
        ),
        (
            "f 1 2 4294967297",
            "m.obj:5: face refers to vertex 4294967297, but the file has only 4 vertices",
        ),
        (
            "f 1/1 2 3",
            "m.obj:5: face refers to texture coordinate 1, but the file has no texture coordinates",
        ),
        (
            "vn 1 0 0\nf 1//1 2//1 3//2",
            "m.obj:6: face refers to normal 2, but the file has only 1 normal",
        ),
        (
            "f 1 2 -5\nv 1 1 1",
            "m.obj:5: face refers to vertex -5, but only 4 vertices stand above it",
        ),
        (
            "vt 1 1\nf 1/1 2/-2 3/1",
            "m.obj:6: face refers to texture coordinate -2, but only 1 texture coordinate stands above it",
        ),
        (
            "f 1//-1 2 3\nvn 1 0 0",
            "m.obj:5: face refers to normal -1, but no normals stand above it",
        ),
        (
            "f 1 2 3.0",
            "m.obj:5: face has \"3.0\" where a corner v, v/vt, v//vn or v/vt/vn is expected",
        ),
        (
            "f 1 2 3/4/5/6",
            "m.obj:5: face has \"3/4/5/6\" where a corner v, v/vt, v//vn or v/vt/vn is expected",
        ),
        (
            "f 1 2 /1/1",
            "m.obj:5: face has \"/1/1\" where a corner v, v/vt, v//vn or v/vt/vn is expected",
        ),
        (
            "f 1 2 3/-/1",
            "m.obj:5: face has \"3/-/1\" where a corner v, v/vt, v//vn or v/vt/vn is expected",
        ),
        (
            "f 1 2 \u{E9}\"",
            "m.obj:5: face has \"é\\\"\" where a corner v, v/vt, v//vn or v/vt/vn is expected",
        ),
        (
            "f 1 2 9999999999999999999",
            "m.obj:5: face has \"9999999999999999999\" where a corner v, v/vt, v//vn or v/vt/vn is expected",
        ),
        ("v 1 2\nf 1 2 3", "m.obj:5: v has 2 of the 3 numbers it needs"),
        ("v", "m.obj:5: v has 0 of the 3 numbers it needs"),
        ("vn 1 2 # 3", "m.obj:5: vn has 2 of the 3 numbers it needs"),
        ("vt\nf 1 2 3", "m.obj:5: vt has 0 of the 2 numbers it needs"),
        ("# one\nv 1,5 2 3\nf 1 2 3", "m.obj:6: v has \"1,5\" where a number is expected"),
        ("vt 1 two\nf 1 2 3", "m.obj:5: vt has \"two\" where a number is expected"),
        (
            "vn 1 \\\n \\\n 1.#IND 0\nf 1 2 3",
            "m.obj:5: vn has \"1.#IND\" where a number is expected",
        ),
        ("v 1\u{A0}2 3 4\nf 1 2 3", "m.obj:5: v has \"1\\u{a0}2\" where a number is expected"),
        ("v \u{A0} 3 4\nf 1 2 3", "m.obj:5: v has \"\\u{a0}\" where a number is expected"),
        (
            "v 1 2 3-4-5-6-7-8-9-10-11-12-13-14-15-16-17-18-19-20-21-22-23-24-25",
            "m.obj:5: v has \"3-4-5-6-7-8-9-10-11-12-13-14-1…16-17-18-19-20-21-22-23-24-25\" where a number is expected",
        ),
        (
            "v 1 nan 2\nf 1 2 3",
            "m.obj:5: vertex 5 is (1, NaN, 2), expected finite numbers up to 1e12",
        ),
        (
            "v 1 -2e12 2\nf 1 2 3",
            "m.obj:5: vertex 5 is (1, -2000000000000, 2), expected finite numbers up to 1e12",
        ),
        (
            "f 1 2 3\n\nvt 0 0\nvt -inf 2 7",
            "m.obj:8: texture coordinate 2 is (-inf, 2), expected finite numbers",
        ),
        ("vn 1 2 1e39\nf 1 2 3", "m.obj:5: normal 1 is (1, 2, inf), expected finite numbers"),
    ];
    for (text, message) in cases {
        assert_eq!(refusal(format!("{SQUARE}{text}")), *message);
        // Whatever the line ends are.
        assert_eq!(refusal(format!("{SQUARE}{text}\n").replace('\n', "\r\n")), *message);
    }
    assert_eq!(
        refusal(b"v 1 2 3\n\nv 1 caf\xE9 2\n"),
        "m.obj:3: v line holds the byte 0xE9, which is not UTF-8, expected numbers"
    );
    assert_eq!(
        refusal(b"f 1 2 \xFF\n"),
        "m.obj:1: f line holds the byte 0xFF, which is not UTF-8, expected numbers"
    );
    assert_eq!(
        refusal(b"\xFF\xFEv\x00 \x000\x00"),
        "m.obj:1: text is UTF-16, expected UTF-8: save the file in that encoding"
    );
}

// Broken by: not looking for faces; reading `l` lines as faces.
#[test]
fn files_without_faces_are_refused() {
    let message = |found| {
        format!(
            "m.obj: has no faces: expected at least one line such as \"f 1 2 3\", found {found}"
        )
    };
    assert_eq!(refusal(""), message("no vertices"));
    assert_eq!(refusal("\u{FEFF}"), message("no vertices"));
    assert_eq!(refusal("\u{7F}ELF\0\0 f 1 2 3"), message("no vertices"));
    assert_eq!(refusal("v 0 0 0\nl 1 1\n"), message("only 1 vertex"));
    assert_eq!(refusal(SQUARE), message("only 4 vertices"));
}

/// A folder for one test, removed with its contents in the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("lobe-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

// Broken by: leaving out `path.is_dir()`, which gives the system's words.
#[test]
fn files_are_named_as_the_caller_does() {
    let folder = Folder::new("obj");
    let path = folder.0.join("caf\u{E9} 1.obj");
    let message = || read_obj(&path).unwrap_err().to_string();
    assert_eq!(message(), format!("{}: there is no such file", path.display()));
    std::fs::write(&path, format!("{SQUARE}f 1 2 3 4")).unwrap();
    assert_eq!(read_obj(&path).unwrap().mesh, square());
    std::fs::write(&path, "v 1 2 x").unwrap();
    assert_eq!(message(), format!("{}:1: v has \"x\" where a number is expected", path.display()));

    let directory = read_obj(&folder.0).unwrap_err().to_string();
    assert_eq!(directory, format!("{}: is a directory, expected an OBJ file", folder.0.display()));
}

// Broken by: opening whatever there is. A pipe without a writer is never opened, and a device may never end.
#[cfg(unix)]
#[test]
fn only_ordinary_files_are_read() {
    let folder = Folder::new("sockets");
    let socket = folder.0.join("socket.obj");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    for path in [socket, "/dev/null".into()] {
        assert_eq!(
            read_obj(&path).unwrap_err().to_string(),
            format!(
                "{}: cannot be read: it is a pipe, a socket or a device, expected an ordinary file",
                path.display()
            )
        );
    }
}

// Broken by: explaining a failed read as a bad number.
#[test]
fn failing_reads_are_told() {
    struct Broken;
    impl Read for Broken {
        fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
            Err(io::Error::other("the disk is gone"))
        }
    }
    let reader = BufReader::new(SQUARE.as_bytes().chain(Broken));
    let error = parse_obj("m.obj", reader).unwrap_err();
    assert_eq!(error.to_string(), "m.obj: cannot be read: the disk is gone");
}

// Broken by: leaving out the check of negative indices, of zero or of finite numbers.
#[test]
fn mutated_files_never_panic() {
    let quad = format!(
        "\u{FEFF}o a\n{SQUARE}vt 0 1\nvn 0 0 1\r\nf 1/1/1 2/1/1 -2//1 \\\n4 # end\nusemtl x\nf 1 2 3"
    );
    let seeds = [
        quad.into_bytes(),
        b"# caf\xE9\rv 1 2 3 1\rv 4e3 -5 .6\rv +7. 8 9\rvt 1\rf 1/1 2/-1 3/\rf 3 2 1//\rl 1 2"
            .to_vec(),
        any_obj([5, 3, 2], 6, &mut Random(1)).into_bytes(),
    ];
    // Bytes with a meaning in OBJ, more often than by chance.
    let telling = b"\n\r\\#/ -+.0123456789efvntaginINF\t\xE9\xEF\xBB\xBF\xFF\x00";
    seeds.iter().for_each(|seed| drop(parse(seed)));
    let mut loaded = 0;
    for trial in 0..20_000 {
        let random = &mut Random(0x0B1 + trial);
        let mut text = seeds[random.below(seeds.len())].clone();
        for _ in 0..1 + random.below(4) {
            let at = random.below(text.len());
            let byte = telling[random.below(telling.len())];
            match random.below(5) {
                0 => text[at] ^= 1 << random.below(8),
                1 => text[at] = byte,
                2 => text.insert(at, byte),
                3 => drop(text.remove(at)),
                _ => {
                    let from = random.below(text.len());
                    let piece = text[from..(from + random.below(20)).min(text.len())].to_vec();
                    text.splice(at..at, piece);
                }
            }
        }
        let outcome = std::panic::catch_unwind(|| parse_obj("m.obj", &text[..]));
        let outcome = outcome
            .unwrap_or_else(|_| panic!("trial {trial}: {:?}", text.escape_ascii().to_string()));
        match outcome {
            Ok(read) => {
                loaded += 1;
                assert_eq!(read.mesh.check(), Ok(()), "trial {trial}");
                assert!(!read.mesh.indices.is_empty(), "trial {trial}");
            }
            Err(e) => assert!(e.to_string().starts_with("m.obj:"), "trial {trial}: {e}"),
        }
    }
    // Some inputs load, some do not.
    assert!((2_000..18_000).contains(&loaded), "{loaded} of 20000 loaded");
}

// Broken by: leaving out any one of the checks but the last, which would take 2^32 vertices.
#[test]
fn check_finds_what_is_wrong() {
    let refusal = |change: fn(&mut TriangleMesh)| {
        let mut mesh = square();
        change(&mut mesh);
        mesh.check().unwrap_err().to_string()
    };
    assert_eq!(square().check(), Ok(()));
    assert_eq!(TriangleMesh::default().check(), Ok(()));
    assert_eq!(
        refusal(|m| m.normals = vec![Vec3::Z; 3]),
        "mesh has 3 normals and 4 vertices, expected none or one for each vertex"
    );
    assert_eq!(
        refusal(|m| m.uvs = vec![Vec2::ZERO; 5]),
        "mesh has 5 uvs and 4 vertices, expected none or one for each vertex"
    );
    assert_eq!(
        refusal(|m| m.positions[2].y = f32::NAN),
        "vertex 2 is at [1, NaN, 0], expected finite coordinates up to 1e12"
    );
    assert_eq!(
        refusal(|m| m.normals = vec![Vec3::Z, Vec3::INFINITY, Vec3::Z, Vec3::Z]),
        "vertex 1 has the normal [inf, inf, inf], expected finite numbers"
    );
    assert_eq!(
        refusal(|m| m.uvs = vec![vec2(0.0, f32::NEG_INFINITY); 4]),
        "vertex 0 has the texture coordinates [0, -inf], expected finite numbers"
    );
    assert_eq!(
        refusal(|m| m.indices[1][2] = 4),
        "triangle 1 refers to vertex 4, but vertices count from 0 and there are 4"
    );
    let empty = TriangleMesh { indices: vec![[0; 3]], ..Default::default() };
    assert_eq!(empty.check(), Err(MeshError::Index { triangle: 0, found: 0, vertices: 0 }));
}
