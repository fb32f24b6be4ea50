"""Compares lobe with Mitsuba 3 on the same scenes: agreement of the images, speed, and error at equal time.

    cargo build --release
    python3 -m venv venv && venv/bin/pip install mitsuba==3.9.* numpy OpenEXR
    apt-get install libllvm19                       # for Mitsuba's llvm_ad_rgb
    venv/bin/python docs/compare_mitsuba.py MESH.obj agree speed error [--scale 0.3] [--lift -1.45] [--threads 2] [--out FOLDER]

MESH.obj has to stand on y = 0. It is scaled and lifted to the place of the chapter's dragon; `assets/dragon.obj --scale 1` works.
Prints tables in Markdown. docs/light.md contains and explains them.

Scenes: eye (-3, 1.5, -3), target the origin, 90 degrees, 512 x 512 pixels, box filter, Lambertian dragon and floor
without vertex normals. `point`: (10, 10, -10), 900 W/sr, direct light. `sky`: radiance 1 from everywhere, five
reflections, no roulette. `area`: a rectangle of 3 x 3 units overhead with radiance 12, five reflections, no roulette.
Mitsuba's camera space is right-handed: its images are flipped in x.
"""
import argparse, glob, os, subprocess, statistics, tempfile, time
from statistics import NormalDist

ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("mesh")
ap.add_argument("parts", nargs="+", choices=["agree", "speed", "error"])
for name, default in [("scale", 0.3), ("lift", -1.45), ("threads", 2), ("res", 512), ("runs", 3)]:
    ap.add_argument("--" + name, type=type(default), default=default)
ap.add_argument("--lobe", default="target/release/lobe")
ap.add_argument("--out", default=tempfile.mkdtemp(prefix="lobe-mitsuba-"))
ap.add_argument("--reference-spp", type=int, default=2048)
a = ap.parse_args()
llvm = sorted(glob.glob("/usr/lib/*/libLLVM.so.19*"))
if llvm: os.environ.setdefault("DRJIT_LIBLLVM_PATH", llvm[0])
import numpy as np
import mitsuba as mi

os.makedirs(a.out, exist_ok=True)
path = lambda name: os.path.join(a.out, name)
DRAGON, FLOOR = [.8, .1, .2], [.2, .3, .9]
LAMP = dict(corner=[-1.5, 4.0, -1.5], edges=[[3.0, 0.0, 0.0], [0.0, 0.0, 3.0]], radiance=12.0)  # faces down: x cross z is -y
SCENES = ["point", "sky", "area"]


# ---- the scenes, for both programs

def place_mesh():
    with open(a.mesh) as src, open(path("dragon.obj"), "w") as out:
        for line in src:
            if line.startswith("v "):
                x, y, z = (float(w) * a.scale for w in line.split()[1:4])
                line = f"v {x:.9g} {y + a.lift:.9g} {z:.9g}\n"
            if not line.startswith(("vn ", "vt ")):
                out.write(line if not line.startswith("f ") else "f " + " ".join(w.split("/")[0] for w in line.split()[1:]) + "\n")
    with open(path("floor.obj"), "w") as f:
        f.write("v -6 -2 6\nv 6 -2 6\nv -6 -2 -6\nv 6 -2 -6\nf 1 2 3\nf 2 4 3\n")


def write_toml(scene):
    light = {"point": '[light.key]\ntype = "point"\nposition = [10.0, 10.0, -10.0]\nintensity = [900.0, 900.0, 900.0]\n',
             "sky": '[light.sky]\ntype = "sky"\nradiance = [1.0, 1.0, 1.0]\n',
             "area": f'[shape.lamp]\ntype = "rectangle"\ncorner = {LAMP["corner"]}\nedges = {LAMP["edges"]}\nemission = {[LAMP["radiance"]] * 3}\n'}[scene]
    integrator = 'type = "direct"' if scene == "point" else 'type = "path"\nmax_depth = 5\nroulette = false'
    shapes = "".join(f'[material.{n}]\ntype = "matte"\nkd = {kd}\n[shape.{n}]\nobj = "{n}.obj"\nmaterial = "{n}"\n'
                     for n, kd in [("dragon", DRAGON), ("floor", FLOOR)])
    with open(path(scene + ".toml"), "w") as f:
        f.write(f"[camera]\neye = [-3.0, 1.5, -3.0]\nlook_at = [0.0, 0.0, 0.0]\nfov = 90.0\n[film]\nresolution = [{a.res}, {a.res}]\n"
                f"[integrator]\n{integrator}\n{light}{shapes}")


