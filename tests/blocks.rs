//! Hits are shaded in blocks, several at a time. They give the same bits as hits that are shaded one by one, for every kind of
//! surface and light, and on every instruction set.

mod scenes;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use lobe::accel::InstructionSet;
use lobe::bxdf::{
    Arena, Bsdf, BsdfBlock, BxDF, BxdfFlags, BxdfSample, EnergyPreservingOrenNayar,
    LambertianReflection, OrenNayar, ScaledBxDF,
};
use lobe::camera::Camera;
use lobe::geometry::{Frame, Ray};
use lobe::glam::{UVec2, Vec2, Vec3};
use lobe::image::{Encoding, Image};
use lobe::integrator::{DirectIntegrator, Integrator, PathIntegrator};
use lobe::interaction::{HitBlock, SurfaceInteraction, SurfacePlace};
use lobe::light::{
    DistantLight, Emitted, EscapedRays, Light, LightHit, LightSample, LightSamples, LightStrategy,
    Receivers, SkyLight,
};
use lobe::material::{DetailedMaterial, Material, MetalMaterial, PlasticMaterial, Roughness, bump};
use lobe::scene::{Emission, SceneBuilder};
use lobe::texture::{Channel, Curve, ImageTexture, Mapping, Projection, Texels, Texture};
use lobe::{
    FilmSettings, MatteMaterial, PointLight, RenderOptions, Scene, Spectrum, TriangleMesh, View,
    render,
};
use scenes::{any, ball_over_floor, chapter_view, independent};

/// A surface as a function of the place: reflectance, sigma, and displacement if it is bumpy.
#[derive(Clone, Copy)]
struct Surface {
    kd: fn(&SurfaceInteraction) -> Spectrum,
    sigma: fn(&SurfaceInteraction) -> f32,
    bump: Option<fn(&SurfaceInteraction) -> f32>,
}

/// The surface as a material that answers for blocks.
fn matte(Surface { kd, sigma, bump }: Surface) -> Arc<dyn Material> {
    let matte = MatteMaterial::new(kd).with_sigma(sigma);
    match bump {
        Some(bump) => Arc::new(DetailedMaterial::new(matte).with_bump(bump)),
        None => Arc::new(matte),
    }
}

/// A material that answers for single hits, with lobes that can be evaluated several at a time.
struct Disguised(Arc<dyn Material>);

impl Material for Disguised {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        self.0.compute_scattering(si, arena)
    }
}

/// The same with lobes behind pointers, so that they are evaluated one by one.
struct Apart(Surface);

impl Material for Apart {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let Surface { kd, sigma, bump: displacement } = &self.0;
        if let Some(displacement) = displacement {
            bump(&displacement, si);
        }
        let mut bsdf = Bsdf::isotropic(si);
        let kd = kd.evaluate(si);
        let r = if kd.is_finite() { kd.clamp(0.0, 1.0) } else { kd };
        match sigma.evaluate(si) {
            _ if r.is_black() => false,
            0.0 => bsdf.add(arena.lobe(LambertianReflection::new(r))),
            sigma => bsdf.add(arena.lobe(OrenNayar::new(r, sigma.clamp(0.0, 90.0)))),
        };
        bsdf
    }
}

/// Whether a place is on one of two kinds of stripes.
fn is_striped(si: &SurfaceInteraction) -> bool {
    (5.0 * si.p().x).floor() % 2.0 == 0.0
}

fn surfaces() -> [Surface; 6] {
    let out_of_range = |si: &SurfaceInteraction| match is_striped(si) {
        true => Spectrum::new(1.4, 0.5, -0.2),
        false => Spectrum::WHITE,
    };
    let red = |_: &SurfaceInteraction| Spectrum::new(0.8, 0.1, 0.2);
    let stripes = |si: &SurfaceInteraction| match is_striped(si) {
        true => Spectrum::new(0.2, 0.9, 0.5),
        false => Spectrum::BLACK,
    };
    [
        Surface { kd: red, sigma: |_| 0.0, bump: None },
        Surface { kd: stripes, sigma: |_| 0.0, bump: None },
        Surface { kd: stripes, sigma: |si| 10.0 + 5.0 * si.p().y, bump: None },
        Surface { kd: out_of_range, sigma: |_| 0.0, bump: None },
        Surface { kd: out_of_range, sigma: |si| 120.0 * si.p().x.abs().min(1.0) + 1.0, bump: None },
        // Lambertian and Oren-Nayar in one block.
        Surface {
            kd: red,
            sigma: |si| if is_striped(si) { 30.0 } else { 0.0 },
            bump: Some(|si| 0.05 * (20.0 * si.p().x).sin()),
        },
    ]
}

