//! [`State`]: a render on disk, from which `--resume` goes on.

use std::error::Error;
use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use lobe::image::{WriteError, check_writable, write_file_with};
use lobe::params::Shown;
use lobe::render::Checkpoint;

use crate::identity::difference;

/// First line of the file.
const MAGIC: &str = "a render that lobe can go on with, version 1";

/// The file of a render. It holds [`MAGIC`], lines that tell what is rendered, an empty line, the bytes of a
/// [`Checkpoint`], and a CRC-32 of all before it.
pub struct State {
    pub path: PathBuf,
    /// What is rendered: lines `key = value`.
    identity: String,
}

impl State {
    /// The file beside an output, with another extension. Checks that it can be written.
    pub fn beside(output: &Path, identity: String) -> Result<Self, WriteError> {
        let path = output.with_extension("state");
        check_writable(&path)?;
        Ok(Self { path, identity })
    }

    /// The bytes of the checkpoint; `None` if there is no file.
    pub fn load(&self) -> Result<Option<Vec<u8>>, Box<dyn Error>> {
        let path = Shown::path(&self.path);
        let mut bytes = match read(&self.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(format!("cannot read `{path}`: {error}").into()),
        };
        let Some((head, start)) = split(&bytes) else {
            let advice = "remove it or give the output another name";
            return Err(
                format!("`{path}` is not the state of a render, or damaged: {advice}").into()
            );
        };
        if let Some(difference) = difference(&self.identity, head, ["here", "there"]) {
            let advice = "render with the same settings, or remove the file to start again";
            return Err(format!("`{path}` is of another render: {difference}; {advice}").into());
        }
        bytes.truncate(bytes.len() - SUM);
        bytes.drain(..start);
        Ok(Some(bytes))
    }

    /// Replaces the file, whole or not at all.
    pub fn save(&self, checkpoint: &Checkpoint) -> Result<(), WriteError> {
        write_file_with(&self.path, |file| {
            let mut to = Summed { to: BufWriter::new(file), sum: crc32fast::Hasher::new() };
            to.write_all(format!("{MAGIC}\n{}\n\n", self.identity).as_bytes())?;
            checkpoint.write(&mut to)?;
            let Summed { mut to, sum } = to;
            to.write_all(&sum.finalize().to_le_bytes())?;
            to.flush()
        })
    }

    /// Removes the file of a render that is complete.
    pub fn remove(&self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// The contents of a file that begins with [`MAGIC`]; the beginning alone of any other.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = File::open(path)?;
    let (mut bytes, length) = (vec![0; MAGIC.len()], file.metadata()?.len());
    if file.read_exact(&mut bytes).is_ok() && bytes == MAGIC.as_bytes() {
        bytes.try_reserve_exact(usize::try_from(length).unwrap_or(usize::MAX))?;
        file.read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

/// Bytes of the checksum.
const SUM: usize = 4;

/// The lines of a sound file, and where its checkpoint begins.
fn split(bytes: &[u8]) -> Option<(&str, usize)> {
    let (all, sum) = bytes.split_last_chunk::<SUM>()?;
    let rest = all.strip_prefix(MAGIC.as_bytes())?.strip_prefix(b"\n")?;
    let length = rest.windows(2).position(|pair| pair == b"\n\n")?;
    let is_sound = crc32fast::hash(all) == u32::from_le_bytes(*sum);
    let head = str::from_utf8(&rest[..length]).ok()?;
    is_sound.then_some((head, MAGIC.len() + 1 + length + 2))
}

/// A writer that keeps a checksum of what is written.
struct Summed<W> {
    to: W,
    sum: crc32fast::Hasher,
}

impl<W: Write> Write for Summed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}
