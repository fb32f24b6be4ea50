//! Renders that are interrupted, killed and resumed: nothing that was there is lost.

use std::fs;
use std::process::{Child, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use lobe::image::Image;

use crate::folder::Folder;

/// A generator of moments: a multiplicative sequence, different for each seed.
struct Moments(u64);

impl Moments {
    /// From 0 to `most` milliseconds.
    fn next(&mut self, most: f64) -> Duration {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Duration::from_secs_f64(most * (self.0 >> 40) as f64 / (1 << 24) as f64 / 1000.0)
    }
}

pub fn start(folder: &Folder, arguments: &str) -> Child {
    let mut command = folder.command(arguments.split_whitespace());
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

pub fn signal(child: &Child, name: &str) {
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args([name, &id]).status().unwrap().success());
}

/// Waits until a file is there; fails after a minute.
pub fn wait_for(folder: &Folder, name: &str) {
    let start = Instant::now();
    while !folder.0.join(name).exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no {name} after a minute");
        std::thread::sleep(Duration::from_millis(1));
    }
}

pub fn end(child: Child) -> (ExitStatus, String) {
    let output = child.wait_with_output().unwrap();
    (output.status, String::from_utf8(output.stderr).unwrap())
}

/// Seen to fail without the handler: no picture, and the process ended by the signal.
#[test]
fn the_first_signal_writes_what_there_is() {
    for name in ["-INT", "-TERM", "-HUP"] {
        let folder = Folder::new(&format!("signal{name}"));
        let endless = "render s.toml --spp 100000000 --resume --save-every 0.001";
        let child = start(&folder, endless);
        wait_for(&folder, "s.state");
        signal(&child, name);
        let (status, said) = end(child);
        assert_eq!(status.code(), Some(130), "{said}");
        assert!(
            said.starts_with("interrupted ") && said.ends_with("; the same command goes on\n"),
            "{said}"
        );
        assert_eq!(folder.files(), ["s.exr", "s.png", "s.state", "s.toml", "wall.obj"]);
        // It goes on, and its state with it.
        let before = fs::read(folder.0.join("s.state")).unwrap();
        let child = start(&folder, endless);
        while fs::read(folder.0.join("s.state")).unwrap() == before {
            std::thread::sleep(Duration::from_millis(1));
        }
        signal(&child, name);
        assert_eq!(end(child).0.code(), Some(130));
    }
}

/// A white box from within, which no path ever leaves: no tile is ever done.
const ENDLESS: &str = r#"
film.resolution = [8, 8]
integrator = { max_depth = 4294967295, roulette = false }
camera = { eye = [0, 0, 0], look_at = [0, 0, 1] }
material.white = { type = "matte", kd = [1, 1, 1] }
light.far = { type = "point", position = [9, 9, 9], intensity = [1, 1, 1] }
shape.box = { obj = "box.obj", material = "white" }
"#;

const BOX: &str =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 4 3 7 8\nf 1 4 8 5\nf 2 3 7 6\n";

/// Where there is nothing yet, an older picture stays. Seen to hang with time looked at between waves, and to write black
/// over the older picture.
#[test]
fn nothing_is_not_written() {
    let folder = Folder::new("nothing");
    folder.write("box.toml", ENDLESS);
    folder.write("box.obj", BOX);
    folder.write("box.png", "an older picture");
    folder.write("box.exr", "an older picture");
    folder.fails(
        "render box.toml --time 0.1",
        "time was over before any part of the picture was done: no picture is written; allow more with --time",
    );
    let child = start(&folder, "render box.toml --resume --quiet");
    std::thread::sleep(Duration::from_millis(100));
    signal(&child, "-INT");
    let (status, said) = end(child);
    // The signal may come before the process listens.
    if status.code().is_some() {
        assert_eq!(status.code(), Some(130), "{said}");
        let what = "interrupted before any part of the picture was done: no picture is written";
        assert_eq!(said, format!("{what}; the same command goes on\n"));
        assert!(folder.0.join("box.state").exists());
    }
    for name in ["box.png", "box.exr"] {
        assert_eq!(fs::read(folder.0.join(name)).unwrap(), b"an older picture");
    }
}

