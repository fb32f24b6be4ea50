//! What `lobe info` lists of materials, textures and instances.

use crate::folder::Folder;

const MODEL: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl bulb\nf 1 2 3\nusemtl mine\nf 1 2 4\n";

/// Materials with their kinds, and whether anything has them; copies of lamps are counted. Caught: a line for each copy; materials of
/// mixtures and textures of textures that are not used.
#[test]
fn info_lists_what_a_scene_defines() {
    let folder = Folder::new("info-lists");
    folder.write("m.obj", MODEL);
    folder.write("m.mtl", "newmtl bulb\nKe 5\n");
    let instances: String = (0..100)
        .map(|i| format!("[instance.i{i}]\nshape = \"box\"\ntranslate = [{i}, 9, 0]\n"))
        .collect();
    folder.write(
        "all.toml",
        &format!(
            "[texture.half]\ntype = \"constant\"\nvalue = 0.5\n[texture.board]\ntype = \"checkerboard\"\nfirst = \"half\"\nsecond = 1\n\
             [texture.idle]\ntype = \"constant\"\nvalue = 1\n\
             [material.mine]\ntype = \"matte\"\nkd = \"board\"\n[material.gold]\ntype = \"metal\"\n[material.lacquer]\ntype = \"plastic\"\n\
             [material.both]\ntype = \"mix\"\nfirst = \"gold\"\nsecond = \"lacquer\"\n[material.spare]\ntype = \"mirror\"\n\
             [shape.box]\nobj = \"m.obj\"\n[shape.ball]\nobj = \"m.obj\"\nmaterial = \"both\"\n{instances}"
        ),
    );
    let summary = folder.prints("info all.toml");
    let is_listed = |line: &&str| {
        ["shape", "instances", "material", "texture"]
            .iter()
            .any(|key| line.split(' ').next() == Some(key))
    };
    let lines: Vec<_> = summary
        .lines()
        .filter(is_listed)
        .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect();
    assert_eq!(
        lines,
        [
            "shape box: 1 triangles",
            "shape box/bulb: 1 triangles",
            "shape ball: 2 triangles",
            "instances box: 100",
            "instances box/bulb: 100 copies",
            "material mine: matte, 1 triangles",
            "material gold: metal",
            "material lacquer: plastic",
            "material both: mix",
            "material spare: mirror, not used",
            "material box/bulb: 1 triangles, emitting",
            "texture half: constant",
            "texture board: checkerboard",
            "texture idle: constant, not used",
        ]
    );
    let summary = folder.prints("render all.toml -o a.png --spp 1 --set film.resolution=[4,4]");
    assert_eq!(crate::folder::value(&summary, "instances"), "200");
    assert!(!folder.prints("render s.toml -o a.png").contains("instances"));
}
