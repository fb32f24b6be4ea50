//! Results in a chart's folder that are not what the chart wrote: whole messages, and figures that stay.
//!
//! All were seen to be taken, or to end in a panic, when lines were only parsed and means only read.

use std::fs;
use std::path::Path;

use lobe::Spectrum;
use lobe::glam::UVec2;
use lobe::image::{Image, Metadata, Picture, write_exr};
use lobe::metrics::convergence::Run;

use super::{SMALL, contents, lasting, small_folder};
use crate::folder::Folder;

const RESTORE: &str = "restore it, or start again with --fresh";
const REMOVE: &str = "remove the line, or start again with --fresh";

/// Changes a file, and asserts that the chart fails with this message, changes nothing, and goes on with the file restored.
#[track_caller]
fn refuses(folder: &Folder, file: &str, change: impl FnOnce(&Path), message: &str) {
    let path = folder.0.join(file);
    let good = fs::read(&path).unwrap();
    change(&path);
    let before = contents(&folder.0);
    folder.fails(SMALL, message);
    assert!(contents(&folder.0) == before, "{message}");
    if path.is_dir() {
        fs::remove_dir(&path).unwrap();
    }
    fs::write(&path, good).unwrap();
}

#[test]
fn runs_that_no_chart_wrote_are_refused() {
    let folder = small_folder("chart_runs");
    folder.prints(SMALL);
    let whole = lasting(&folder);
    let text = fs::read_to_string(folder.0.join("c/runs.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let last = lines[8];
    assert!(last.starts_with("\"two, light\",2,2,"), "{text}");
    let header = Run::HEADER;
    let wrong = |text: &str, message: &str| {
        refuses(&folder, "c/runs.csv", |path| fs::write(path, text).unwrap(), message);
    };
    let more = |line: &str, problem: &str| {
        wrong(&format!("{text}{line}\n"), &format!("c/runs.csv:10: {problem}; {REMOVE}"));
    };
    more(last, "line 9 is the run of `two, light` with 2 samples and seed 2, too");
    more("\"three\",2,2,0,0,0,0,0", "the plan has no method `three`");
    more("\"one\",4,2,0,0,0,0,0", "the plan has no runs with 4 samples");
    more("\"one\",2,3,0,0,0,0,0", "the plan has no runs with seed 3");
    more("", &format!("`` is not a line of runs.csv: expected {header}"));
    more(
        "\"one\",2,2,-1,0,0,0,0",
        "`\"one\",2,2,-1,0,0,0,0` is not a line of runs.csv: set_up_s is `-1`, expected a finite number of at least 0",
    );
    more(
        "\"one\",2,2,0,0,NaN,0,0",
        "`\"one\",2,2,0,0,NaN,0,0` is not a line of runs.csv: relmse is `NaN`, expected a finite number of at least 0",
    );
    let no_header =
        format!("c/runs.csv:1: expected {header}; restore the line, or start again with --fresh");
    wrong("", &no_header);
    wrong(&text[header.len() + 1..], &no_header);
    wrong("method,spp", &no_header);
    wrong(
        &format!("{header}\n"),
        &format!("`c/runs.csv` has no runs, but there are means of 4 pictures: {RESTORE}"),
    );
    let long = "x".repeat(30_000);
    wrong(&long, &format!("`c/runs.csv` has 30000 bytes, expected at most 20480; {RESTORE}"));
    let not_text = |path: &Path| fs::write(path, b"\xff\xfe\n").unwrap();
    let utf8 = "cannot read `c/runs.csv`: stream did not contain valid UTF-8";
    refuses(&folder, "c/runs.csv", not_text, &format!("{utf8}; {RESTORE}"));
    let remove = |path: &Path| fs::remove_file(path).unwrap();
    let missing = "cannot read `c/runs.csv`: No such file or directory (os error 2)";
    refuses(&folder, "c/runs.csv", remove, &format!("{missing}; {RESTORE}"));
    let folder_instead = |path: &Path| {
        fs::remove_file(path).unwrap();
        fs::create_dir(path).unwrap();
    };
    let message = format!("`c/runs.csv` is not an ordinary file; {RESTORE}");
    refuses(&folder, "c/runs.csv", folder_instead, &message);

    folder.prints(SMALL);
    assert_eq!(lasting(&folder), whole);
    assert_eq!(fs::read_to_string(folder.0.join("c/runs.csv")).unwrap(), text);
}

#[test]
fn means_that_no_chart_wrote_are_refused() {
    let folder = small_folder("chart_means");
    folder.prints(SMALL);
    let whole = lasting(&folder);
    let wrong = |name: &str, change: &dyn Fn(&mut Picture), problem: &str| {
        let file = format!("c/means/{name}.exr");
        let rewrite = |path: &Path| {
            let Image { size, pixels, variance, .. } = Image::read(path).unwrap();
            let mut picture = Picture { variance, ..Picture::new(size, pixels) };
            change(&mut picture);
            write_exr(path, &picture, &Metadata::default()).unwrap();
        };
        refuses(&folder, &file, rewrite, &format!("`{file}` {problem}: {RESTORE}"));
    };
    for name in ["reference-8", "2-two--light-2"] {
        let small = |picture: &mut Picture| {
            *picture = Picture::new(UVec2::new(4, 3), picture.color[..12].to_vec());
        };
        wrong(name, &small, "has 4 x 3 pixels, expected 20 x 10");
        for value in [f32::NAN, f32::INFINITY] {
            let change = |picture: &mut Picture| picture.color[7] = Spectrum::splat(value);
            wrong(name, &change, "has values that are not finite");
        }
        let count = &name[name.len() - 1..];
        let plain = |picture: &mut Picture| picture.variance = None;
        wrong(name, &plain, &format!("has no variance, expected that of {count} pictures"));
        for value in [f32::NAN, -1.0] {
            let change = |picture: &mut Picture| {
                picture.variance.as_mut().unwrap()[7] = Spectrum::splat(value)
            };
            wrong(name, &change, "has variances that are not numbers of at least 0");
        }
    }
    // More pictures than planned.
    for (name, most, more) in [("reference", 8, 9), ("check", 4, 64), ("1-one", 2, 3)] {
        let file = |count: u32| folder.0.join(format!("c/means/{name}-{count}.exr"));
        fs::copy(file(most), file(more)).unwrap();
        let found = format!("is the mean of {more} pictures, expected at most {most}");
        folder.fails(SMALL, &format!("`c/means/{name}-{more}.exr` {found}: {RESTORE}"));
        fs::remove_file(file(more)).unwrap();
    }
    // Runs without their pictures: the bias would be that of fewer pictures, or left out.
    let missing = "`c/runs.csv` has 2 runs with 2 samples, but `c/means/1-one-2.exr` is missing";
    let remove = |path: &Path| fs::remove_file(path).unwrap();
    refuses(&folder, "c/means/1-one-2.exr", remove, &format!("{missing}: {RESTORE}"));
    let broken = |path: &Path| fs::write(path, "no picture").unwrap();
    let path = folder.0.join("c/means/check-4.exr");
    let good = fs::read(&path).unwrap();
    broken(&path);
    let said = String::from_utf8(folder.run(SMALL).stderr).unwrap();
    assert!(
        said.starts_with("error: cannot read `c/means/check-4.exr`: ")
            && said.ends_with(&format!("; {RESTORE}\n")),
        "{said}"
    );
    fs::write(&path, good).unwrap();

    // A reference that is missing is rendered again, and a mean that was replaced by one of more pictures is removed.
    fs::remove_file(folder.0.join("c/means/reference-8.exr")).unwrap();
    fs::copy(folder.0.join("c/means/1-one-2.exr"), folder.0.join("c/means/1-one-1.exr")).unwrap();
    folder.prints(SMALL);
    assert!(!folder.0.join("c/means/1-one-1.exr").exists());
    assert_eq!(lasting(&folder), whole);
}

#[test]
fn plans_that_no_chart_wrote_are_refused() {
    let folder = small_folder("chart_plan");
    folder.prints(SMALL);
    let text = fs::read_to_string(folder.0.join("c/plan.toml")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[..5],
        [
            "# What `lobe chart` renders here.",
            "budgets = [1, 2]",
            "seeds = 2",
            "part_spp = 8",
            "means = [\"1-one\", \"2-two--light\"]",
        ]
    );
    let refused = |text: &str, message: &str| {
        let message =
            format!("{message}; this is not a plan of `lobe chart`: choose another folder with -o");
        refuses(&folder, "c/plan.toml", |path| fs::write(path, text).unwrap(), &message);
    };
    let rising = "expected a rising list, each a whole number from 1 to 16777215";
    for (line, problem) in [
        ("budgets = 7", format!("2:11: `budgets` is 7, {rising}")),
        ("budgets = []", format!("2:11: `budgets` is [], {rising}")),
        ("budgets = [0, 2]", format!("2:11: `budgets` is [0, 2], {rising}")),
        ("budgets = [2, 2]", format!("2:11: `budgets` is [2, 2], {rising}")),
        ("budgets = [1, 16777216]", format!("2:11: `budgets` is [1, 16777216], {rising}")),
        ("seeds = 1", "3:9: `seeds` is 1, expected a whole number from 2 to 64".into()),
        ("seeds = 65", "3:9: `seeds` is 65, expected a whole number from 2 to 64".into()),
        ("part_spp = 0", "4:12: `part_spp` is 0, expected a whole number from 1 to 67108864".into()),
        (
            "means = [\"../../x\"]",
            "5:9: `means` is [\"../../x\"], expected a list of names of letters, digits and hyphens".into(),
        ),
        (
            "fingerprint = -1",
            "6:15: `fingerprint` is -1, expected a whole number from 0 to 4294967295".into(),
        ),
    ] {
        let key = line.split(' ').next().unwrap();
        let changed: Vec<&str> =
            lines.iter().map(|old| if old.starts_with(key) { line } else { old }).collect();
        refused(&changed.join("\n"), &format!("c/plan.toml:{problem}"));
    }
    refused(
        &text.replace("fingerprint", "print"),
        "c/plan.toml:6:1: unknown key `print` in the plan of a chart; expected `budgets`, `seeds`, `part_spp`, `means`, \
         `fingerprint` or `starting`",
    );
    refused(
        &text.replace("seeds = 2\n", ""),
        "c/plan.toml:1:1: the plan of a chart lacks `seeds`, expected a whole number from 2 to 64",
    );
    let comment = "#".repeat(1 << 20);
    refused(
        &format!("{text}{comment}"),
        &format!(
            "`c/plan.toml` has {} bytes, expected at most 1048576",
            text.len() + comment.len()
        ),
    );
    // Changed by hand: what is there was rendered by another plan. Seen to be taken when only the methods were in the checksum.
    let another = "`c/plan.toml` holds a chart of another scene, or with other settings: choose another folder with -o, \
                   or start again with --fresh";
    for (old, new) in
        [("[1, 2]", "[1, 2, 4]"), ("seeds = 2", "seeds = 3"), ("part_spp = 8", "part_spp = 9")]
    {
        folder.write("c/plan.toml", &text.replace(old, new));
        folder.fails(&SMALL.replace("--budgets 1,2", ""), another);
    }
    folder.write("c/plan.toml", &text);
    folder.prints(&SMALL.replace("--budgets 1,2", ""));
    folder.prints(&format!("{SMALL} --reference 64"));
    folder.fails(&format!("{SMALL} --reference 65"), another);
}

/// Plans with a byte changed, removed or repeated are refused in one line, or leave the figures as they are.
#[test]
fn plans_with_any_byte_changed_are_refused_or_harmless() {
    let folder = small_folder("chart_plan_bytes");
    folder.prints(SMALL);
    let whole = lasting(&folder);
    let text = fs::read(folder.0.join("c/plan.toml")).unwrap();
    let mut state = 7_u32;
    let mut random = |bound: usize| {
        // Numerical Recipes' generator.
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as usize % bound
    };
    for _ in 0..40 {
        let mut changed = text.clone();
        let at = random(text.len());
        match random(3) {
            0 => changed[at] = b"0123456789\"[]=.,-#\n \xff\0"[random(22)],
            1 => drop(changed.remove(at)),
            _ => changed.insert(at, text[at]),
        }
        let shown = String::from_utf8_lossy(&changed).into_owned();
        fs::write(folder.0.join("c/plan.toml"), &changed).unwrap();
        let output = folder.run(SMALL);
        let said = String::from_utf8(output.stderr).unwrap();
        match output.status.code() {
            Some(0) => assert_eq!(lasting(&folder), whole, "{shown}"),
            code => {
                assert_eq!(code, Some(1), "{shown}");
                assert!(said.starts_with("error: ") && said.lines().count() == 1, "{said}{shown}");
                assert_eq!(fs::read(folder.0.join("c/plan.toml")).unwrap(), changed, "{shown}");
            }
        }
    }
}