/// A part of a render goes on like a whole one. Seen to fail with the sums of a part begun at the first sample.
#[test]
fn a_killed_part_goes_on() {
    let folder = Folder::new("killed-part");
    let part = "render s.toml --spp 9000 --set film.resolution=[60,40] --shard 2/3 --resume";
    folder.prints(&format!("{part} -o whole.exr --quiet"));
    let child = start(&folder, &format!("{part} -o a.exr --save-every 0.001"));
    wait_for(&folder, "a.state");
    signal(&child, "-KILL");
    end(child);
    folder.prints(&format!("{part} -o a.exr --quiet"));
    assert!(folder.exr("a.exr") == folder.exr("whole.exr"));
    // Once complete it is left as it is, but not for another part or another scene.
    let bytes = fs::read(folder.0.join("a.exr")).unwrap();
    let said = folder.prints(&format!("{part} -o a.exr"));
    assert_eq!(said, "complete  a.exr has all samples of the part\n");
    assert!(fs::read(folder.0.join("a.exr")).unwrap() == bytes);
    folder.prints(&format!("{part} -o a.exr --set camera.fov=50 --quiet"));
    assert!(fs::read(folder.0.join("a.exr")).unwrap() != bytes);
}

/// What was interrupted is no part. Seen to fail with all pictures of parts marked as parts.
#[test]
fn an_interrupted_part_is_none() {
    let folder = Folder::new("interrupted-part");
    let child =
        start(&folder, "render s.toml --spp 100000000 --shard 1/2 --resume --save-every 0.001");
    wait_for(&folder, "s-1-of-2.state");
    wait_for(&folder, "s-1-of-2.exr");
    signal(&child, "-INT");
    assert_eq!(end(child).0.code(), Some(130));
    folder.fails(
        "merge s-1-of-2.exr -o m.exr",
        "cannot read `s-1-of-2.exr`: it is not a complete part of a render: `lobe render --shard K/N` writes those",
    );
}

/// All that a mesh consists of is part of what is rendered. Seen to fail with normals left out.
#[test]
fn an_identity_has_all_of_a_mesh() {
    let folder = Folder::new("identity");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n";
    let identity = |text: &str| {
        folder.write("wall.obj", text);
        lobe::scene_file::read_scene(&folder.0.join("s.toml"), &[]).unwrap().identity()
    };
    let whole = identity(obj);
    assert_eq!(whole, identity(obj));
    for (from, to) in [
        ("v 1 0 0", "v 2 0 0"),
        ("vt 1 0", "vt 2 0"),
        ("vn 0 0 1", "vn 0 1 0"),
        ("f 1/1/1 2/2/1 3/3/1", "f 2/2/1 3/3/1 1/1/1"),
    ] {
        let other = identity(&obj.replace(from, to));
        assert_eq!(whole.iter().filter(|line| !other.contains(line)).count(), 1, "{to}");
    }
}

/// Where the state cannot be written, nothing promises that the render goes on. Seen to fail with "the same command goes on".
#[test]
fn a_state_that_was_not_saved_is_not_promised() {
    let folder = Folder::new("unsaved");
    let endless = "render s.toml --spp 100000000 -o s.png --resume --save-every 0.01 --quiet";
    let mut command = folder.limited("trap '' XFSZ; ulimit -f 3", endless);
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(500));
    signal(&child, "-INT");
    let (status, said) = end(child);
    assert_eq!(status.code(), Some(130), "{said}");
    let why = "it cannot go on: cannot write `s.state`: File too large (os error 27); free some space or choose another disk";
    assert!(said.ends_with(&format!("; {why}\n")), "{said}");
    assert_eq!(folder.files(), ["s.png", "s.toml", "wall.obj"]);
}

