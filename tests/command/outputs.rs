//! Where pictures are written, and what happens where they cannot be: nothing that was there is lost.

use std::fs;

use crate::folder::{Folder, value};

/// Under a limit for the size of files, as on a full disk. Seen to fail with both files written one after the other: the
/// PNG was new and the EXR old; and with the picture dropped.
#[test]
fn a_full_disk_loses_nothing() {
    let folder = Folder::new("full");
    folder.prints("render s.toml --quiet");
    let (old_exr, old_png) = (folder.exr("s.exr"), fs::read(folder.0.join("s.png")).unwrap());
    // In units of 512 bytes: enough for the PNG, too little for the EXR.
    let render = "render s.toml --seed 9 --quiet";
    let mut command = folder.limited("trap '' XFSZ; ulimit -f 3", render);
    let output = command.env("TMPDIR", &folder.0).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert_eq!(
        said,
        "error: cannot write `s.exr`: File too large (os error 27); free some space or choose another disk; \
         the picture is kept in `kept-0-s.png`\n"
    );
    assert!(folder.exr("s.exr") == old_exr);
    assert_eq!(fs::read(folder.0.join("s.png")).unwrap(), old_png);
    assert_eq!(folder.files(), ["kept-0-s.png", "s.exr", "s.png", "s.toml", "wall.obj"]);
    assert_ne!(fs::read(folder.0.join("kept-0-s.png")).unwrap(), old_png);
}

/// What killed processes left goes, and nothing else. Seen to fail without the sweep, and with files swept that a living
/// process has locked.
#[test]
fn temporaries_of_killed_processes_are_swept() {
    let folder = Folder::new("swept");
    folder.write(".lobe-123-4.tmp", "left");
    folder.write(".lobe-mine.tmp", "a file of the user's");
    folder.write(".lobe-5-6.tmp", "in use");
    let used = fs::File::open(folder.0.join(".lobe-5-6.tmp")).unwrap();
    used.lock().unwrap();
    folder.prints("render s.toml -o a.png --quiet");
    let files = [".lobe-5-6.tmp", ".lobe-mine.tmp", "a.png", "s.toml", "wall.obj"];
    assert_eq!(folder.files(), files);
}

/// Seen to fail without these checks: the scene's file was replaced by a picture.
#[test]
fn outputs_are_not_the_scenes_own_files() {
    let folder = Folder::new("own");
    let scene = fs::read_to_string(folder.0.join("s.toml")).unwrap();
    fs::rename(folder.0.join("wall.obj"), folder.0.join("wall.png")).unwrap();
    folder.write("s.toml", &scene.replace("wall.obj", "wall.png"));
    let own = |name: &str| format!("cannot write `{name}`: it is read; give another name");
    folder.fails("render s.toml -o ./wall.png", &own("./wall.png"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("s.toml", folder.0.join("s.png")).unwrap();
        folder.fails("render s.toml -o a.exr -o s.png", &own("s.png"));
    }
    folder.fails(
        "render s.toml -o a.exr -o ./a.exr",
        "`./a.exr` is given twice: give each output once",
    );
    // A link to no file yet leads there, and stays a link.
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("real.png", folder.0.join("link.png")).unwrap();
        folder.prints("render s.toml -o link.png --quiet");
        assert!(fs::symlink_metadata(folder.0.join("link.png")).unwrap().is_symlink());
        assert!(fs::symlink_metadata(folder.0.join("real.png")).unwrap().is_file());
    }
}

/// Before anything is rendered. Seen to fail with the check left to the writing.
#[test]
fn sizes_that_no_file_holds_are_refused() {
    let folder = Folder::new("sides");
    folder.fails(
        "render s.toml --spp 100000000 --set film.resolution=[2000000000,1] --set film.crop=[0,0,1,1]",
        "a file's sides hold at most 1073741822 pixels, but film.resolution is 2000000000 x 1",
    );
}

/// A thousand threads where memory allows few: those that there are render. Seen to abort with threads that start without
/// asking for memory, and with all starting at once.
#[test]
fn threads_are_as_many_as_memory_allows() {
    let folder = Folder::new("threads");
    let render = "render s.toml --threads 1000 --set film.resolution=[1000,600]";
    let output = folder.limited("ulimit -v 400000", render).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{said}");
    let summary = String::from_utf8(output.stdout).unwrap();
    let threads: u32 = value(&summary, "threads").parse().unwrap();
    assert!((1..1000).contains(&threads), "{summary}");
}
