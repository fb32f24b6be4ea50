//! `usemtl` lines of OBJ files.

use lobe::shape::{ObjMaterials, ObjMesh, parse_obj};

const NONE: u32 = ObjMaterials::NONE;
const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// One entry for each triangle, or none at all.
fn parse(text: impl AsRef<[u8]>) -> ObjMesh {
    let read = parse_obj("m.obj", &[POINTS.as_bytes(), text.as_ref()].concat()[..]).unwrap();
    let ObjMaterials { names, of_triangles, .. } = &read.materials;
    assert!(of_triangles.is_empty() || of_triangles.len() == read.mesh.indices.len());
    assert!(of_triangles.iter().all(|&index| index == NONE || (index as usize) < names.len()));
    read
}

#[track_caller]
fn assert_materials(text: &str, names: &[&str], of_triangles: &[u32]) {
    let materials = parse(text).materials;
    assert_eq!(
        (&materials.names[..], &materials.of_triangles[..]),
        (&names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>()[..], of_triangles),
        "{text:?}"
    );
}

/// Seen to fail with faces above the first name left out, with a name again under a new index, and with an empty name.
#[test]
fn faces_have_the_material_in_force() {
    let face = "f 1 2 3\n";
    let cases: [(String, &[&str], &[u32]); 12] = [
        (face.into(), &[], &[]),
        (format!("usemtl a\n{face}"), &["a"], &[0]),
        (format!("{face}{face}usemtl a\n{face}"), &["a"], &[NONE, NONE, 0]),
        (format!("{face}usemtl a\n"), &[], &[]),
        (format!("usemtl a\n{face}usemtl b\n{face}usemtl a\n{face}"), &["a", "b"], &[0, 1, 0]),
        (format!("usemtl a\nusemtl b\n{face}usemtl b\n{face}"), &["b"], &[0, 0]),
        (
            format!("usemtl a\n{face}usemtl\n{face}usemtl  \t\n{face}usemtl a\n{face}"),
            &["a"],
            &[0, NONE, NONE, 0],
        ),
        // Case counts, blanks within a name count.
        (
            format!("usemtl a\n{face}usemtl A\n{face}usemtl a b\n{face}"),
            &["a", "A", "a b"],
            &[0, 1, 2],
        ),
        (format!("usemtl \t a b \t\n{face}"), &["a b"], &[0]),
        // Objects and groups do not end a material, nor do lines and points.
        (format!("usemtl a\no x\ng y\ns 1\nl 1 2\np 1\n{face}"), &["a"], &[0]),
        (format!("usemtl a # not b\n{face}"), &["a"], &[0]),
        (format!("usemtl a\\\nb\n{face}"), &["a b"], &[0]),
    ];
    for (text, names, of_triangles) in cases {
        assert_materials(&text, names, of_triangles);
        assert_materials(
            &text.replace('\n', "\r\n").replace("\\\r\n", "\\\n"),
            names,
            of_triangles,
        );
    }
}

/// A polygon has its material once for each triangle; a face that is none has no part in it. Seen to fail with names that only
/// skipped faces have.
#[test]
fn polygons_and_skipped_faces_are_counted_by_triangles() {
    assert_materials("usemtl a\nf 1 2 3 4\nusemtl b\nf 1 2 3\n", &["a", "b"], &[0, 0, 1]);
    assert_materials("f 1 2 3 4\nusemtl b\nf 1 2 3 4 1\n", &["b"], &[NONE, NONE, 0, 0, 0]);
    assert_materials(
        "usemtl a\nf 1 2\nusemtl b\nf 1 2 3\nf 1\nf 2 3\nusemtl a\nf 1 2\n",
        &["b"],
        &[0],
    );
    assert_materials("f 1 2\nf 1 2 3\nusemtl a\nf 1 2\nf 1 2 3\n", &["a"], &[NONE, 0]);
    assert_eq!(parse("usemtl a\nf 1 2\nf 1 2 3\n").report.short_faces.count, 1);
    // Copies of corners change no order.
    let text = "vt 0 0\nvt 1 1\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/2 2/2 3/2\nusemtl a\nf 1/1 3/2 2/1\n";
    assert_materials(text, &["a", "b"], &[0, 1, 0]);
}

/// Seen to fail with bytes replaced: two names became one.
#[test]
fn names_of_any_encoding_differ() {
    let text = b"usemtl Gl\xE4s\nf 1 2 3\nusemtl Gl\xE5s\nf 1 2 3\nusemtl Gl\xC3\xA4s\nf 1 2 3\n";
    let materials = parse(text).materials;
    assert_eq!(materials.names, ["Gläs", "Glås"]);
    assert_eq!(materials.of_triangles, [0, 1, 0]);
}

/// Text alone opens no file. Seen to fail with lines given twice.
#[test]
fn libraries_are_named_once() {
    let text = "mtllib a.mtl\nmtllib\nmtllib b c.mtl\nf 1 2 3\nmtllib a.mtl\nmtllib d\\e.mtl # x\n";
    let libraries = parse(text).materials.libraries;
    assert_eq!(
        libraries.iter().map(|file| file.to_str().unwrap()).collect::<Vec<_>>(),
        ["a.mtl", "b c.mtl", "d\\e.mtl"]
    );
    // As many names as there are lines take no time that grows with their square.
    let many: String = (0..200_000)
        .map(|i| format!("mtllib a file of a long name {i}\nusemtl {i}\nf 1 2 3\n"))
        .collect();
    let materials = parse(many).materials;
    assert_eq!((materials.libraries.len(), materials.names.len()), (200_000, 200_000));
}
