//! [`Camera`]: perspective, with a thin lens if it has one.

use glam::{DVec3, UVec2, Vec2, Vec3, Vec4};

use crate::geometry::Ray;
use crate::geometry::float::LARGEST_COORDINATE;
use crate::geometry::four::{Vec3x4, four, rays_x4};
use crate::params::{AnyKey, Fault, Key, Kind, Table};
use crate::sampling::concentric_disk;

/// Why a camera cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// A setting is infinite, not a number, or farther out than [`LARGEST_COORDINATE`].
    #[error("the camera's {0} is not finite, or is beyond 1e12")]
    OutOfRange(&'static str),
    /// There is no direction of view.
    #[error("the camera's eye and look_at are the same point, so it looks nowhere")]
    NoDirection,
    /// The image could be turned any way round.
    #[error("the camera's up is zero or points along its view, so which side is up is open")]
    NoUp,
    /// The field of view is no angle that an image plane can have.
    #[error("the camera's fov is {0} degrees: it has to be above 0 and below 180")]
    Fov(f32),
    /// A lens has a size of 0 or more.
    #[error("the camera's lens_radius is {0}: it cannot be negative")]
    LensRadius(f32),
    /// The plane in focus lies in front of the camera.
    #[error("the camera's focal_distance is {0}: it has to be above 0")]
    FocalDistance(f32),
    /// There is nothing to see through.
    #[error("the film's resolution is {0} x {1}: both have to be at least 1")]
    Resolution(u32, u32),
}

/// How a camera stands and sees. The defaults look from the origin along +z, 90 degrees wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSettings {
    /// Where it stands, in world space.
    pub eye: Vec3,
    /// A point in the middle of the image.
    pub look_at: Vec3,
    /// A direction that is up in the image; need not be across the view.
    pub up: Vec3,
    /// Field of view in degrees across the shorter side of the image, above 0 and below 180.
    pub fov: f32,
    /// Radius of the lens in scene units; 0 for a pinhole, which sees everything sharply.
    pub lens_radius: f32,
    /// Distance of the plane in focus along the view, in scene units. Only a lens looks at it.
    pub focal_distance: f32,
}

impl CameraSettings {
    /// From the origin along +z, 90 degrees wide, as a pinhole.
    pub const DEFAULT: Self = Self {
        eye: Vec3::ZERO,
        look_at: Vec3::Z,
        up: Vec3::Y,
        fov: 90.0,
        lens_radius: 0.0,
        focal_distance: 1.0,
    };
}

impl Default for CameraSettings {
    /// [`CameraSettings::DEFAULT`].
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// A perspective camera. Its space is PBRT's: left-handed, x to the right of the image, y up, z along
/// the view (PBRT 3rd edition, sections 2.7.7 and 6.2).
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    eye: Vec3,
    /// To the middle of the image, on the plane at distance 1.
    forward: Vec3,
    /// Along one pixel to the right and one down, on the same plane.
    pixel_x: Vec3,
    pixel_y: Vec3,
    half_resolution: Vec2,
    /// Half the width and half the height of the lens, as vectors in the world.
    lens: Option<[Vec3; 2]>,
    focal_distance: f32,
}

impl Camera {
    /// A camera for images of `resolution` pixels.
    ///
    /// # Errors
    /// If a setting is out of its range, or if the settings leave open where the camera looks.
    pub fn new(settings: &CameraSettings, resolution: UVec2) -> Result<Self, CameraError> {
        check(settings, resolution)?;
        // f64, so that a camera far away from the origin still looks where it should.
        let [eye, look_at, up]: [DVec3; 3] =
            [settings.eye, settings.look_at, settings.up].map(DVec3::from);
        let forward = (look_at - eye).try_normalize().ok_or(CameraError::NoDirection)?;
        let right =
            up.normalize_or_zero().cross(forward).try_normalize().ok_or(CameraError::NoUp)?;
        let up = forward.cross(right);
        let shorter_side = f64::from(resolution.min_element());
        let pixel = 2.0 * (f64::from(settings.fov).to_radians() / 2.0).tan() / shorter_side;
        let radius = f64::from(settings.lens_radius);
        Ok(Self {
            eye: settings.eye,
            forward: forward.as_vec3(),
            pixel_x: (right * pixel).as_vec3(),
            pixel_y: (-up * pixel).as_vec3(),
            half_resolution: resolution.as_vec2() / 2.0,
            lens: (radius > 0.0).then(|| [(right * radius).as_vec3(), (up * radius).as_vec3()]),
            focal_distance: settings.focal_distance,
        })
    }

    /// Whether rays depend on a point of the lens.
    #[inline]
    pub fn has_lens(&self) -> bool {
        self.lens.is_some()
    }

    /// The ray through the point `offset` in `[0, 1)²` of a pixel; (0, 0) is its upper left corner.
    /// Its direction has unit length. `lens_u` in `[0, 1)²` is only called for a lens.
    #[inline]
    pub fn generate_ray(&self, pixel: UVec2, offset: Vec2, lens_u: impl FnOnce() -> Vec2) -> Ray {
        let place = self.corner(pixel) + offset;
        let through = self.forward + place.x * self.pixel_x + place.y * self.pixel_y;
        let Some([lens_x, lens_y]) = self.lens else {
            return Ray::new(self.eye, through.normalize());
        };
        // All rays of one film point meet on the plane in focus (PBRT 3rd edition, section 6.2.3).
        let lens_point = concentric_disk::sample(lens_u());
        let on_lens = lens_point.x * lens_x + lens_point.y * lens_y;
        // Divided by the distance of that plane, which may be too large to multiply by.
        Ray::new(self.eye + on_lens, (through - on_lens / self.focal_distance).normalize())
    }
}