/// A mirror that is seen from one side: on the other it gives no direction.
#[derive(Clone, Copy)]
struct Mirror;

impl BxDF for Mirror {
    fn flags(&self) -> BxdfFlags {
        BxdfFlags::REFLECTION | BxdfFlags::SPECULAR
    }
    fn f(&self, _: Vec3, _: Vec3) -> Spectrum {
        Spectrum::BLACK
    }
    fn pdf(&self, _: Vec3, _: Vec3) -> f32 {
        0.0
    }
    fn sample_f(&self, wo: Vec3, _: f32, u: Vec2) -> Option<BxdfSample> {
        let wi = Vec3::new(-wo.x, -wo.y, wo.z);
        let sample = BxdfSample::specular(Spectrum::splat(0.9 / wo.z.abs()), wi, 1.0);
        (wo.z > 0.0 && u.x < 0.8).then_some(sample)
    }
}

impl Material for Mirror {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(self as &dyn BxDF);
        bsdf
    }
}

/// One dimmed lobe: by the scale of its term, or behind a pointer.
struct Dimmed {
    is_apart: bool,
}

impl Material for Dimmed {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let (lobe, scale) = (LambertianReflection::new(Spectrum::splat(0.8)), Spectrum::splat(0.5));
        let mut bsdf = Bsdf::isotropic(si);
        if self.is_apart {
            bsdf.add(arena.lobe(ScaledBxDF::new(lobe, scale)))
        } else {
            bsdf.add_scaled(lobe, scale)
        };
        bsdf
    }
}

/// Matte in a frame whose tangents are turned, with lobes behind pointers or not.
struct Turned {
    is_apart: bool,
}

impl Material for Turned {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let Frame { s, t, n } = Frame::from_normal(si.shading_n());
        let mut bsdf = Bsdf::new(Frame { s: 0.6 * s + 0.8 * t, t: 0.6 * t - 0.8 * s, n }, si.n());
        let lobe = LambertianReflection::new(Spectrum::new(0.8, 0.5, 0.3));
        if self.is_apart {
            bsdf.add(arena.lobe(lobe))
        } else {
            bsdf.add(lobe)
        };
        bsdf
    }
}

/// A black material that compares the hits of blocks with single ones.
struct Checks {
    meshes: Vec<TriangleMesh>,
    seen: Arc<[AtomicU64; 3]>,
}

impl Material for Checks {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        bsdf.add(LambertianReflection::new(Spectrum::splat(0.5)));
        bsdf
    }
    fn scatter_block<'a>(
        &'a self,
        hits: &mut HitBlock,
        arena: &'a Arena,
        bsdfs: &mut BsdfBlock<'a>,
    ) {
        for i in 0..hits.len() {
            let si = hits.get(i);
            let SurfacePlace { shape, triangle, b, .. } = si.place().unwrap();
            let mesh = &self.meshes[shape as usize];
            let one = SurfaceInteraction::on_triangle(mesh, triangle as usize, b, si.wo());
            let all =
                |si: &SurfaceInteraction| (si.p(), si.p_error(), si.n(), si.shading_n(), si.uv());
            assert_eq!(all(&si), all(&one), "hit {i} on triangle {triangle} of shape {shape}");
            self.seen[shape as usize].fetch_add(1, Ordering::Relaxed);
        }
        bsdfs.fill(hits, |_, si| self.compute_scattering(si, arena));
    }
}

/// A material of another crate that forwards blocks.
struct Forwards(MatteMaterial);

impl Material for Forwards {
    fn compute_scattering<'a>(&'a self, _: &mut SurfaceInteraction, _: &'a Arena) -> Bsdf<'a> {
        unreachable!("blocks are forwarded")
    }
    fn scatter_block<'a>(
        &'a self,
        hits: &mut HitBlock,
        arena: &'a Arena,
        bsdfs: &mut BsdfBlock<'a>,
    ) {
        self.0.scatter_block(hits, arena, bsdfs);
    }
}