def mitsuba_scene(scene):
    T = mi.ScalarTransform4f
    def shape(name, rgb):
        diffuse = {"type": "diffuse", "reflectance": {"type": "rgb", "value": rgb}}
        return {"type": "obj", "filename": path(name + ".obj"), "face_normals": True, "bsdf": {"type": "twosided", "b": diffuse}}
    d = {"type": "scene", "dragon": shape("dragon", DRAGON), "floor": shape("floor", FLOOR),
         "sensor": {"type": "perspective", "fov": 90, "to_world": T().look_at(origin=[-3, 1.5, -3], target=[0, 0, 0], up=[0, 1, 0]),
                    "film": {"type": "hdrfilm", "width": a.res, "height": a.res, "rfilter": {"type": "box"}, "pixel_format": "rgb",
                             "component_format": "float32"}}}
    rgb = lambda x: {"type": "rgb", "value": [float(x)] * 3}
    if scene == "point":
        d["light"] = {"type": "point", "position": [10, 10, -10], "intensity": rgb(900)}
        d["integrator"] = {"type": "direct"}
    else:
        d["integrator"] = {"type": "path", "max_depth": 6, "rr_depth": 1000}
        if scene == "sky":
            d["light"] = {"type": "constant", "radiance": rgb(1)}
        else:
            d["light"] = {"type": "rectangle", "to_world": T().translate([0, 4, 0]).rotate([1, 0, 0], 90).scale([1.5, 1.5, 1]),
                          "emitter": {"type": "area", "radiance": rgb(LAMP["radiance"])}}
    return mi.load_dict(d)


def by_mitsuba(scene, sampler, spp, seed):
    start = time.perf_counter()
    image = np.array(mi.render(scene, sensor=with_sampler(sampler, spp), spp=spp, seed=seed))
    return image[:, ::-1, :], time.perf_counter() - start


def with_sampler(sampler, spp):
    if (sampler, spp) not in sensors:
        T = mi.ScalarTransform4f
        sensors[sampler, spp] = mi.load_dict({
            "type": "perspective", "fov": 90, "to_world": T().look_at(origin=[-3, 1.5, -3], target=[0, 0, 0], up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": a.res, "height": a.res, "rfilter": {"type": "box"}, "pixel_format": "rgb",
                     "component_format": "float32"},
            "sampler": {"type": sampler, "sample_count": spp}})
    return sensors[sampler, spp]


def by_lobe(scene, *options):
    """Image, variance of its pixels or None, seconds, samples per pixel."""
    import OpenEXR
    run = subprocess.run([a.lobe, "render", path(scene + ".toml"), "-o", path("out.exr"), "--threads", str(a.threads), *options],
                         check=True, capture_output=True, text=True)
    lines = [line.split() for line in run.stdout.splitlines()]
    value = lambda key: next(l[1] for l in lines if l and l[0] == key)
    channels = {name: np.array(c.pixels) for name, c in OpenEXR.File(path("out.exr"), separate_channels=True).channels().items()}
    stack = lambda names: np.stack([channels[n] for n in names], -1).astype(np.float64) if names[0] in channels else None
    return stack(["R", "G", "B"]), stack(["variance.R", "variance.G", "variance.B"]), float(value("render")), int(value("samples"))


def lobe_seconds(scene, *options):
    """Writes a PNG only: Mitsuba does not compute layers either."""
    run = subprocess.run([a.lobe, "render", path(scene + ".toml"), "-o", path("out.png"), "--threads", str(a.threads), *options],
                         check=True, capture_output=True, text=True)
    return next(float(l.split()[1]) for l in run.stdout.splitlines() if l.startswith("render "))


def sampled(sampler, spp, *more):
    settings = [f'sampler.type="{sampler}"', f"sampler.spp={spp}", *more]
    return [word for s in settings for word in ("--set", s)]


# ---- the comparisons

def agree():
    print("\n| scene | lobe | Mitsuba | pixels and bands that pass | largest z | mean R, G, B: difference in standard errors |\n|---|---|---|---|---|---|")
    seeds, spp, ours = 32, 32, 1024
    for scene in ["point", "sky"]:
        m = mitsuba_scene(scene)
        theirs = np.stack([by_mitsuba(m, "independent", spp, s)[0] for s in range(seeds)]).astype(np.float64)
        mean, var = theirs.mean(0), theirs.var(0, ddof=1) / seeds
        image, variance, _, _ = by_lobe(scene, *sampled("independent", ours, *mis(scene)))
        # Rounding of f32 on either side: even pixels without noise differ in the last digits.
        rounding = (4e-6 * np.maximum(mean, image)) ** 2
        z = (image - mean) / np.sqrt(var + variance + rounding + 1e-30)
        tests = z.size
        limit = -NormalDist().inv_cdf((1 - 0.99 ** (1 / tests)) / 2)
        passed = (np.abs(z) <= limit).mean()
        bands = [(image[..., c].mean() - mean[..., c].mean()) / np.sqrt((var + variance + rounding)[..., c].sum()) * image[..., c].size
                 for c in range(3)]
        print(f"| {scene} | {ours} spp | {seeds} x {spp} spp | {100 * passed:.4f} % of {tests} (limit {limit:.2f}) | {np.abs(z).max():.2f} | "
              + ", ".join(f"{b:+.2f}" for b in bands) + " |", flush=True)


