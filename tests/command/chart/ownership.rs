//! Charts write to folders of their own, one at a time, and remove nothing else from them.

use std::fs::{self, File};
use std::path::Path;

use super::{SMALL, contents, small_folder};
use crate::folder::Folder;

const STABILITY: &str = "chart --stability --effort 0.01 -o c";

/// Asserts that a chart fails with this message and changes nothing at all.
#[track_caller]
fn refuses(folder: &Folder, arguments: &str, message: &str) {
    let before = contents(&folder.0);
    folder.fails(arguments, message);
    assert!(contents(&folder.0) == before, "{arguments}");
}

/// Seen to fail when only a plan that cannot be read was refused: `means/photo.exr` was deleted and `index.html` written over.
#[test]
fn chart_refuses_folders_that_are_not_its_own() {
    let folder = small_folder("chart_foreign");
    let foreign = |name: &str, marker: &str| {
        format!(
            "`c` is not the folder of such a chart: it has `{name}`, but no `{marker}`; choose a new or empty folder with -o"
        )
    };
    for name in ["index.html", "runs.csv", "means/photo.exr"] {
        fs::create_dir_all(folder.0.join("c/means")).unwrap();
        folder.write(&format!("c/{name}"), "mine");
        let found = if name > "means" { "means" } else { name };
        for arguments in [SMALL, &format!("{SMALL} --fresh")] {
            refuses(&folder, arguments, &foreign(found, "plan.toml"));
        }
        refuses(&folder, STABILITY, &foreign(found, "stability.csv"));
        fs::remove_dir_all(folder.0.join("c")).unwrap();
    }

    folder.write("c", "mine");
    refuses(&folder, SMALL, "`c` is a file: choose a folder with -o");
    refuses(&folder, STABILITY, "`c` is a file: choose a folder with -o");
    fs::remove_file(folder.0.join("c")).unwrap();

    // Files with the names of a chart's, which no chart wrote.
    fs::create_dir_all(folder.0.join("c/means")).unwrap();
    folder.write("c/means/check-1.exr", "mine");
    folder.write("c/plan.toml", "[[step]]\ntitle = \"buy milk\"\n");
    for arguments in [SMALL, &format!("{SMALL} --fresh")] {
        refuses(
            &folder,
            arguments,
            "c/plan.toml:1:3: unknown key `step` in the plan of a chart; expected `budgets`, `seeds`, `part_spp`, \
             `means`, `fingerprint` or `starting`; this is not a plan of `lobe chart`: choose another folder with -o",
        );
    }
    fs::remove_file(folder.0.join("c/plan.toml")).unwrap();
    folder.write(
        "c/stability.csv",
        "week,mood\n1,stable and well, with more than one line's worth\n",
    );
    refuses(
        &folder,
        STABILITY,
        "`c/stability.csv` is not a table of `lobe chart --stability`, whose first line is \
         sweep,parameter,method,is_ours,value,bound: choose another folder with -o",
    );
}

/// A chart of one kind does not take the folder of the other.
#[test]
fn charts_of_both_kinds_have_folders_of_their_own() {
    let folder = small_folder("chart_kinds");
    folder.prints(SMALL);
    refuses(
        &folder,
        STABILITY,
        "`c` is not the folder of such a chart: it has `curves.csv`, but no `stability.csv`; choose a new or empty folder with -o",
    );
    fs::remove_dir_all(folder.0.join("c")).unwrap();
    fs::create_dir(folder.0.join("c")).unwrap();
    folder.write("c/stability.csv", "sweep,parameter,method,is_ours,value,bound\n");
    refuses(
        &folder,
        SMALL,
        "`c` is not the folder of such a chart: it has `stability.csv`, but no `plan.toml`; choose a new or empty folder with -o",
    );
}

/// Seen to fail with the folder `means` removed as a whole.
#[test]
fn fresh_charts_remove_only_what_charts_write() {
    let folder = small_folder("chart_fresh");
    folder.prints(SMALL);
    let own = contents(&folder.0.join("c"));
    for name in ["c/notes.txt", "c/means/photo.exr", "c/means/1-one-2.png", "c/means/1-one-65.exr"]
    {
        folder.write(name, "mine");
    }
    let with_mine = contents(&folder.0.join("c"));
    let mine: Vec<_> = with_mine.iter().filter(|(path, _)| !own.contains_key(*path)).collect();
    assert_eq!(mine.len(), 4);

    // Other methods, whose means have other names.
    folder.write("two.toml", "[methods]\nthree = ['sampler.type=\"independent\"']\n");
    folder.prints(&format!("{SMALL} --fresh"));
    let now = contents(&folder.0.join("c"));
    for (path, text) in &mine {
        assert_eq!(now.get(*path), Some(*text), "{}", path.display());
    }
    let mut expected: Vec<_> = with_mine.keys().cloned().collect();
    let is_mean = |path: &Path, number: char| {
        path.parent().unwrap().ends_with("means")
            && path.file_name().unwrap().to_str().unwrap().starts_with(number)
    };
    expected.retain(|path| !is_mean(path, '1') && !is_mean(path, '2'));
    let means = folder.0.join("c/means");
    expected.extend(["1-three-2.exr", "1-one-2.png", "1-one-65.exr"].map(|name| means.join(name)));
    expected.sort();
    assert_eq!(now.keys().cloned().collect::<Vec<_>>(), expected);
}

