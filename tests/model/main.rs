//! OBJ files in place of scene files: where the camera stands, and which scene is made.

#[path = "../folders/mod.rs"]
mod folders;
mod framing;
mod projection;
#[path = "../foundations/common/rng.rs"]
#[allow(dead_code, reason = "each test binary uses a part of it")]
mod rng;
mod scenes;