/// A texture of another crate that answers for blocks.
struct ForwardsTexture(fn(&SurfaceInteraction) -> Spectrum);

impl Texture<Spectrum> for ForwardsTexture {
    fn evaluate(&self, _: &SurfaceInteraction) -> Spectrum {
        unreachable!("blocks are forwarded")
    }
    fn evaluate_block(&self, hits: &HitBlock, values: &mut [Spectrum]) {
        assert_eq!(values.len(), hits.len());
        for (i, value) in values.iter_mut().enumerate() {
            *value = (self.0)(&hits.get(i));
        }
    }
}

/// A light of another crate that answers for blocks, and sets only what there is.
struct Selective(Arc<dyn Light>);

impl Light for Selective {
    fn is_delta(&self) -> bool {
        self.0.is_delta()
    }
    fn is_infinite(&self) -> bool {
        self.0.is_infinite()
    }
    fn is_worth_sampling(&self) -> bool {
        self.0.is_worth_sampling()
    }
    fn sample_li(&self, _: Vec3, _: Vec2) -> Option<LightSample> {
        unreachable!("it answers for blocks")
    }
    fn sample_li_block(&self, receivers: &Receivers, samples: &mut LightSamples) {
        for i in 0..receivers.len() {
            if let Some(sample) = self.0.sample_li(receivers.p(i), receivers.u(i)) {
                samples.set(i, Some(sample));
            }
        }
    }
    fn escaped_block(&self, rays: &EscapedRays, emitted: &mut Emitted) {
        for i in 0..rays.len() {
            let (hit, needs_pdf) = (rays.get(i), rays.needs_pdf());
            assert!(hit.wi.is_normalized(), "a ray that there is not: {}", hit.wi);
            emitted.set(i, self.0.le(&hit), if needs_pdf { self.0.pdf_li(&hit) } else { f32::NAN });
        }
    }
    fn power(&self, scene: &lobe::light::BoundingSphere) -> Option<Spectrum> {
        self.0.power(scene)
    }
}

/// A light that answers for single points.
struct Foreign(Arc<dyn Light>);

impl Light for Foreign {
    fn is_delta(&self) -> bool {
        self.0.is_delta()
    }
    fn is_infinite(&self) -> bool {
        self.0.is_infinite()
    }
    fn is_worth_sampling(&self) -> bool {
        self.0.is_worth_sampling()
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.0.sample_li(p, u)
    }
    fn pdf_li(&self, hit: &LightHit) -> f32 {
        self.0.pdf_li(hit)
    }
    fn le(&self, hit: &LightHit) -> Spectrum {
        self.0.le(hit)
    }
    fn power(&self, scene: &lobe::light::BoundingSphere) -> Option<Spectrum> {
        self.0.power(scene)
    }
}

/// A light that shines on stripes.
struct Striped(Arc<dyn Light>);

impl Light for Striped {
    fn is_delta(&self) -> bool {
        self.0.is_delta()
    }
    fn sample_li(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.0.sample_li(p, u).filter(|_| (7.0 * p.z).floor() % 2.0 == 0.0)
    }
    fn power(&self, scene: &lobe::light::BoundingSphere) -> Option<Spectrum> {
        self.0.power(scene)
    }
}

fn one_light() -> Vec<Arc<dyn Light>> {
    vec![Arc::new(PointLight::new(Vec3::new(10.0, 10.0, -10.0), Spectrum::splat(900.0)))]
}

fn many_lights() -> Vec<Arc<dyn Light>> {
    let sun = DistantLight::new(Vec3::new(-0.6, 0.8, 0.0), Spectrum::splat(0.5)).unwrap();
    let mut lights = one_light();
    lights
        .push(Arc::new(PointLight::new(Vec3::new(-5.0, 3.0, 1.0), Spectrum::new(0.0, 20.0, 40.0))));
    lights.push(Arc::new(SkyLight::new(Spectrum::new(0.1, 0.2, 0.3))));
    lights.push(Arc::new(sun));
    lights
}

