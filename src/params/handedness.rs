//! [`Handedness`]: how a world's axes were meant.

use super::choice::Choice;
use super::key::Key;

/// On which side of the view the right of an image lies: how a world's axes were meant.
///
/// With x to the right and y up, z points away from the viewer in a left-handed space and towards the viewer in a
/// right-handed one. In a world that was made in the other kind, a camera shows everything mirrored, text included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Handedness {
    /// Left-handed, as in PBRT: the right of the image is up × view.
    #[default]
    Left,
    /// Right-handed, as in Blender, glTF and most other programs: the right of the image is view × up.
    Right,
}

impl Handedness {
    /// The scene-file key by which cameras and environment maps read it.
    pub const KEY: Key<Self> = Key::new(
        "handedness",
        "of the world: \"left\" as in PBRT, \"right\" as in Blender, glTF and most other programs",
    )
    .default(Self::Left);
}

impl Choice for Handedness {
    const CHOICES: &'static [(&'static str, Self)] =
        &[("left", Self::Left), ("right", Self::Right)];
}
