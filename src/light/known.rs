//! [`KnownLight`]: lights that are sampled for four points at once, and what comes of it, [`LightSamplesX4`].

use std::any::Any;

use glam::{BVec4A, Vec4};

use super::rectangle::RectangleLight;
use super::{AreaLight, Light, PointLight, SkyLight};
use crate::geometry::four::Vec3x4;
use crate::spectrum::Spectrum;

/// A light of a kind that can be sampled for four points at once: what [`Light::sample_li`] gives for each of four points, to the bit.
#[derive(Clone, Copy)]
pub(crate) enum KnownLight {
    Point(PointLight),
    Sky(SkyLight),
    Rectangle(RectangleLight),
}

/// Four of [`LightSample`](super::LightSample), of which some may be missing: their numbers mean nothing.
pub(crate) struct LightSamplesX4 {
    pub(crate) exists: BVec4A,
    pub(crate) li: [Spectrum; 4],
    pub(crate) wi: Vec3x4,
    pub(crate) pdf: Vec4,
    /// Where it comes from, if `is_near`.
    pub(crate) from: Vec3x4,
    pub(crate) is_near: BVec4A,
}

impl KnownLight {
    /// The light as one of these, if it is of such a kind.
    pub(crate) fn new(light: &(impl Light + 'static)) -> Option<Self> {
        let light: &dyn Any = light;
        let point = light.downcast_ref().copied().map(Self::Point);
        let sky = || light.downcast_ref().copied().map(Self::Sky);
        let area =
            || light.downcast_ref().and_then(AreaLight::as_rectangle_light).map(Self::Rectangle);
        point.or_else(sky).or_else(area)
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use super::*;
    use crate::geometry::four::four;
    use crate::shape::TriangleMesh;

    /// Numbers in `[0, 1)`, of 24 bits.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1_u64;
        move || {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
            (state >> 40) as f32 / (1 << 24) as f32
        }
    }

    /// Points around lights of all kinds, on both sides of a lamp, some of them so that f32 is not enough. Seen to fail
    /// with the sides exchanged, and with a density that is not the scalar one's.
    #[test]
    fn four_samples_are_those_of_one_to_the_bit() {
        let lamp = TriangleMesh::parallelogram(Vec3::new(0.3, 1.0, 0.1), Vec3::X, 2.0 * Vec3::Z);
        let l = Spectrum::new(3.0, 2.0, 1.0);
        let [one, two] = [false, true].map(|sides| AreaLight::new(&lamp, l, sides).unwrap());
        let point = PointLight::new(Vec3::new(0.5, 1.0, -0.5), l);
        let sky = SkyLight::new(l);
        let lights: [(&dyn Light, KnownLight); 4] = [
            (&point, KnownLight::new(&point).unwrap()),
            (&sky, KnownLight::new(&sky).unwrap()),
            (&one, KnownLight::new(&one).unwrap()),
            (&two, KnownLight::new(&two).unwrap()),
        ];
        let mut next = numbers();
        let (mut compared, mut missing, mut declined) = (0, 0, 0);
        for trial in 0..20_000 {
            let scale = 10.0_f32.powf(3.0 * next() - 1.5);
            let mut around = || scale * (2.0 * next() - 1.0);
            let p = [(); 4].map(|()| Vec3::new(around(), 1.0 + around(), around()));
            let u = [(); 4].map(|()| Vec2::new(next(), next()));
            for (light, known) in &lights {
                let p4 = Vec3x4::new(four(|i| &p[i]));
                let samples = match known {
                    KnownLight::Point(light) => Some(light.sample_x4(p4)),
                    KnownLight::Sky(light) => Some(light.sample_x4(u)),
                    KnownLight::Rectangle(light) => light.sample_x4(p4, u),
                };
                let Some(samples) = samples else {
                    declined += 1;
                    continue;
                };
                let [wi, from] = [samples.wi, samples.from].map(|v| v.rows(samples.pdf));
                for i in 0..4 {
                    let found = samples.exists.test(i).then(|| {
                        let near = samples.is_near.test(i).then(|| from[i].truncate());
                        (samples.li[i], wi[i].truncate(), wi[i].w, near)
                    });
                    let expected = light.sample_li(p[i], u[i]);
                    let expected = expected.map(|one| (one.li, one.wi, one.pdf, one.from));
                    assert_eq!(found, expected, "trial {trial}, light from {}", p[i]);
                    compared += 1;
                    missing += usize::from(found.is_none());
                }
            }
        }
        assert!(compared > 150_000 && missing > 3_000 && declined > 30_000);
    }
}