/// A ball over a floor, flat or with normals, in one of these materials or two; and a lamp if there are many lights.
fn scene(
    materials: [Arc<dyn Material>; 2],
    is_smooth: bool,
    lights: Vec<Arc<dyn Light>>,
) -> SceneBuilder {
    let [ball, floor] = materials;
    let mut scene = ball_over_floor().material("red", ball).material("blue", floor);
    if is_smooth {
        let mut mesh = scenes::lumpy_ball(16);
        mesh.positions.iter_mut().for_each(|p| *p = *p * 0.5 + Vec3::new(1.5, -0.5, 0.5));
        // Tilted so far that sampled directions lie below the triangles.
        let wave = |p: Vec3| Vec3::new((40.0 * p.x).sin(), (50.0 * p.y).sin(), (60.0 * p.z).sin());
        let center = Vec3::new(1.5, -0.5, 0.5);
        let tilted = |p: &Vec3| ((*p - center).normalize() + 0.7 * wave(*p)).normalize();
        mesh.normals = mesh.positions.iter().map(tilted).collect();
        // Some corners without a normal.
        mesh.normals.iter_mut().step_by(17).for_each(|n| *n = Vec3::ZERO);
        scene = scene.shape("smooth", mesh, "red");
    }
    if lights.len() > 1 {
        let corner = Vec3::new(1.2, 1.5, -1.0);
        let lamp = TriangleMesh::parallelogram(corner, Vec3::X * 2.0, Vec3::Z * 1.5);
        let emission = Emission { radiance: Spectrum::new(4.0, 4.0, 2.0), two_sided: true };
        scene = scene.glowing_shape("lamp", lamp, "red", emission);
    }
    lights.into_iter().fold(scene, |scene, light| scene.light(light))
}

fn colors(scene: SceneBuilder, integrator: &Arc<dyn Integrator>) -> Vec<Spectrum> {
    let (scene, view) = (scene.build().unwrap(), chapter_view(UVec2::new(45, 31)));
    let settings = independent(16, integrator.clone());
    render(&scene, &view, &settings, &RenderOptions::default()).unwrap().picture.color
}

fn integrators() -> Vec<Arc<dyn Integrator>> {
    let path = |max_depth, strategy| any(PathIntegrator { max_depth, roulette: true, strategy });
    let [auto, mis] = [LightStrategy::Auto, LightStrategy::Mis];
    let [light, bsdf] = [LightStrategy::Light, LightStrategy::Bsdf];
    let direct = |strategy| any(DirectIntegrator { strategy });
    vec![
        direct(auto),
        direct(mis),
        path(1, auto),
        path(7, auto),
        path(7, mis),
        path(7, light),
        path(7, bsdf),
    ]
}

/// Seen to fail with the terms of the lanes' dot product added in another order, with a black lobe left out of its block, and
/// with the sigma of the hit before.
#[test]
fn shading_in_blocks_changes_no_bit() {
    let [plain, ..] = surfaces();
    for (i, surface) in surfaces().into_iter().enumerate() {
        for integrator in integrators() {
            for lights in [one_light, many_lights] {
                for is_smooth in [false, true] {
                    let what = format!("surface {i}, {integrator:?}, smooth: {is_smooth}");
                    let of = |ball: Arc<dyn Material>, floor: Arc<dyn Material>| {
                        colors(scene([ball, floor], is_smooth, lights()), &integrator)
                    };
                    let in_blocks = of(matte(surface), matte(plain));
                    assert!(in_blocks.iter().any(|color| !color.is_black()), "{what}");
                    let disguised =
                        of(Arc::new(Disguised(matte(surface))), Arc::new(Disguised(matte(plain))));
                    assert!(in_blocks == disguised, "{what}: foreign materials");
                    let apart = of(Arc::new(Apart(surface)), Arc::new(Apart(plain)));
                    assert!(in_blocks == apart, "{what}: lobes one by one");
                }
            }
        }
    }
}

/// Materials of constants, in range and out of it. Seen to fail with a reflectance that is not clamped.
#[test]
fn constants_change_no_bit() {
    for kd in [Spectrum::new(0.8, 0.1, 0.2), Spectrum::new(1.4, 0.5, -0.2), Spectrum::BLACK] {
        for sigma in [0.0, 30.0, 200.0] {
            let constant = || MatteMaterial::new(kd).with_sigma(sigma);
            for integrator in integrators() {
                let of = |material: Arc<dyn Material>| {
                    colors(scene([material.clone(), material], true, many_lights()), &integrator)
                };
                let disguised = of(Arc::new(Disguised(Arc::new(constant()))));
                assert!(of(Arc::new(constant())) == disguised, "{kd:?}, {sigma}, {integrator:?}");
            }
        }
    }
}

