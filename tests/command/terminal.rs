//! What reaches the terminal: warnings, and names of any characters.

use std::process::Output;

use crate::folder::Folder;

/// The lines of a summary with this key.
fn lines<'a>(summary: &'a str, key: &str) -> Vec<&'a str> {
    let found = summary.lines().filter_map(|line| line.strip_prefix(key));
    found.map(str::trim_start).collect()
}

/// Seen to fail with such faces refused.
#[test]
fn info_warns_of_lines_that_were_left_out() {
    let folder = Folder::new("odd_lines");
    folder.write("wall.obj", "v 0 0 0\nv 1 0 0\nvv 0 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nF 3 2 1\nf 3\n");
    let summary = folder.prints("info s.toml");
    assert_eq!(lines(&summary, "shape"), ["wall: 1 triangles"]);
    assert_eq!(
        lines(&summary, "warning"),
        [
            "wall: 2 faces with fewer than 3 corners, the first in line 5, left out",
            "wall: 2 lines with an unknown keyword, the first in line 3, left out",
        ]
    );
}

/// Seen to fail without the warnings.
#[test]
fn info_warns_of_scenes_without_shapes_or_light() {
    let folder = Folder::new("dark");
    let no_light = "the scene has no light: the picture will be black";
    let warnings = |arguments: &str| {
        let summary = folder.prints(arguments);
        lines(&summary, "warning").into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(warnings("info s.toml"), [""; 0]);
    assert_eq!(warnings("info s.toml --set light.key.intensity=[0,0,0]"), [no_light]);
    folder.write("empty.toml", "");
    assert_eq!(warnings("info empty.toml"), ["the scene has no shapes", no_light]);
    folder.write("sky.toml", "[light.s]\ntype = \"sky\"\nradiance = [1, 1, 1]\n");
    assert_eq!(warnings("info sky.toml"), ["the scene has no shapes"]);
    let shape =
        "[shape.lamp]\ntype = \"rectangle\"\ncorner = [0, 0, 0]\nedges = [[1, 0, 0], [0, 1, 0]]\n";
    folder.write("lamp.toml", &format!("{shape}emission = [1, 1, 1]\n"));
    assert_eq!(warnings("info lamp.toml"), [""; 0]);
    folder.write("dim.toml", &format!("{shape}emission = [0, 0, 0]\n"));
    assert_eq!(warnings("info dim.toml"), [no_light]);
}

/// A name that ends a line, colours the terminal and turns the text around.
const NASTY: &str = "a\n\u{1b}[31mb\u{202e}c";
const SHOWN: &str = "a\\n\\u{1b}[31mb\\u{202e}c";

/// Every command, given the name wherever it takes one: it is always escaped, and never ends a line. Seen to fail with
/// names shown as they are.
#[test]
fn names_are_escaped_wherever_they_are_shown() {
    let folder = Folder::new("nasty");
    let toml = |text: &str| text.replace("NASTY", "a\\n\\u001b[31mb\\u202ec");
    folder.write(&format!("{NASTY}.toml"), &toml(
        "[light.NASTY]\ntype = \"sky\"\nradiance = [1, 1, 1]\n[film]\nresolution = [4, 4]\n[sampler]\nspp = 2\n",
    ).replace("[light.a\\n\\u001b[31mb\\u202ec]", "[light.\"a\\n\\u001b[31mb\\u202ec\"]"));
    folder
        .write("name.toml", &toml("[shape.\"NASTY\"]\nobj = \"wall.obj\"\nmaterial = \"NASTY\"\n"));
    folder.write("key.toml", &toml("\"NASTY\" = 1\n"));
    folder.write("type.toml", &toml("[material.\"NASTY\"]\ntype = \"NASTY\"\n"));
    folder.write("texture.toml", &toml("[material.m]\ntype = \"matte\"\nkd = \"NASTY\"\n"));
    folder.write(
        "obj.toml",
        &toml("[material.m]\ntype = \"matte\"\n[shape.s]\nobj = \"NASTY.obj\"\nmaterial = \"m\"\n"),
    );
    folder.write(
        "mesh.toml",
        "[material.m]\ntype = \"matte\"\n[shape.s]\nobj = \"mesh.obj\"\nmaterial = \"m\"\n",
    );
    folder.write("mesh.obj", "v 0 0 \u{1b}[31m\u{202e}\n");
    folder.write("methods.toml", &toml("[methods]\n\"NASTY\" = [\"sampler.spp=1\"]\n"));
    folder.write("settings.toml", &toml("[methods]\n\"x\" = [\"sampler.NASTY=1\"]\n"));

    let set = toml("shape.wall.obj=\"NASTY.obj\"");
    let key = toml("camera.\"NASTY\"=1");
    let fails: &[&[&str]] = &[
        &["info", "NASTY.no"],
        &["render", "NASTY.no"],
        &["chart", "NASTY.no"],
        &["info", "name.toml"],
        &["info", "key.toml"],
        &["info", "type.toml"],
        &["info", "texture.toml"],
        &["info", "obj.toml"],
        &["info", "mesh.toml"],
        &["info", "s.toml", "--set", "NASTY"],
        &["info", "s.toml", "--set", "shape.NASTY.scale=1"],
        &["info", "s.toml", "--set", "camera.fov=NASTY"],
        &["info", "s.toml", "--set", &set],
        &["info", "s.toml", "--set", &key],
        &["render", "s.toml", "-o", "NASTY.jpg"],
        &["render", "s.toml", "-o", "NASTY/a.png"],
        &["compare", "NASTY.exr", "a.exr"],
        &["compare", "NASTY.no", "a.exr"],
        &["compare", "a.exr", "a.exr", "--maps", "NASTY/m"],
        &["chart", "s.toml", "--methods", "NASTY"],
        &["chart", "s.toml", "--methods", "methods.toml"],
        &["chart", "s.toml", "--methods", "settings.toml"],
        &["chart", "s.toml", "--add", "x=NASTY.exr,1"],
        &["chart", "s.toml", "-o", "s.toml/NASTY"],
        &["help", "NASTY"],
    ];
    let run = |arguments: &[&str]| {
        let arguments = arguments.iter().map(|argument| argument.replace("NASTY", NASTY));
        let Output { status, stdout, stderr } = folder.command(arguments).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (status.code(), text(stdout), text(stderr))
    };
    let is_plain =
        |text: &str| !text.contains(|c: char| c != '\n' && c.is_control() || c == '\u{202e}');
    for arguments in fails {
        let (code, stdout, stderr) = run(arguments);
        assert_eq!((code, &*stdout), (Some(1), ""), "{arguments:?}: {stderr}");
        assert!(is_plain(&stderr) && stderr.lines().count() == 1, "{arguments:?}: {stderr:?}");
    }
    // clap's messages have several lines, none of which begins with a part of a name.
    for arguments in [
        &["NASTY"][..],
        &["info", "s.toml", "NASTY"],
        &["info", "--NASTY"],
        &["compare", "a.exr", "b.exr", "--fail-above", "NASTY"],
    ] {
        let (code, stdout, stderr) = run(arguments);
        assert_eq!((code, &*stdout), (Some(2), ""), "{arguments:?}: {stderr}");
        assert!(
            is_plain(&stderr) && stderr.contains("a\\n\\u{1b}[31mb"),
            "{arguments:?}: {stderr:?}"
        );
    }

    // Summaries: each value in its line.
    let summary = run(&["info", "NASTY.toml"]).1;
    assert_eq!(lines(&summary, "scene"), [format!("{SHOWN}.toml")]);
    let summary = run(&["render", "NASTY.toml", "-o", "NASTY.exr"]).1;
    assert!(is_plain(&summary), "{summary:?}");
    assert_eq!(lines(&summary, "wrote"), [format!("{SHOWN}.exr")]);
    let summary = run(&["compare", "NASTY.exr", "NASTY.exr", "--maps", "NASTY"]).1;
    assert!(is_plain(&summary), "{summary:?}");
    assert_eq!(lines(&summary, "reference"), [format!("{SHOWN}.exr")]);
    assert_eq!(lines(&summary, "wrote").len(), 3, "{summary:?}");
}