impl Camera {
    /// A pixel's upper left corner, in pixels from the middle of the image.
    #[inline]
    fn corner(&self, pixel: UVec2) -> Vec2 {
        pixel.as_vec2() - self.half_resolution
    }

    /// Adds to `rays` those through points of one pixel, [`Camera::generate_ray`] for each, of a camera without
    /// a lens.
    pub(crate) fn generate_pinhole_rays(
        &self,
        pixel: UVec2,
        offsets: &[Vec2],
        rays: &mut Vec<Ray>,
    ) {
        let corner = self.corner(pixel);
        let [eye, forward, pixel_x, pixel_y] =
            [self.eye, self.forward, self.pixel_x, self.pixel_y].map(Vec3x4::splat);
        let direction = |offsets: &[Vec2; 4]| {
            let x = Vec4::splat(corner.x) + Vec4::from_array(four(|i| offsets[i].x));
            let y = Vec4::splat(corner.y) + Vec4::from_array(four(|i| offsets[i].y));
            let through = forward + pixel_x * x + pixel_y * y;
            through * (1.0 / through.length_squared().sqrt())
        };
        // Two times four, so that the processor has something to do while it waits for a root.
        let (fours, rest) = offsets.as_chunks::<4>();
        let (pairs, last) = fours.as_chunks::<2>();
        for [a, b] in pairs {
            let (a, b) = (direction(a), direction(b));
            rays.extend_from_slice(&rays_x4(eye, a, Vec4::INFINITY));
            rays.extend_from_slice(&rays_x4(eye, b, Vec4::INFINITY));
        }
        for offsets in last {
            rays.extend_from_slice(&rays_x4(eye, direction(offsets), Vec4::INFINITY));
        }
        rays.extend(rest.iter().map(|&offset| self.generate_ray(pixel, offset, || Vec2::ZERO)));
    }
}

fn check(settings: &CameraSettings, resolution: UVec2) -> Result<(), CameraError> {
    let CameraSettings { eye, look_at, up, fov, lens_radius, focal_distance } = *settings;
    let within = |v: Vec3| v.abs().max_element() <= LARGEST_COORDINATE;
    let in_range = [
        ("eye", within(eye)),
        ("look_at", within(look_at)),
        ("up", up.is_finite()),
        ("fov", fov.is_finite()),
        ("lens_radius", lens_radius <= LARGEST_COORDINATE),
        ("focal_distance", focal_distance.is_finite()),
    ];
    if let Some((name, _)) = in_range.iter().find(|(_, in_range)| !in_range) {
        return Err(CameraError::OutOfRange(name));
    }
    if fov <= 0.0 || fov >= 180.0 {
        return Err(CameraError::Fov(fov));
    }
    if lens_radius < 0.0 {
        return Err(CameraError::LensRadius(lens_radius));
    }
    if focal_distance <= 0.0 {
        return Err(CameraError::FocalDistance(focal_distance));
    }
    if resolution.min_element() == 0 {
        return Err(CameraError::Resolution(resolution.x, resolution.y));
    }
    Ok(())
}

/// How a kind of camera is read, for images of this resolution.
pub type ReadCamera = fn(&Table, UVec2) -> Result<CameraSettings, Fault>;

/// All kinds of cameras; the first one is the default.
pub static CAMERAS: &[Kind<ReadCamera>] = &[KIND];

const DEFAULT: CameraSettings = CameraSettings::DEFAULT;
const EYE: Key<Vec3> = Key::new("eye", "where it stands").default(DEFAULT.eye);
const LOOK_AT: Key<Vec3> =
    Key::new("look_at", "a point in the middle of the image").default(DEFAULT.look_at);
const UP: Key<Vec3> = Key::new("up", "a direction that is up in the image").default(DEFAULT.up);
const FOV: Key<f32> = Key::new("fov", "field of view across the shorter side of the image")
    .in_unit("degrees")
    .above(0.0)
    .below(180.0)
    .default(DEFAULT.fov);
const LENS_RADIUS: Key<f32> =
    Key::new("lens_radius", "radius of the lens, in scene units; 0 for a pinhole")
        .at_least(0.0)
        .default(DEFAULT.lens_radius);
const FOCAL_DISTANCE: Key<f32> =
    Key::new("focal_distance", "distance of the plane in focus, in scene units")
        .above(0.0)
        .default(DEFAULT.focal_distance);

const KEYS: &[&dyn AnyKey] = &[&EYE, &LOOK_AT, &UP, &FOV, &LENS_RADIUS, &FOCAL_DISTANCE];

/// `type = "perspective"`
const KIND: Kind<ReadCamera> = Kind {
    name: "perspective",
    meaning: "Perspective, with a thin lens if it has one",
    keys: KEYS,
    read,
};

fn read(table: &Table, resolution: UVec2) -> Result<CameraSettings, Fault> {
    let settings = CameraSettings {
        eye: table.get(&EYE)?,
        look_at: table.get(&LOOK_AT)?,
        up: table.get(&UP)?,
        fov: table.get(&FOV)?,
        lens_radius: table.get(&LENS_RADIUS)?,
        focal_distance: table.get(&FOCAL_DISTANCE)?,
    };
    let Err(error) = Camera::new(&settings, resolution) else { return Ok(settings) };
    let name = match error {
        CameraError::OutOfRange(name) => name,
        CameraError::NoUp => UP.name(),
        _ => LOOK_AT.name(),
    };
    let key = KEYS.iter().find(|key| key.name() == name).unwrap_or(&KEYS[1]);
    Err(Fault::new(table.mark(*key), error))
}