/// Energy-preserving roughness with lobes behind pointers.
struct ApartEon(Surface);

impl Material for ApartEon {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let mut bsdf = Bsdf::isotropic(si);
        let r = self.0.kd.evaluate(si).clamp(0.0, 1.0);
        let roughness = self.0.sigma.evaluate(si).clamp(0.0, 1.0);
        if !r.is_black() {
            bsdf.add(arena.lobe(EnergyPreservingOrenNayar::new(r, roughness)));
        }
        bsdf
    }
}

/// Seen to fail with the roughness of the hit before, and with one that is not clamped.
#[test]
fn energy_preserving_roughness_changes_no_bit() {
    let [plain, stripes, .., out_of_range, _, _] = surfaces();
    let constant = plain.kd;
    for (kd, sigma) in [
        (stripes.kd, (|si| si.p().x.abs().fract()) as fn(&SurfaceInteraction) -> f32),
        (out_of_range.kd, |si| 3.0 * si.p().y.sin()),
        (constant, |_| 0.7),
    ] {
        let surface = Surface { kd, sigma, bump: None };
        for integrator in integrators() {
            let of = |material: Arc<dyn Material>| {
                colors(scene([material.clone(), material], true, many_lights()), &integrator)
            };
            let eon = || MatteMaterial::new(kd).with_roughness(sigma);
            let apart = of(Arc::new(ApartEon(surface)));
            assert!(apart == of(Arc::new(eon())), "{integrator:?}");
            assert!(apart == of(Arc::new(Disguised(Arc::new(eon())))), "{integrator:?}");
        }
    }
    let red = Spectrum::new(0.8, 0.1, 0.2);
    let surface = Surface { kd: constant, sigma: |_| 0.7, bump: None };
    for integrator in integrators() {
        let of = |material: Arc<dyn Material>| {
            colors(scene([material.clone(), material], true, many_lights()), &integrator)
        };
        let constants = MatteMaterial::new(red).with_roughness(0.7);
        assert!(of(Arc::new(constants)) == of(Arc::new(ApartEon(surface))), "{integrator:?}");
    }
}

/// A material with its lobes behind pointers, so that they are evaluated one by one.
struct Behind(Arc<dyn Material>);

impl Material for Behind {
    fn compute_scattering<'a>(&'a self, si: &mut SurfaceInteraction, arena: &'a Arena) -> Bsdf<'a> {
        let own = self.0.compute_scattering(si, arena);
        let mut bsdf = Bsdf::new(*own.frame(), si.n());
        for (lobe, scale) in own.lobes() {
            bsdf.add_scaled(arena.lobe(*lobe), scale);
        }
        bsdf
    }
}

/// Coats with a base, with none and with one here and there; metals; roughnesses that are constant, that change, that differ by axis, and
/// that are 0 here and there.
fn glossy() -> Vec<Arc<dyn Material>> {
    let stripes = |si: &SurfaceInteraction| match is_striped(si) {
        true => Spectrum::new(0.2, 0.9, 0.5),
        false => Spectrum::BLACK,
    };
    let waves = |si: &SurfaceInteraction| (3.0 * si.p().y).sin().abs();
    let in_part = |si: &SurfaceInteraction| if is_striped(si) { 0.3 } else { 0.0 };
    let gold = || MetalMaterial::named("gold").unwrap();
    let red = Spectrum::new(0.8, 0.1, 0.2);
    vec![
        Arc::new(PlasticMaterial::new(red, 1.5).with_roughness(Roughness::alpha(0.2))),
        Arc::new(PlasticMaterial::new(stripes, 1.3).with_roughness(Roughness::perceptual(0.7))),
        Arc::new(PlasticMaterial::new(stripes, 1.5).with_roughness(Roughness::alpha(waves))),
        Arc::new(PlasticMaterial::new(red, 1.5).with_roughness(Roughness::alpha(in_part))),
        Arc::new(PlasticMaterial::new(red, 1.5)),
        Arc::new(PlasticMaterial::new([0.0; 3], 1.5).with_roughness(Roughness::alpha(0.2))),
        Arc::new(gold().with_roughness(Roughness::alpha(0.3))),
        Arc::new(gold().with_roughness(Roughness::alpha(waves))),
        Arc::new(gold().with_roughness(Roughness::alpha(in_part))),
        Arc::new(gold().with_roughness(Roughness::alpha(0.3).across(0.1))),
        // Other Fresnel equations from stripe to stripe.
        Arc::new(MetalMaterial::reflecting(stripes).with_roughness(Roughness::alpha(0.3))),
        Arc::new(MetalMaterial::reflecting(Spectrum::WHITE).with_roughness(Roughness::alpha(1.0))),
    ]
}

