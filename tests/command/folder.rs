//! Temporary folders in which tests run the command.

use std::ffi::OsStr;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

use crate::folders;

const SCENE: &str = r#"
[camera]
eye = [0, 1, -3]
[film]
resolution = [20, 10]
[sampler]
type = "independent"
spp = 2
[integrator]
type = "chapter"
[material.clay]
type = "matte"
[light.key]
type = "point"
position = [0, 3, -3]
intensity = [9, 9, 9]
[shape.wall]
obj = "wall.obj"
material = "clay"
"#;

const WALL: &str = "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nv 9 9 9\nf 1 2 3\nf 1 3 4\nf 1 1 2\n";

/// A temporary folder that contains `s.toml` and `wall.obj`, and nothing else. It is removed unless its test fails.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(test: &str) -> Self {
        let path = folders::of_this_run().join(test);
        fs::create_dir(&path).unwrap();
        let folder = Self(path);
        folder.write("s.toml", SCENE);
        folder.write("wall.obj", WALL);
        folder
    }

    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    pub fn command<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lobe"));
        command.current_dir(&self.0).args(arguments);
        command
    }

    /// The command in a shell that sets limits first, with arguments separated by blanks.
    pub fn limited(&self, limits: &str, arguments: &str) -> Command {
        let script = format!("{limits}; exec \"$0\" \"$@\"");
        let mut command = Command::new("sh");
        command.current_dir(&self.0).args(["-c", &script, env!("CARGO_BIN_EXE_lobe")]);
        command.args(arguments.split_whitespace());
        command
    }

    /// The bytes of an EXR file, without the time that rendering took.
    pub fn exr(&self, name: &str) -> Vec<u8> {
        let mut bytes = fs::read(self.0.join(name)).unwrap();
        let key = b"renderSeconds\0double\0";
        let at = bytes.windows(key.len()).position(|window| window == key).unwrap() + key.len();
        bytes[at + 4..at + 12].fill(0);
        bytes
    }

    /// Runs the command in the folder, with arguments separated by blanks.
    pub fn run(&self, arguments: &str) -> Output {
        self.command(arguments.split_whitespace()).output().unwrap()
    }

    /// The standard output of a successful run, which prints nothing on stderr.
    #[track_caller]
    pub fn prints(&self, arguments: &str) -> String {
        let Output { status, stdout, stderr } = self.run(arguments);
        assert_eq!(String::from_utf8(stderr).unwrap(), "");
        assert!(status.success());
        String::from_utf8(stdout).unwrap()
    }

    /// Asserts the whole of stderr, exit code 1, and that nothing is printed or left behind.
    #[track_caller]
    pub fn fails(&self, arguments: &str, message: &str) {
        let before = self.files();
        let Output { status, stdout, stderr } = self.run(arguments);
        assert_eq!(String::from_utf8(stderr).unwrap(), format!("error: {message}\n"));
        assert_eq!(String::from_utf8(stdout).unwrap(), "");
        assert_eq!(status.code(), Some(1));
        assert_eq!(self.files(), before);
    }

    pub fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        let mut names: Vec<_> =
            entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            let _ = fs::remove_dir_all(&self.0);
        }
    }
}

/// The first word of the value of a key in a summary.
#[track_caller]
pub fn value<'a>(summary: &'a str, key: &str) -> &'a str {
    let mut lines = summary.lines().map(|line| line.split_whitespace());
    let words = lines.find_map(|mut words| (words.next()? == key).then_some(words));
    words.and_then(|mut words| words.next()).unwrap_or_else(|| panic!("no {key} in {summary}"))
}
