//! The dragon itself, in parts. It looks towards -x; y is up, the ground is y = 0.

mod body;
mod feet;
mod head;
mod legs;
mod mane;
mod mouth;

use glam::{DVec3, DVec4};

use crate::scales::smoothstep;
use crate::sculpture::{Join, Sculpture};

/// A box that holds the whole dragon with room to spare.
pub const LOW: DVec3 = DVec3::new(-2.6, -0.3, -1.4);
/// The other corner of the box.
pub const HIGH: DVec3 = DVec3::new(2.6, 3.5, 1.4);

/// Puts the dragon together.
pub fn dragon() -> Sculpture {
    let mut s = Sculpture::default();
    let spine = body::spine();
    let mut crest = body::crest(&spine);
    crest.extend(body::flame(&spine));
    s.group(Join::Add, 0.0, 0.0);
    s.tube(spine);
    legs::legs(&mut s);
    let skull = head::Skull::new();
    head::head(&mut s, &skull);
    mouth::mouth(&mut s, &skull);
    mane::mane(&mut s, &skull);
    s.group(Join::Add, 0.03, 0.0);
    for spike in crest {
        s.tube(spike);
    }
    // The ground cuts the soles flat.
    s.group(Join::Carve, 0.01, 0.0);
    s.beyond(DVec3::NEG_Y, 0.0);
    s
}

/// How much a place is looked at: the face most, the tail and the rump least.
pub fn interest(p: DVec3) -> f64 {
    let from_face = p.distance(DVec3::new(-1.75, 2.35, 0.0));
    let face = 8.0 * (1.0 - smoothstep(0.35, 0.8, from_face));
    let rear = 0.6 * smoothstep(0.6, 1.4, p.x);
    1.0 + face - rear
}

/// A key of a curve: position and radius.
fn key(x: f64, y: f64, z: f64, radius: f64) -> DVec4 {
    DVec4::new(x, y, z, radius)
}