/// On every instruction set.
#[test]
fn glossy_surfaces_change_no_bit() {
    let sets = InstructionSet::available();
    for (i, material) in glossy().into_iter().enumerate() {
        for (j, integrator) in integrators().into_iter().enumerate() {
            let of = |material: Arc<dyn Material>, set| {
                let scene = scene([material.clone(), material], true, many_lights());
                colors(scene.instruction_set(set), &integrator)
            };
            let apart = of(Arc::new(Behind(material.clone())), InstructionSet::fastest());
            assert!(apart.iter().any(|color| !color.is_black()), "{i}, {integrator:?}");
            // Each set with some of the integrators.
            let set = sets[(i + j) % sets.len()];
            assert!(of(material.clone(), set) == apart, "{i}, {set}, {integrator:?}");
            assert!(of(Arc::new(Disguised(material.clone())), set) == apart, "{i}, {integrator:?}");
        }
    }
}

/// Images are looked up in blocks as one by one, by texture coordinates and by a projection. Seen to fail with values of a block left out.
#[test]
fn images_change_no_bit() {
    let pixels = (0..35).map(|i| Spectrum::new(0.01 * i as f32, 0.5, 1.0 / (1 + i) as f32));
    let (size, pixels) = (UVec2::new(5, 7), pixels.collect());
    let encoding = Encoding::Linear;
    let image = Image { size, pixels, variance: None, degrees_of_freedom: None, encoding };
    let texels = Arc::new(Texels::new(&image, Curve::Linear).unwrap());
    for projection in [Projection::Uv, Projection::Planar] {
        let mapping = Mapping::new(projection).scaled(Vec2::new(1.7, -2.3));
        let image = ImageTexture::new(texels.clone()).with_mapping(mapping);
        let one = image.clone();
        let single = move |si: &SurfaceInteraction| one.evaluate(si);
        for integrator in integrators() {
            let of = |material: Arc<dyn Material>| {
                colors(scene([material.clone(), material], true, many_lights()), &integrator)
            };
            let in_blocks = of(Arc::new(MatteMaterial::new(image.clone())));
            assert!(
                in_blocks == of(Arc::new(MatteMaterial::new(single.clone()))),
                "{integrator:?}"
            );
            // One of its bands as a roughness.
            let numbers = image.clone().channel(Channel::Blue);
            let one = numbers.clone();
            let single = move |si: &SurfaceInteraction| one.evaluate(si);
            let coat = |roughness| PlasticMaterial::new([0.5; 3], 1.5).with_roughness(roughness);
            let in_blocks = of(Arc::new(coat(Roughness::alpha(numbers))));
            assert!(in_blocks == of(Arc::new(coat(Roughness::alpha(single)))), "{integrator:?}");
        }
    }
}

/// Lobes that are not finite are counted as often in blocks as one by one. Seen to fail with those left out that directions are
/// drawn from, and those that lights are seen in.
#[test]
fn blocks_count_what_is_not_finite() {
    let kd = |si: &SurfaceInteraction| Spectrum::splat(if is_striped(si) { f32::NAN } else { 0.5 });
    let surface = Surface { kd, sigma: |_| 0.0, bump: None };
    for integrator in integrators() {
        let rejected = |material: Arc<dyn Material>| {
            let scene = scene([material.clone(), material], true, many_lights()).build().unwrap();
            let view = chapter_view(UVec2::new(45, 31));
            let settings = independent(4, integrator.clone());
            render(&scene, &view, &settings, &RenderOptions::default()).unwrap().counters.rejected
        };
        let in_blocks = rejected(matte(surface));
        assert!(in_blocks > 0, "{integrator:?}");
        assert_eq!(in_blocks, rejected(Arc::new(Apart(surface))), "{integrator:?}");
    }
}

