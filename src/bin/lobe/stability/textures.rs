//! Images on surfaces, with one sample for each pixel.

use lobe::Spectrum;
use lobe::camera::{Camera, PerspectiveCamera, PerspectiveSettings};
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::image::{Encoding, Image};
use lobe::texture::{Curve, ImageTexture, Minification, Texels};

use super::rng::Rng;
use super::sweep::{Method, Sweep};

/// Columns and rows of the image, which is one unit wide and repeated.
const SIDE: u32 = 256;
/// Pixels of the picture at each parameter.
const PIXELS: u32 = 48;
/// Rays along each side of a pixel, whose mean is the truth.
const RAYS: u32 = 64;

/// An image of greys without an order.
fn noise() -> ImageTexture {
    let mut rng = Rng::new(1);
    let pixels = (0..SIDE * SIDE).map(|_| Spectrum::splat(rng.unit() as f32)).collect();
    let (size, encoding) = (UVec2::splat(SIDE), Encoding::Linear);
    let image = Image { size, pixels, variance: None, degrees_of_freedom: None, encoding };
    let texels = Texels::new(&image, Curve::Linear).expect("a small image of greys");
    ImageTexture::new(texels).with_minification(Minification::Anisotropic)
}

/// Root mean square errors of one sample in the middle of each pixel of a picture of the plane z = 0: of the image's own pixel, of the usual
/// mipmap and of ours, each in units of the image's standard deviation.
fn errors(image: &ImageTexture, distance: f64, degrees: f64, effort: f64) -> [f64; 3] {
    let angle = degrees.to_radians();
    let eye = Vec3::new(0.0, -(angle.cos() * distance) as f32, (angle.sin() * distance) as f32);
    let settings = PerspectiveSettings {
        eye,
        look_at: Vec3::ZERO,
        up: Vec3::Z,
        fov: 5.0,
        ..Default::default()
    };
    let Ok(camera) = PerspectiveCamera::new(&settings, UVec2::splat(256)) else {
        return [f64::NAN; 3];
    };
    let Some(cone) = camera.pixel_cone() else { return [f64::NAN; 3] };
    let mut rng = Rng::new(2);
    let mut sums = [0.0; 3];
    let count = ((f64::from(PIXELS) * effort) as u32).max(8);
    for _ in 0..count {
        let pixel = UVec2::new((rng.unit() * 256.0) as u32, (rng.unit() * 256.0) as u32);
        let seen = |offset: Vec2| {
            let ray = camera.generate_ray(pixel, offset, Vec2::ZERO);
            ray.o - ray.d * (ray.o.z / ray.d.z)
        };
        let mut mean = 0.0;
        for i in 0..RAYS * RAYS {
            let offset = Vec2::new((i % RAYS) as f32 + 0.5, (i / RAYS) as f32 + 0.5) / RAYS as f32;
            mean += grey(image.at(seen(offset).truncate())) / f64::from(RAYS * RAYS);
        }
        let p = seen(Vec2::splat(0.5));
        let st = p.truncate();
        let steps = cone.footprint(p, Vec3::Z).map(Vec3::truncate);
        let longest = steps[0].length().max(steps[1].length());
        let found = [
            image.at(st),
            image.mean(st, [Vec2::X * longest, Vec2::Y * longest]),
            image.mean(st, steps),
        ];
        for (sum, found) in sums.iter_mut().zip(found) {
            *sum += (grey(found) - mean).powi(2);
        }
    }
    // Of a uniform distribution.
    let deviation = (1.0_f64 / 12.0).sqrt();
    sums.map(|sum| (sum / f64::from(count)).sqrt() / deviation)
}

fn grey(color: Spectrum) -> f64 {
    f64::from(color.to_array()[0])
}

fn sweep(parameters: &[f64], measure: impl Fn(f64) -> [f64; 3]) -> Vec<Method> {
    let mut methods: Vec<Method> = [
        ("one pixel of the image", false),
        ("mipmap by the longer side", false),
        ("ImageTexture (ours)", true),
    ]
    .map(|(name, is_ours)| Method { name, is_ours, values: Vec::new() })
    .into();
    for &parameter in parameters {
        for (method, value) in methods.iter_mut().zip(measure(parameter)) {
            method.values.push(value);
        }
    }
    methods
}

const ABOUT: &str = "A plane with an image of 256 x 256 greys without an order, one unit wide and repeated; a picture of 256 x 256 pixels, 5 degrees \
                     wide. The truth is the mean over 64 x 64 rays of a pixel. Errors are root mean squares over 48 pixels, in units of the standard \
                     deviation of the image. Common methods: the image where the ray meets it, whatever the size of the pixel; and trilinear lookups in \
                     a mipmap by the longer side of the pixel's footprint (Williams 1983), which blur at grazing angles. Ours takes lookups by the \
                     shorter side along the longer one, at most 16.";

/// By the angle to the surface.
pub fn grazing(effort: f64) -> Sweep {
    let parameters = vec![1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0];
    let image = noise();
    Sweep {
        name: "textures-grazing",
        title: "Error of an image on a surface, by the angle to it",
        about: format!(
            "{ABOUT} From a distance of 24 units, so that a pixel is 2 pixels of the image wide."
        ),
        parameter: "angle to the surface (degrees)",
        log_parameter: true,
        measure: "error of a pixel",
        methods: sweep(&parameters, |degrees| errors(&image, 24.0, degrees, effort)),
        fails_from: 0.25,
        bounds: vec![0.1, 0.1, 0.1, 0.1, 0.1, 0.11, 0.14, 0.16, 0.18, 0.2, 0.25, 0.25, 0.3],
        parameters,
    }
}

/// By the distance.
pub fn distance(effort: f64) -> Sweep {
    let parameters =
        vec![3.0, 6.0, 12.0, 18.0, 24.0, 36.0, 48.0, 96.0, 192.0, 400.0, 1000.0, 3000.0, 10000.0];
    let image = noise();
    Sweep {
        name: "textures-distance",
        title: "Aliasing of an image on a surface, by the distance",
        about: format!(
            "{ABOUT} At an angle of 20 degrees; at a distance of 12 units a pixel is as wide as one of the image."
        ),
        parameter: "distance (widths of the image)",
        log_parameter: true,
        measure: "error of a pixel",
        methods: sweep(&parameters, |distance| errors(&image, distance, 20.0, effort)),
        fails_from: 0.25,
        bounds: vec![0.15, 0.1, 0.15, 0.16, 0.18, 0.17, 0.13, 0.07, 0.05, 0.03, 0.02, 0.02, 0.02],
        parameters,
    }
}