def mis(scene):
    return [] if scene == "point" else ['integrator.strategy="mis"']


def speed():
    print("\n| scene | spp | lobe, same estimator | llvm_ad_rgb | ratio | scalar_rgb | ratio | lobe, auto, sobol |\n|---|---|---|---|---|---|---|---|")
    for spp in [16, 256]:
        for scene in ["point", "sky"]:
            rate = {}
            ours = lambda: rate.setdefault("lobe", []).append(lobe_seconds(scene, *sampled("independent", spp, *mis(scene))))
            auto = lambda: rate.setdefault("auto", []).append(lobe_seconds(scene, *sampled("sobol", spp, "sampler.replicates=1")))
            for run in range(a.runs):
                for variant in ["llvm_ad_rgb", "scalar_rgb"]:
                    # Scalar is slow, and its speed per sample does not depend on their number.
                    samples = spp if variant == "llvm_ad_rgb" else min(spp, 32)
                    rate.setdefault(variant, []).append(mitsuba_seconds(variant, scene, samples, run) * spp / samples)
                    ours()
                    auto()
            m = {k: a.res * a.res * spp / statistics.median(v) / 1e6 for k, v in rate.items()}
            print(f"| {scene} | {spp} | {m['lobe']:.2f} | {m['llvm_ad_rgb']:.2f} | {m['lobe'] / m['llvm_ad_rgb']:.2f} | {m['scalar_rgb']:.2f} | "
                  f"{m['lobe'] / m['scalar_rgb']:.2f} | {m['auto']:.2f} |", flush=True)


def mitsuba_seconds(variant, scene, spp, seed):
    use(variant)
    if (variant, scene) not in scenes: scenes[variant, scene] = mitsuba_scene(scene)
    m = scenes[variant, scene]
    if (variant, scene, spp) not in warm:
        by_mitsuba(m, "independent", spp, 1000)
        warm.add((variant, scene, spp))
    return by_mitsuba(m, "independent", spp, seed)[1]


def error():
    use("llvm_ad_rgb")
    print("\n| scene | reference's own relMSE | Mitsuba: spp, sampler, time | its relMSE | lobe in that time | its relMSE | ratio |\n|---|---|---|---|---|---|---|")
    for scene in ["sky", "area"]:
        m = mitsuba_scene(scene)
        batch = 256
        parts = np.zeros((4, a.res, a.res, 3))
        for k in range(a.reference_spp // batch):
            parts[k % 4] += by_mitsuba(m, "independent", batch, 10_000 + k)[0]
        parts /= a.reference_spp // batch / 4
        reference = parts.mean(0)
        rel = lambda image: float((((image - reference) ** 2) / (reference ** 2 + 1e-2)).mean())
        own = float((parts.var(0, ddof=1) / 4 / (reference ** 2 + 1e-2)).mean())
        def by_their(sampler, spp):
            by_mitsuba(m, sampler, spp, 999)  # compiles the kernel
            runs = [by_mitsuba(m, sampler, spp, s) for s in range(a.runs)]
            return statistics.median(rel(i) for i, _ in runs) - own, statistics.median(t for _, t in runs)
        # Mitsuba's best sampler: the lowest product of error and time.
        samplers = ["independent", "stratified", "multijitter", "orthogonal", "ldsampler"]
        sampler = min(samplers, key=lambda name: np.prod(by_their(name, 16)))
        for spp in [16, 64, 256]:
            e, t = by_their(sampler, spp)
            ours = [by_lobe(scene, "--no-layers", "--time", f"{t:.4f}", "--seed", str(s), "--set", 'sampler.type="sobol"', "--set", "sampler.replicates=1") for s in range(a.runs)]
            mine = statistics.median(rel(o[0]) for o in ours) - own
            took, n = statistics.median(o[2] for o in ours), ours[0][3]
            print(f"| {scene} | {own:.2e} | {spp}, {sampler}, {t:.3f} s | {e:.3e} | {n} spp, {took:.3f} s | {mine:.3e} | {mine / e:.3f} |", flush=True)


def use(variant):
    if mi.variant() != variant:
        mi.set_variant(variant)
        sensors.clear()
    import drjit as dr
    dr.set_thread_count(a.threads)


sensors, scenes, warm = {}, {}, set()
place_mesh()
for scene in SCENES: write_toml(scene)
use("llvm_ad_rgb")
for part in a.parts: {"agree": agree, "speed": speed, "error": error}[part]()
