//! The head: skull, snout, brows, eyes, ears and horns.

use glam::{DMat3, DVec3, DVec4};

use crate::scales::Skin;
use crate::sculpture::{Join, Sculpture};
use crate::tube::Tube;

/// Size of the head: the lengths of this file are multiplied by it.
const SIZE: f64 = 1.12;

/// The head's own frame: forward along the snout, up, and to its side (mirrored for the other).
pub struct Skull {
    origin: DVec3,
    frame: DMat3,
}

impl Skull {
    /// The head where the neck ends.
    pub fn new() -> Skull {
        let forward = DVec3::new(-1.0, -0.06, -0.20).normalize();
        let side = forward.cross(DVec3::Y).normalize();
        let frame = DMat3::from_cols(forward, side.cross(forward), side);
        Skull { origin: DVec3::new(-1.36, 2.37, 0.09), frame }
    }

    /// The point `f` ahead, `u` up and `s` aside of the middle of the skull.
    pub fn at(&self, f: f64, u: f64, s: f64) -> DVec3 {
        self.origin + self.frame * (DVec3::new(f, u, s) * SIZE)
    }

    /// The key of a curve at such a point.
    pub fn key(&self, f: f64, u: f64, s: f64, radius: f64) -> DVec4 {
        self.at(f, u, s).extend(radius * SIZE)
    }

    /// Keys given as (f, u, s, radius), with the side multiplied by `mirror`.
    pub fn keys(&self, keys: &[[f64; 4]], mirror: f64) -> Vec<DVec4> {
        keys.iter().map(|k| self.key(k[0], k[1], k[2] * mirror, k[3])).collect()
    }

    /// Adds an ellipsoid with its axes along the head's.
    pub fn ellipsoid(&self, s: &mut Sculpture, at: [f64; 3], radii: [f64; 3]) {
        let centre = self.at(at[0], at[1], at[2]);
        s.ellipsoid(centre, self.frame, DVec3::from_array(radii) * SIZE);
    }

    /// Direction to the head's side.
    pub fn side(&self) -> DVec3 {
        self.frame.z_axis
    }
}

/// Both sides of the head.
pub const SIDES: [f64; 2] = [-1.0, 1.0];

/// Builds the head without its mouth and hair.
pub fn head(s: &mut Sculpture, skull: &Skull) {
    flesh(s, skull);
    hollows(s, skull);
    eyes(s, skull);
    horns(s, skull);
}

fn flesh(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Add, 0.10, 0.06);
    skull.ellipsoid(s, [-0.02, 0.02, 0.0], [0.27, 0.20, 0.20]);
    // The snout, rising to the nose.
    s.bone(&skull.keys(
        &[
            [0.05, 0.03, 0.0, 0.15],
            [0.26, 0.03, 0.0, 0.125],
            [0.47, 0.03, 0.0, 0.10],
            [0.68, 0.09, 0.0, 0.085],
        ],
        1.0,
    ));
    skull.ellipsoid(s, [0.70, 0.085, 0.0], [0.105, 0.08, 0.10]);
    // Wrinkles across the snout.
    for (f, u, wide) in [(0.36, 0.135, 0.06), (0.44, 0.12, 0.06), (0.52, 0.118, 0.06)] {
        s.cone(skull.at(f, u, wide), 0.026 * SIZE, skull.at(f, u, -wide), 0.026 * SIZE);
    }
    for m in SIDES {
        // Nostrils' wings, cheeks, lips.
        skull.ellipsoid(s, [0.70, 0.135, 0.085 * m], [0.075, 0.05, 0.045]);
        s.bone(&skull.keys(
            &[
                [0.74, 0.12, 0.075, 0.03],
                [0.66, 0.18, 0.105, 0.034],
                [0.58, 0.205, 0.13, 0.022],
                [0.52, 0.19, 0.15, 0.008],
            ],
            m,
        ));
        skull.ellipsoid(s, [0.02, -0.07, 0.15 * m], [0.17, 0.13, 0.10]);
        s.bone(&skull.keys(
            &[
                [0.08, -0.10, 0.165, 0.045],
                [0.28, -0.085, 0.145, 0.048],
                [0.48, -0.055, 0.125, 0.042],
                [0.66, 0.005, 0.115, 0.048],
                [0.78, 0.05, 0.055, 0.048],
            ],
            m,
        ));
    }
}

fn hollows(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Carve, 0.04, 0.0);
    for m in SIDES {
        skull.ellipsoid(s, [0.20, 0.085, 0.21 * m], [0.10, 0.07, 0.075]);
    }
    s.group(Join::Carve, 0.02, 0.0);
    for m in SIDES {
        skull.ellipsoid(s, [0.755, 0.135, 0.115 * m], [0.04, 0.02, 0.028]);
    }
}

fn eyes(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Add, 0.012, 0.0);
    for m in SIDES {
        skull.ellipsoid(s, [0.195, 0.085, 0.135 * m], [0.068, 0.06, 0.06]);
    }
    // Pupils.
    s.group(Join::Carve, 0.008, 0.0);
    for m in SIDES {
        skull.ellipsoid(s, [0.222, 0.085, 0.198 * m], [0.018, 0.034, 0.02]);
    }
    s.group(Join::Add, 0.03, 0.0);
    for m in SIDES {
        // Brow: from the bridge of the nose over the eye into a spike behind it.
        s.bone(&skull.keys(
            &[
                [0.36, 0.115, 0.075, 0.03],
                [0.26, 0.165, 0.135, 0.05],
                [0.10, 0.19, 0.18, 0.055],
                [-0.04, 0.22, 0.22, 0.04],
                [-0.18, 0.29, 0.27, 0.008],
            ],
            m,
        ));
        // Lower lid.
        s.bone(&skull.keys(
            &[[0.28, 0.045, 0.13, 0.018], [0.19, 0.02, 0.165, 0.022], [0.09, 0.05, 0.185, 0.018]],
            m,
        ));
        // Ear.
        let ear = skull.keys(
            &[[-0.12, 0.03, 0.19, 0.05], [-0.24, 0.08, 0.28, 0.075], [-0.42, 0.12, 0.36, 0.01]],
            m,
        );
        s.tube(Tube::new(&ear).side(skull.side()).oval(0.4));
    }
}

fn horns(s: &mut Sculpture, skull: &Skull) {
    s.group(Join::Add, 0.03, 0.0);
    for m in SIDES {
        let horn = skull.keys(
            &[
                [-0.06, 0.15, 0.09, 0.072],
                [-0.20, 0.29, 0.14, 0.062],
                [-0.42, 0.37, 0.20, 0.048],
                [-0.66, 0.39, 0.23, 0.034],
                [-0.90, 0.48, 0.22, 0.008],
            ],
            m,
        );
        s.tube(Tube::new(&horn).skin(Skin::Rings { depth: 0.10 }, (0.5, 1.0)));
    }
    s.group(Join::Add, 0.03, 0.0);
    for m in SIDES {
        let branch = [
            [-0.32, 0.33, 0.17, 0.042],
            [-0.40, 0.44, 0.185, 0.034],
            [-0.44, 0.54, 0.20, 0.022],
            [-0.53, 0.62, 0.21, 0.006],
        ];
        s.bone(&skull.keys(&branch, m));
    }
}
