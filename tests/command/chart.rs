//! `lobe chart`: its files, that it resumes, and its messages for bad input.

mod kills;
mod ownership;
mod results;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::folder::{Folder, value};

/// A wall under the sky, for a chart of seven methods.
const SKY: &str = r#"
[camera]
eye = [0, 1, -3]
[film]
resolution = [20, 10]
[integrator]
type = "path"
max_depth = 2
[material.clay]
type = "matte"
[light.sky]
type = "sky"
radiance = [1, 1, 1]
[shape.wall]
obj = "wall.obj"
material = "clay"
"#;

const CHART: &str = "chart sky.toml --budgets 1,2,4 --seeds 3 -o c";

fn folder(test: &str) -> Folder {
    let folder = Folder::new(test);
    folder.write("sky.toml", SKY);
    folder
}

/// A chart of two methods that takes little time.
const SMALL: &str = "chart sky.toml --methods two.toml --budgets 1,2 --seeds 2 -o c";

const TWO: &str = "[methods]\none = ['sampler.type=\"sobol\"']\n\
                   \"two, light\" = ['integrator.strategy=\"light\"']\n";

fn small_folder(test: &str) -> Folder {
    let folder = folder(test);
    folder.write("two.toml", TWO);
    folder
}

/// All files below a folder, and what is in them.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all.extend(contents(&path));
        } else {
            let bytes = fs::read(&path).unwrap();
            all.insert(path, bytes);
        }
    }
    all
}

/// Columns of a table that do not depend on time, line by line.
fn lasting(folder: &Folder) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.0.join("c/curves.csv")).unwrap();
    let line = |line: &str| {
        let fields: Vec<&str> = line.rsplitn(9, ',').collect();
        fields
            .iter()
            .enumerate()
            .filter(|(i, _)| ![6, 7].contains(i))
            .map(|(_, f)| (*f).into())
            .collect()
    };
    text.lines().map(line).collect()
}

#[test]
fn chart_writes_curves_tables_and_a_page() {
    let folder = folder("chart");
    let summary = folder.prints(CHART);
    // With only a sky and surfaces `auto` equals `bsdf`, and roulette does not start before the third reflection.
    assert!(summary.contains("sobol, bsdf gives the same pictures as sobol here"), "{summary}");
    let names = ["independent", "stratified", "sobol", "blue-noise", "sobol, mis", "sobol, light"];
    for name in names {
        let line = format!("method     {name}: ");
        assert_eq!(summary.matches(&line).count(), 1, "{name} in {summary}");
    }
    for file in ["error-by-time.svg", "error-by-samples.svg", "equal-time.svg"] {
        let svg = fs::read_to_string(folder.0.join("c").join(file)).unwrap();
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{file}");
    }
    let page = fs::read_to_string(folder.0.join("c/index.html")).unwrap();
    // Self-contained: nothing is fetched, and each method has its picture and its error.
    assert!(!page.contains("src=\"h") && !page.contains("href="), "{page}");
    assert_eq!(page.matches("data:image/png;base64,").count(), 2 + 2 * names.len());
    assert_eq!(lasting(&folder).len(), 1 + 3 * names.len());
}

/// A chart that was interrupted at any time renders what is missing, and nothing else.
#[test]
fn chart_resumes_after_interruptions() {
    let folder = folder("chart_goes_on");
    folder.prints(CHART);
    let whole = lasting(&folder);
    let runs = folder.0.join("c/runs.csv");
    let text = fs::read_to_string(&runs).unwrap();
    // Within a line.
    fs::write(&runs, &text[..text.len() - 250]).unwrap();
    folder.prints(CHART);
    assert_eq!(lasting(&folder), whole);
    let again = fs::read_to_string(&runs).unwrap();
    assert_eq!(again.lines().count(), text.lines().count());
    let kept = text[..text.len() - 250].rfind('\n').unwrap();
    assert_eq!(again[..kept], text[..kept], "times that were there are kept");

    folder.prints(&format!("{CHART} --fresh"));
    assert_eq!(lasting(&folder), whole);
}