/// Blocks of a mirror alternate with blocks of matte hits: nothing of one is left in the next. Seen to fail with events that stay
/// specular, and with samples of the block before where a mirror has none.
#[test]
fn blocks_leave_nothing_behind() {
    let [plain, ..] = surfaces();
    for integrator in integrators() {
        for lights in [one_light, many_lights] {
            let of = |floor| colors(scene([Arc::new(Mirror), floor], true, lights()), &integrator);
            let in_blocks = of(matte(plain));
            assert!(in_blocks.iter().any(|color| !color.is_black()));
            assert!(in_blocks == of(Arc::new(Apart(plain))), "{integrator:?}");
        }
    }
}

/// Anisotropic frames are kept. Seen to fail with lobes taken for those of an isotropic frame.
#[test]
fn frames_of_ones_own_change_no_bit() {
    for integrator in integrators() {
        let of = |is_apart| {
            let material: Arc<dyn Material> = Arc::new(Turned { is_apart });
            colors(scene([material.clone(), material], true, many_lights()), &integrator)
        };
        assert!(of(false) == of(true), "{integrator:?}");
    }
}

/// The scale of a term is kept. Seen to fail with dimmed lobes taken for whole ones.
#[test]
fn scales_of_terms_change_no_bit() {
    for integrator in integrators() {
        let of = |is_apart| {
            let material: Arc<dyn Material> = Arc::new(Dimmed { is_apart });
            colors(scene([material.clone(), material], true, many_lights()), &integrator)
        };
        assert!(of(false) == of(true), "{integrator:?}");
    }
}