/// Seen to fail without the lock: both charts ended well, and `runs.csv` had each run twice.
#[test]
fn one_chart_at_a_time_writes_to_a_folder() {
    let folder = small_folder("chart_lock");
    folder.prints(SMALL);
    let busy = "another `lobe chart` is writing to `c`: wait until it ends, or choose another folder with -o";
    let path = folder.0.join("c/.lobe-chart.lock");
    let lock = File::open(&path).unwrap();
    lock.lock().unwrap();
    refuses(&folder, SMALL, busy);
    refuses(&folder, &format!("{SMALL} --fresh"), busy);
    drop(lock);
    folder.prints(SMALL);

    // Two that begin at once: one of them is told, or they follow each other.
    for _ in 0..3 {
        let begin = || {
            let words = SMALL.split(' ').chain(["--fresh", "--quiet"]);
            let mut command = folder.command(words);
            command.stderr(std::process::Stdio::piped()).spawn().unwrap()
        };
        let ends = [begin(), begin()].map(|chart| chart.wait_with_output().unwrap());
        let told = ends.iter().filter(|end| !end.status.success());
        let said: Vec<_> = told.map(|end| String::from_utf8_lossy(&end.stderr)).collect();
        assert!(
            said.len() < 2 && said.iter().all(|said| *said == format!("error: {busy}\n")),
            "{said:?}"
        );
        let runs = fs::read_to_string(folder.0.join("c/runs.csv")).unwrap();
        assert_eq!(runs.lines().count(), 1 + 2 * 2 * 2, "{runs}");
    }
}

/// Seen to fail with nothing removed, and with all files that end in .tmp removed, and
/// with those that are locked.
#[test]
fn temporary_files_of_killed_charts_are_removed() {
    let folder = small_folder("chart_temporary");
    // No process has such a number. A chart that was killed at once leaves nothing else.
    fs::create_dir(folder.0.join("c")).unwrap();
    folder.write("c/.lobe-4294967295-0.tmp", "half");
    folder.prints(SMALL);
    assert!(!folder.0.join("c/.lobe-4294967295-0.tmp").exists());
    let own = contents(&folder.0.join("c"));
    for place in ["c", "c/means"] {
        folder.write(&format!("{place}/.lobe-4294967295-17.tmp"), "half");
    }
    // The last one is in use: its process has locked it.
    let kept =
        [".lobe-1-x.tmp", ".lobe--1.tmp", "lobe-1-1.tmp", ".lobe-1-1.tmp.exr", ".lobe-9-3.tmp"];
    for name in &kept {
        folder.write(&format!("c/{name}"), "mine");
    }
    let used = fs::File::open(folder.0.join("c/.lobe-9-3.tmp")).unwrap();
    used.lock().unwrap();
    folder.prints(SMALL);
    let mut expected: Vec<_> = own.keys().cloned().collect();
    expected.extend(kept.iter().map(|name| folder.0.join("c").join(name)));
    expected.sort();
    assert_eq!(contents(&folder.0.join("c")).into_keys().collect::<Vec<_>>(), expected);
}

/// A folder that cannot be written to. Says nothing where every folder can be, as for the superuser.
#[test]
#[cfg(unix)]
fn chart_refuses_a_folder_without_permission() {
    use std::os::unix::fs::PermissionsExt;
    let folder = small_folder("chart_permission");
    let path = folder.0.join("c");
    fs::create_dir(&path).unwrap();
    let permit = |mode| fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
    permit(0o555);
    if fs::write(path.join("x"), "").is_err() {
        for arguments in [SMALL, STABILITY] {
            folder.fails(
                arguments,
                "cannot write to the folder `c`: Permission denied (os error 13); choose another one with -o",
            );
        }
        folder.fails(
            &SMALL.replace("-o c", "-o c/d"),
            "cannot create the folder `c/d`: Permission denied (os error 13)",
        );
    }
    permit(0o755);
}