/// The time limit determines the samples, a list the methods, and pictures of other programs are points. No plan is as short as a
/// microsecond, whatever the trials cost, so the least one is taken.
#[test]
fn chart_takes_lists_and_pictures() {
    let folder = folder("chart_takes");
    folder.write(
        "list.toml",
        "[methods]\none = ['sampler.type=\"sobol\"', 'sampler.replicates=1']\n\
         \"two, light\" = ['integrator.strategy=\"light\"']\n",
    );
    folder.prints("render sky.toml --seed 99 --spp 8 -o other.exr --quiet");
    let chart = "chart sky.toml --methods list.toml --time 1e-6 --seeds 2 -o c";
    let summary = folder.prints(&format!("{chart} --add other=other.exr,0.5"));
    assert!(summary.contains("samples    [1, 2, 4] per pixel, 2 seeds each"), "{summary}");
    assert!(summary.contains("method     two, light: "), "{summary}");
    assert_eq!(value(&summary, "method"), "one:");
    let table = fs::read_to_string(folder.0.join("c/curves.csv")).unwrap();
    assert!(table.lines().last().unwrap().starts_with("\"other\",,1,,0.5,,"), "{table}");
    let svg = fs::read_to_string(folder.0.join("c/error-by-time.svg")).unwrap();
    assert!(svg.contains(">other</text>"), "{svg}");
    // Methods that differ only with more samples are kept as two, and a single budget is enough for a chart.
    folder.write(
        "list.toml",
        "[methods]\na = ['sampler.type=\"sobol\"', 'sampler.replicates=4']\n\
         b = ['sampler.type=\"sobol\"', 'sampler.replicates=8']\n",
    );
    let summary =
        folder.prints("chart sky.toml --methods list.toml --budgets 8 --seeds 2 -o e --threads 1");
    assert!(
        summary.contains("method     b: ") && !summary.contains("gives the same pictures"),
        "{summary}"
    );
    let other =
        folder.run("chart sky.toml --methods list.toml --budgets 8 --seeds 2 -o e --threads 2");
    assert_eq!(other.status.code(), Some(1), "times of another number of threads");
}

#[test]
fn chart_says_what_is_wrong() {
    let folder = folder("chart_wrong");
    folder.prints("render s.toml -o small.exr --set film.resolution=[4,4] --quiet");
    folder.prints(CHART);
    let another = "`c/plan.toml` holds a chart of another scene, or with other settings: choose another folder with -o, \
                   or start again with --fresh";
    folder.fails(&format!("{CHART} --set film.resolution=[21,10]"), another);
    folder
        .fails(&format!("{CHART} --add x=no.exr,1"), "cannot read `no.exr`: there is no such file");
    folder.fails(
        // Errors are found before anything is rendered: the folder does not exist yet.
        "chart sky.toml -o new --add x=small.exr,1",
        "`small.exr`: the images have 4 x 4 and 20 x 10 pixels: they have to be of one size",
    );
    folder.fails("chart no.toml", "no.toml: there is no such file");
    let expected = "; expected a table [methods] with lines such as\n  \
                    \"sobol, one set\" = ['sampler.type=\"sobol\"', 'sampler.replicates=1']";
    for (list, message) in [
        ("", format!("1:1: there are no methods{expected}")),
        ("\n[methods]", format!("2:1: there are no methods{expected}")),
        (
            "[method]\na = []",
            "1:2: unknown key `method` in the list of methods; did you mean `methods`?".into(),
        ),
        ("methods = 1", "1:11: `methods` is 1, expected a table".into()),
        ("[methods]\na = 1", "2:5: `a` is 1, expected a list of settings in quotes".into()),
        ("[methods]\na = [\n7]", "3:1: 7 is not a setting in quotes".into()),
        ("[methods]\na = [", "2:6: not valid TOML: unclosed array, expected `]`".into()),
        (
            "[methods]\na = ['film.resolution=[1,1]']",
            "2:6: `film.resolution=[1,1]` is not a setting of a method: expected `sampler.` or `integrator.`"
                .into(),
        ),
        (
            "[methods]\na = [\n  'sampler.type=\"sobl\"']",
            "3:3: method `a`: --set sampler.type=\"sobl\": `sampler.type` is \"sobl\", expected \"independent\", \
             \"stratified\", \"sobol\" or \"blue-noise\""
                .into(),
        ),
        (
            "[methods]\na = ['sampler.replicates=1', 'sampler.replicate=1']",
            "2:30: method `a`: --set sampler.replicate=1: unknown key `replicate` in [sampler]; did you mean \
             `replicates`?"
                .into(),
        ),
        (
            "[methods]\na = ['sampler.spp=4']",
            "2:6: `sampler.spp=4` has no effect: it is chosen by --budgets and --seeds".into(),
        ),
        (
            "[methods]\n\"a\\nb\" = []",
            "2:1: \"a\\nb\" is not a name of one line and at most 80 bytes".into(),
        ),
    ] {
        folder.write("list.toml", list);
        let message = format!("list.toml:{message}");
        folder.fails("chart sky.toml --methods list.toml -o d", &message);
    }
    folder.fails("chart sky.toml --methods no.toml", "no.toml: there is no such file");
    // What is wrong without any method is not said of the list.
    folder.fails(
        "chart sky.toml --methods list.toml --set film.reslution=[1,1]",
        "--set film.reslution=[1,1]: unknown key `reslution` in [film]; did you mean `resolution`?",
    );
}

