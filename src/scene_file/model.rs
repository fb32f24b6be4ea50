//! Scenes that are made for an OBJ file alone: the model, a camera that sees all of it, a sky and a key light.

use std::f32::consts::PI;
use std::path::Path;

use glam::{UVec2, Vec3};

use crate::camera::{Handedness, PerspectiveSettings};
use crate::params::{Entry, Fault, Mark, Node, Problem, Value};

/// The name of the model among the shapes.
pub const NAME: &str = "model";

/// Material of a model without any.
const GREY: &str = "grey";

const FOV: f32 = 40.0;
const RESOLUTION: UVec2 = UVec2::new(800, 600);
const SPP: u64 = 64;
/// Glass takes two refractions for each of its surfaces.
const MAX_DEPTH: u64 = 16;

/// Radiance of the sky. Together with the key light, white surfaces are brighter than what is behind them, and are not clipped.
const SKY: f32 = 0.6;
/// Irradiance of the key light, from above and left of the camera.
const KEY: f32 = 1.5;
const KEY_DIRECTION: [f32; 3] = [0.55, -0.75, -0.65];

/// Where the camera stands: right of the front, which is towards +z.
const AZIMUTH: f32 = 30.0 * PI / 180.0;
const ELEVATION: f32 = 20.0 * PI / 180.0;
/// The elevation for what lies flat.
const ELEVATION_FLAT: f32 = 50.0 * PI / 180.0;
/// Height over the smaller horizontal extent below which something lies flat.
const FLAT: f32 = 0.1;

/// Whether this is the name of a model, and not of a scene file.
pub fn is_model(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("obj"))
}

/// The tables of a scene with the model at `path`, for overrides to be applied to. What depends on these is added later.
pub fn tree(path: &Path) -> Node {
    let resolution = RESOLUTION.to_array().map(u64::from).into_iter().collect();
    let path = path.to_string_lossy();
    let sky = table([("type", "sky".into()), ("radiance", array([SKY; 3]))]);
    let key = table([
        ("type", "distant".into()),
        ("direction", array(KEY_DIRECTION)),
        ("irradiance", array([KEY; 3])),
    ]);
    Node::table([
        ("camera", table([("handedness", "right".into()), ("fov", FOV.into())])),
        ("film", table([("resolution", resolution)])),
        ("sampler", table([("spp", SPP.into())])),
        ("integrator", table([("type", "path".into()), ("max_depth", MAX_DEPTH.into())])),
        ("material", table([(GREY, table([("type", "matte".into())]))])),
        ("light", table([("sky", sky), ("key", key)])),
        ("shape", table([(NAME, table([("obj", (&*path).into())]))])),
    ])
}

fn table<'k>(entries: impl IntoIterator<Item = (&'k str, Value)>) -> Value {
    Node::table(entries).value
}

fn array(numbers: [f32; 3]) -> Value {
    numbers.into_iter().collect()
}

/// Sets where the camera stands, unless an override does or replaces the camera. `points` are in world space.
pub fn place_camera(root: &mut Node, points: impl Iterator<Item = Vec3> + Clone, film: UVec2) {
    let Some(camera) = own_table(root, &["camera"]) else { return };
    let along = direction(points.clone());
    let settings = PerspectiveSettings {
        eye: along,
        look_at: Vec3::ZERO,
        handedness: Handedness::Right,
        fov: FOV,
        ..PerspectiveSettings::default()
    };
    // Its direction is neither zero nor up, and the film has pixels.
    let Ok(settings) = settings.framing(points, film) else { return };
    for (key, point) in [("look_at", settings.look_at), ("eye", settings.eye)] {
        if camera.iter().all(|entry| entry.key != key) {
            camera.insert(0, entry(key, array(point.to_array())));
        }
    }
}

/// Makes the model grey, unless an override replaces it.
pub fn make_grey(root: &mut Node) {
    if let Some(shape) = own_table(root, &["shape", NAME]) {
        shape.push(entry("material", GREY.into()));
    }
}

/// Takes the grey material away from a model that has others.
///
/// # Errors
/// If an override sets something of it.
pub fn drop_grey(root: &mut Node) -> Result<(), Fault> {
    let Value::Table(entries) = &mut root.value else { return Ok(()) };
    let materials = entries.iter().filter(|entry| entry.key == "material");
    if let Some(mark) = materials.flat_map(|entry| entry.node.entries()).find_map(overridden) {
        let problem = Problem::unknown_name("material", GREY, [].into_iter());
        return Err(Fault { mark, problem });
    }
    entries.retain(|entry| entry.key != "material");
    Ok(())
}

/// Where an override stands that set this or something in it.
fn overridden(entry: &Entry) -> Option<Mark> {
    let mark = entry.node.mark;
    let is_own = mark.source == 0;
    if is_own { entry.node.entries().iter().find_map(overridden) } else { Some(mark) }
}

/// From the model to the camera.
fn direction(points: impl Iterator<Item = Vec3>) -> Vec3 {
    let (mut min, mut max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    points.for_each(|p| (min, max) = (min.min(p), max.max(p)));
    let extent = max - min;
    let is_flat = extent.y < FLAT * extent.x.min(extent.z);
    let elevation = if is_flat { ELEVATION_FLAT } else { ELEVATION };
    let (up, out) = elevation.sin_cos();
    Vec3::new(out * AZIMUTH.sin(), up, out * AZIMUTH.cos())
}

/// The entries of a table that no override has replaced.
fn own_table<'a>(mut node: &'a mut Node, keys: &[&str]) -> Option<&'a mut Vec<Entry>> {
    for key in keys {
        let Value::Table(entries) = &mut node.value else { return None };
        node = &mut entries.iter_mut().find(|entry| entry.key == *key)?.node;
    }
    match &mut node.value {
        Value::Table(entries) if node.mark.source == 0 => Some(entries),
        _ => None,
    }
}

fn entry(key: &str, value: Value) -> Entry {
    let mark = Default::default();
    Entry { key: key.to_owned(), mark, node: Node { mark, value } }
}