/// Blocks hold the geometry that single hits have: of flat and smooth meshes, of triangles whose normals need f64, and of those
/// with the last vertex. Seen to fail with the geometric normal for the shading normal, with f32 for all normals, with the last
/// vertex taken for zero, and with corners of the shape before.
#[test]
fn blocks_hold_the_geometry_of_single_hits() {
    let ball = scenes::lumpy_ball(12);
    let mut smooth = ball.clone();
    smooth.positions.iter_mut().for_each(|p| *p += Vec3::X * 2.5);
    smooth.normals = ball.positions.iter().map(|p| p.normalize()).collect();
    smooth.normals.iter_mut().step_by(7).for_each(|n| *n = Vec3::ZERO);
    // Needles: the cross product of two edges cancels in f32.
    let mut needles = TriangleMesh::default();
    for i in 0..60_u32 {
        let a = Vec3::new(-4.0, -1.5 + 0.05 * i as f32, 1.0);
        let edges = [Vec3::new(8.013, 0.0437, 0.517), Vec3::new(4.127, 0.0391, 0.263)];
        needles.positions.extend([a, a + edges[0], a + edges[1]]);
        // Every other one is flat.
        let normals = [Vec3::new(0.1, 0.2, -0.9), Vec3::NEG_Z, Vec3::X];
        needles.normals.extend(normals.map(|n| n.normalize() * (i % 2) as f32));
        needles.indices.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    let meshes = vec![ball, smooth, needles];
    let seen = Arc::new([const { AtomicU64::new(0) }; 3]);
    let checks = Checks { meshes: meshes.clone(), seen: Arc::clone(&seen) };
    let mut builder =
        Scene::builder().material("checks", checks).light(SkyLight::new(Spectrum::WHITE));
    for (i, mesh) in meshes.into_iter().enumerate() {
        builder = builder.shape(format!("shape {i}"), mesh, "checks");
    }
    let view = chapter_view(UVec2::new(64, 48));
    let settings = independent(16, any(PathIntegrator::new(3)));
    render(&builder.build().unwrap(), &view, &settings, &RenderOptions::default()).unwrap();
    for (shape, seen) in seen.iter().enumerate() {
        assert!(seen.load(Ordering::Relaxed) > 300, "hits on shape {shape}");
    }
}

/// Kinds that answer for blocks themselves, through the public doors alone: a material and a texture that forward, and lights
/// that set only what there is. Seen to fail with samples of an earlier block taken for those that are not set, and with values
/// of lobes taken where there is no sample.
#[test]
fn doors_for_blocks_change_no_bit() {
    let [_, stripes, ..] = surfaces();
    for integrator in integrators() {
        for lights in [one_light, many_lights] {
            let of = |material: Arc<dyn Material>, lights| {
                colors(scene([material.clone(), material], true, lights), &integrator)
            };
            let lights = || {
                lights().into_iter().map(|light| -> Arc<dyn Light> {
                    if light.is_delta() { Arc::new(Striped(light)) } else { light }
                })
            };
            let expected = of(matte(stripes), lights().collect());
            let selective =
                || lights().map(|light| -> Arc<dyn Light> { Arc::new(Selective(light)) });
            let forwards = Forwards(MatteMaterial::new(ForwardsTexture(stripes.kd)));
            for material in [Arc::new(forwards) as Arc<dyn Material>, Arc::new(Apart(stripes))] {
                assert!(expected == of(material, selective().collect()), "{integrator:?}");
            }
        }
    }
}

/// Seen to fail with the first light's samples for all that a block draws.
#[test]
fn lights_that_answer_one_by_one_change_no_bit() {
    let [plain, ..] = surfaces();
    for integrator in integrators() {
        for lights in [one_light, many_lights] {
            let of = |lights| {
                let material = matte(plain);
                colors(scene([material.clone(), material], true, lights), &integrator)
            };
            let foreign = lights().into_iter().map(|light| Arc::new(Foreign(light)) as _).collect();
            assert!(of(lights()) == of(foreign), "{integrator:?}");
        }
    }
}

/// Seen to fail with fused multiply-adds on one of them.
#[test]
fn instruction_sets_change_no_bit() {
    for surface in surfaces() {
        for integrator in integrators() {
            let of = |set| {
                let material = matte(surface);
                let scene = scene([material.clone(), material], true, many_lights());
                colors(scene.instruction_set(set), &integrator)
            };
            let portable = of(InstructionSet::PORTABLE);
            for set in InstructionSet::available() {
                assert!(of(set) == portable, "{set}, {integrator:?}");
            }
        }
    }
}

/// A camera with one ray for each pixel of a row.
struct Row(Vec<Ray>);

impl Camera for Row {
    fn resolution(&self) -> UVec2 {
        UVec2::new(self.0.len() as u32, 1)
    }
    fn has_lens(&self) -> bool {
        false
    }
    fn generate_ray(&self, pixel: UVec2, _offset: Vec2, _lens: Vec2) -> Ray {
        self.0[pixel.x as usize]
    }
}

/// Rays in the plane of a triangle, but for rounding: some hit it, and have a cosine of exactly 0. A surface is black from
/// there, as `Bsdf` says. Seen to fail with these taken to see the lower side.
#[test]
fn a_surface_is_black_along_itself() {
    let corners = [[0.3, -0.2, 0.1], [1.1, 0.4, -0.3], [0.2, 0.9, 0.7]].map(Vec3::from);
    let mesh = TriangleMesh {
        positions: corners.to_vec(),
        indices: vec![[0, 1, 2]],
        ..TriangleMesh::default()
    };
    let scene = |builder: SceneBuilder| {
        let sky = SkyLight::new(Spectrum::WHITE);
        builder.shape("one", mesh.clone(), "white").light(sky).build().unwrap()
    };
    let white = || MatteMaterial::new([1.0; 3]);
    let flat = scene(Scene::builder().material("white", white()));
    let [plain, ..] = surfaces();
    let apart = scene(Scene::builder().material("white", Apart(plain)));
    let n = mesh.geometric_normal(0);
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let along = |i: u32| {
        let angle = i as f32 * 1e-3;
        let u = (corners[1] - corners[0]).normalize();
        let d = angle.cos() * u + angle.sin() * n.cross(u);
        Ray::new(middle - d * 20.0, d)
    };
    let is_along = |ray: &Ray| ray.d.dot(n) == 0.0 && flat.accel().intersect1(ray).is_hit();
    let rays: Vec<Ray> = (0..6283).map(along).filter(is_along).collect();
    assert!(rays.len() >= 8, "only {} rays", rays.len());
    let film = FilmSettings::new(rays.len() as u32, 1);
    let view = View::new(Row(rays), film).unwrap();
    for strategy in [LightStrategy::Light, LightStrategy::Bsdf, LightStrategy::Mis] {
        let settings = independent(64, DirectIntegrator { strategy });
        for scene in [&flat, &apart] {
            let rendered = render(scene, &view, &settings, &RenderOptions::default()).unwrap();
            assert!(rendered.picture.color.iter().all(|color| color.is_black()), "{strategy:?}");
        }
    }
}