/// Killed at random moments and resumed: the same bytes as without. `kills` in all, over as many renders as that takes.
fn kill_and_resume(test: &str, kills: usize, most: f64) {
    let folder = Folder::new(test);
    let settings = "--spp 300 --set sampler.type=\"sobol\" --set film.resolution=[60,40]";
    folder.prints(&format!("render s.toml {settings} -o whole.exr -o whole.png --quiet"));
    let (whole, shown) =
        (folder.exr("whole.exr"), Image::read(folder.0.join("whole.png")).unwrap());
    let (mut moments, mut killed, mut resumed) = (Moments(1), 0, 0);
    while killed < kills {
        let mut child = start(
            &folder,
            &format!("render s.toml {settings} -o a.exr -o a.png --resume --save-every 0.001"),
        );
        std::thread::sleep(moments.next(most));
        resumed += usize::from(folder.0.join("a.state").exists());
        if child.try_wait().unwrap().is_none() {
            child.kill().unwrap();
            killed += 1;
        }
        let (status, said) = end(child);
        if status.success() {
            assert_eq!(folder.exr("a.exr"), whole, "after {killed} kills");
            assert!(Image::read(folder.0.join("a.png")).unwrap() == shown, "after {killed} kills");
            let files = ["a.exr", "a.png", "s.toml", "wall.obj", "whole.exr", "whole.png"];
            assert_eq!(folder.files(), files, "after {killed} kills");
            fs::remove_file(folder.0.join("a.exr")).unwrap();
        } else {
            assert!(said.is_empty(), "after {killed} kills: {said}");
        }
    }
    assert!(resumed > 0, "no render was killed after it had been stored");
}

/// Seen to fail with the marks of tiles not stored.
#[test]
fn a_killed_render_goes_on() {
    kill_and_resume("killed", 12, 150.0);
}

#[test]
#[ignore = "takes minutes"]
fn a_killed_render_goes_on_200_times() {
    kill_and_resume("killed-200", 200, 250.0);
}

/// The difference is named. Seen to fail without the comparison: the render went on with other samples.
#[test]
fn a_state_of_another_render_is_refused() {
    let folder = Folder::new("other-state");
    let child = start(&folder, "render s.toml --spp 100000000 --resume --save-every 0.001");
    wait_for(&folder, "s.state");
    signal(&child, "-INT");
    assert_eq!(end(child).0.code(), Some(130));
    let advice = "render with the same settings, or remove the file to start again";
    for (arguments, difference) in [
        ("--spp 99", "samples per pixel is 100000000 there and 99 here"),
        ("--spp 100000000 --seed 4", "seed is 0 there and 4 here"),
        ("--spp 100000000 --no-layers", "layers of an EXR file is true there and false here"),
        (
            "--spp 100000000 --set camera.eye=[0,1,-4]",
            "camera.eye is [0, 1, -3] there and [0, 1, -4] here",
        ),
        ("--spp 100000000 --set camera.fov=50", "camera.fov is 50 here and left out there"),
    ] {
        folder.fails(
            &format!("render s.toml --resume {arguments}"),
            &format!("`s.state` is of another render: {difference}; {advice}"),
        );
    }
    // The order of values may be that of lights, which samples are dealt to.
    let child = start(
        &folder,
        "render s.toml -o o.exr --spp 100000000 --resume --save-every 0.001 --set camera.fov=50 --set camera.lens_radius=0",
    );
    wait_for(&folder, "o.state");
    signal(&child, "-INT");
    assert_eq!(end(child).0.code(), Some(130));
    folder.fails(
        "render s.toml -o o.exr --spp 100000000 --resume --set camera.lens_radius=0 --set camera.fov=50",
        &format!("`o.state` is of another render: its values are in another order; {advice}"),
    );
    let obj = fs::read_to_string(folder.0.join("wall.obj")).unwrap();
    folder.write("wall.obj", &obj.replace("v 2 2 0", "v 2 2 0.5"));
    let said = folder.run("render s.toml --resume --spp 100000000");
    let said = String::from_utf8(said.stderr).unwrap();
    assert!(
        said.contains("another render: mesh of shape \"wall\" is 3 triangles, checksum "),
        "{said}"
    );

    // A damaged file, and one that is something else.
    folder.write("wall.obj", &obj);
    let mut bytes = fs::read(folder.0.join("s.state")).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(folder.0.join("s.state"), &bytes).unwrap();
    let damaged = "`s.state` is not the state of a render, or damaged: remove it or give the output another name";
    folder.fails("render s.toml --resume --spp 100000000", damaged);
    folder.write("s.state", "a file of the user's");
    folder.fails("render s.toml --resume", damaged);
    assert_eq!(fs::read(folder.0.join("s.state")).unwrap(), b"a file of the user's");
}