/// Seen to fail with `--effort` parsed as seconds, and with options that have no effect accepted in silence.
#[test]
fn chart_refuses_arguments_without_effect() {
    let folder = Folder::new("chart_usage");
    let says = |arguments: &str, message: &str| {
        let output = folder.run(&format!("chart {arguments}"));
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments}: {said}");
        assert!(said.contains(message), "{arguments}: {said}");
    };
    for usage in ["--budgets 0", "--seeds 1", "--threads 0", "--add x", "--add x=a.exr,fast"] {
        says(&format!("s.toml {usage}"), "invalid value");
    }
    says("s.toml --time 0", "expected a time above 0");
    for factor in ["0", "-1", "inf", "nan", "x"] {
        says(&format!("--stability --effort={factor}"), "expected a number above 0");
    }
    for option in [
        "--set=film.resolution=[1,1]",
        "--methods=list.toml",
        "--time=300",
        "--budgets=1",
        "--seeds=8",
        "--reference=8",
        "--add=x=a.exr,1",
        "--fresh",
        "--threads=1",
    ] {
        let (name, _) = option.split_once('=').unwrap_or((option, ""));
        says(&format!("--stability {option}"), "cannot be used with");
        says(&format!("--stability {option}"), name);
    }
    says("s.toml --time 60 --budgets 1", "cannot be used with");
    says("s.toml --effort 2", "cannot be used with");
    says("--effort 2", "required");
    says("s.toml --stability", "cannot be used with");
    says("", "required");
    assert_eq!(folder.files(), ["s.toml", "wall.obj"]);
}

/// Seeds after the largest one begin again at 0. Seen to fail, with overflow checks, with a plain sum.
#[test]
fn chart_takes_the_largest_seed() {
    let folder = folder("chart_seed");
    let seed = u64::MAX;
    folder
        .prints(&format!("chart sky.toml --budgets 1,2 --seeds 2 -o c --set sampler.seed={seed}"));
    let runs = fs::read_to_string(folder.0.join("c/runs.csv")).unwrap();
    let seeds: Vec<&str> = runs.lines().skip(1).filter_map(|run| run.rsplit(',').nth(5)).collect();
    assert!(seeds.contains(&"0") && seeds.contains(&"1"), "{runs}");
    assert!(seeds.iter().all(|seed| ["0", "1"].contains(seed)), "{runs}");
}

/// All sweeps have a chart, and ours keeps its bounds. Seen to fail with a bound of zero for the sums.
#[test]
fn stability_has_a_chart_for_each_question() {
    let folder = Folder::new("chart_stability");
    // An earlier chart, which is replaced, and a file that stays.
    fs::create_dir(folder.0.join("s")).unwrap();
    folder.write("s/stability.csv", "sweep,parameter,method,is_ours,value,bound\n");
    folder.write("s/notes.txt", "mine");
    let summary = folder.prints("chart --stability --effort 0.01 -o s");
    let table = fs::read_to_string(folder.0.join("s/stability.csv")).unwrap();
    let page = fs::read_to_string(folder.0.join("s/index.html")).unwrap();
    let names: Vec<&str> = summary
        .lines()
        .filter_map(|line| line.strip_prefix("sweep  ")?.split(':').next())
        .collect();
    assert!(names.len() >= 20, "{summary}");
    for name in &names {
        assert!(folder.0.join(format!("s/{name}.svg")).exists(), "{name}");
        assert!(table.contains(&format!("\n{name},")), "{name}");
    }
    assert_eq!(page.matches("<svg").count(), names.len());
    assert_eq!(fs::read_to_string(folder.0.join("s/notes.txt")).unwrap(), "mine");
}
