"""Compares lobe with Mitsuba 3 on the same scenes, smooth and flat: agreement of the images, speed, and error at equal time.

    cargo build --release
    python3 -m venv venv && venv/bin/pip install mitsuba==3.9.* numpy OpenEXR
    apt-get install libllvm19                       # for Mitsuba's llvm_ad_rgb
    venv/bin/python docs/compare_mitsuba.py MESH.obj agree speed error [--scale 0.3] [--lift -1.45] [--threads 2] [--out FOLDER]

MESH.obj has to stand on y = 0. It is scaled and lifted to the place of the chapter's dragon; `assets/dragon.obj --scale 1` works.
Prints tables in Markdown. docs/light.md contains and explains them. `--scalar` adds Mitsuba's scalar_rgb to `speed`,
`--shading flat` measures `error` without vertex normals, `--agree-spp` sets the samples of `agree`.

Every scene is rendered twice. `smooth`: the dragon has vertex normals, those of MESH.obj, or if any corner lacks one, the
sum of the normals of the faces at each vertex, weighted by area. They are written to the mesh that both programs read, at
unit length. `flat`: no vertex normals. The floor is always flat.

Scenes: eye (-3, 1.5, -3), target the origin, 90 degrees, 512 x 512 pixels, box filter, Lambertian dragon and floor.
`point`: (10, 10, -10), 900 W/sr, direct light. `sky`: radiance 1 from everywhere, five reflections, no roulette. `area`: a
rectangle of 3 x 3 units overhead with radiance 12, five reflections, no roulette.
Mitsuba's camera space is right-handed: its images are flipped in x.
"""
import argparse, gc, glob, os, subprocess, statistics, tempfile, time
from statistics import NormalDist

ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("mesh")
ap.add_argument("parts", nargs="+", choices=["agree", "speed", "error"])
for name, default in [("scale", 0.3), ("lift", -1.45), ("threads", 2), ("res", 512), ("runs", 5), ("agree-spp", 1024)]:
    ap.add_argument("--" + name, type=type(default), default=default)
ap.add_argument("--lobe", default="target/release/lobe")
ap.add_argument("--out", default=tempfile.mkdtemp(prefix="lobe-mitsuba-"))
ap.add_argument("--reference-spp", type=int, default=2048)
ap.add_argument("--scalar", action="store_true", help="speed: scalar_rgb too")
ap.add_argument("--shading", choices=["smooth", "flat"], default="smooth", help="of error")
a = ap.parse_args()
llvm = sorted(glob.glob("/usr/lib/*/libLLVM.so.19*"))
if llvm: os.environ.setdefault("DRJIT_LIBLLVM_PATH", llvm[0])
import numpy as np
import mitsuba as mi

os.makedirs(a.out, exist_ok=True)
path = lambda name: os.path.join(a.out, name)
DRAGON, FLOOR = [.8, .1, .2], [.2, .3, .9]
LAMP = dict(corner=[-1.5, 4.0, -1.5], edges=[[3.0, 0.0, 0.0], [0.0, 0.0, 3.0]], radiance=12.0)  # faces down: x cross z is -y
SCENES, SHADINGS = ["point", "sky", "area"], ["smooth", "flat"]
CASES = [(scene, shading) for shading in SHADINGS for scene in SCENES]


# ---- the scenes, for both programs

def place_mesh():
    points, normals, faces = [], [], []  # a face: pairs of a point and a normal, or None
    number = lambda word, known: int(word) - 1 if int(word) > 0 else known + int(word)
    with open(a.mesh) as src:
        for key, *words in filter(None, map(str.split, src)):
            if key in ("v", "vn"): (points if key == "v" else normals).append([float(w) for w in words[:3]])
            if key == "f":
                corners = [w.split("/") + ["", ""] for w in words]
                faces.append([(number(c[0], len(points)), number(c[2], len(normals)) if c[2] else None) for c in corners])
    points = np.array(points) * a.scale + [0, a.lift, 0]
    if any(n is None for f in faces for _, n in f):
        fans = np.array([(f[0][0], f[i][0], f[i + 1][0]) for f in faces for i in range(1, len(f) - 1)])
        p, q, r = points[fans.T]
        normals = np.zeros_like(points)
        for corner in fans.T: np.add.at(normals, corner, np.cross(q - p, r - p))  # as long as twice the area
        faces = [[(v, v) for v, _ in f] for f in faces]
    # Mitsuba interpolates normals as they are, lobe at unit length.
    lengths = np.linalg.norm(normals, axis=-1, keepdims=True)
    normals = np.where(lengths > 0, normals / np.where(lengths > 0, lengths, 1), [0, 1, 0])
    rows = lambda key, table: "".join(f"{key} {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in table)
    face = lambda corner: "".join("f " + " ".join(corner(v + 1, n) for v, n in f) + "\n" for f in faces)
    with open(path("dragon-smooth.obj"), "w") as out:
        out.write(rows("v", points) + rows("vn", normals) + face(lambda v, n: f"{v}//{n + 1}"))
    with open(path("dragon-flat.obj"), "w") as out:
        out.write(rows("v", points) + face(lambda v, n: f"{v}"))
    with open(path("floor.obj"), "w") as f:
        f.write("v -6 -2 6\nv 6 -2 6\nv -6 -2 -6\nv 6 -2 -6\nf 1 2 3\nf 2 4 3\n")


def write_toml(scene, shading):
    light = {"point": '[light.key]\ntype = "point"\nposition = [10.0, 10.0, -10.0]\nintensity = [900.0, 900.0, 900.0]\n',
             "sky": '[light.sky]\ntype = "sky"\nradiance = [1.0, 1.0, 1.0]\n',
             "area": f'[shape.lamp]\ntype = "rectangle"\ncorner = {LAMP["corner"]}\nedges = {LAMP["edges"]}\nemission = {[LAMP["radiance"]] * 3}\n'}[scene]
    integrator = 'type = "direct"' if scene == "point" else 'type = "path"\nmax_depth = 5\nroulette = false'
    shapes = "".join(f'[material.{n}]\ntype = "matte"\nkd = {kd}\n[shape.{n}]\nobj = "{mesh}.obj"\nmaterial = "{n}"\n'
                     for n, mesh, kd in [("dragon", "dragon-" + shading, DRAGON), ("floor", "floor", FLOOR)])
    with open(path(f"{scene}-{shading}.toml"), "w") as f:
        f.write(f"[camera]\neye = [-3.0, 1.5, -3.0]\nlook_at = [0.0, 0.0, 0.0]\nfov = 90.0\n[film]\nresolution = [{a.res}, {a.res}]\n"
                f"[integrator]\n{integrator}\n{light}{shapes}")


def mitsuba_scene(scene, shading):
    T = mi.ScalarTransform4f
    def shape(name, rgb, flat):
        diffuse = {"type": "diffuse", "reflectance": {"type": "rgb", "value": rgb}}
        return {"type": "obj", "filename": path(name + ".obj"), "face_normals": flat, "bsdf": {"type": "twosided", "b": diffuse}}
    d = {"type": "scene", "dragon": shape("dragon-" + shading, DRAGON, shading == "flat"), "floor": shape("floor", FLOOR, True),
         "sensor": {"type": "perspective", "fov": 90, "to_world": T().look_at(origin=[-3, 1.5, -3], target=[0, 0, 0], up=[0, 1, 0]),
                    "film": {"type": "hdrfilm", "width": a.res, "height": a.res, "rfilter": {"type": "box"}, "pixel_format": "rgb",
                             "component_format": "float32"}}}
    rgb = lambda x: {"type": "rgb", "value": [float(x)] * 3}
    if scene == "point":
        d["light"] = {"type": "point", "position": [10, 10, -10], "intensity": rgb(900)}
        d["integrator"] = {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0}  # no ray hits a point
    else:
        d["integrator"] = {"type": "path", "max_depth": 6, "rr_depth": 1000}
        if scene == "sky":
            d["light"] = {"type": "constant", "radiance": rgb(1)}
        else:
            d["light"] = {"type": "rectangle", "to_world": T().translate([0, 4, 0]).rotate([1, 0, 0], 90).scale([1.5, 1.5, 1]),
                          "emitter": {"type": "area", "radiance": rgb(LAMP["radiance"])}}
    return mi.load_dict(d)


def by_mitsuba(scene, sampler, spp, seed):
    sensor = with_sampler(sampler, spp)
    start = time.perf_counter()
    image = np.array(mi.render(scene, sensor=sensor, spp=spp, seed=seed))
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


def by_lobe(scene, shading, *options):
    """Image, variance of its pixels or None, seconds, samples per pixel."""
    import OpenEXR
    run = subprocess.run([a.lobe, "render", path(f"{scene}-{shading}.toml"), "-o", path("out.exr"), "--threads", str(a.threads), *options],
                         check=True, capture_output=True, text=True)
    lines = [line.split() for line in run.stdout.splitlines()]
    value = lambda key: next(l[1] for l in lines if l and l[0] == key)
    channels = {name: np.array(c.pixels) for name, c in OpenEXR.File(path("out.exr"), separate_channels=True).channels().items()}
    stack = lambda names: np.stack([channels[n] for n in names], -1).astype(np.float64) if names[0] in channels else None
    return stack(["R", "G", "B"]), stack(["variance.R", "variance.G", "variance.B"]), float(value("render")), int(value("samples"))


def lobe_seconds(scene, shading, *options):
    """Writes a PNG only: Mitsuba does not compute layers either."""
    run = subprocess.run([a.lobe, "render", path(f"{scene}-{shading}.toml"), "-o", path("out.png"), "--threads", str(a.threads), *options],
                         check=True, capture_output=True, text=True)
    return next(float(l.split()[1]) for l in run.stdout.splitlines() if l.startswith("render "))


def sampled(sampler, spp, *more):
    settings = [f'sampler.type="{sampler}"', f"sampler.spp={spp}", *more]
    return [word for s in settings for word in ("--set", s)]


# ---- the comparisons

def agree():
    print("\n| scene | lobe | Mitsuba | pixels and bands that pass | largest z | mean R, G, B: difference in standard errors | of itself |"
          "\n|---|---|---|---|---|---|---|")
    seeds = 32
    spp = -(-a.agree_spp // seeds)
    ours = seeds * spp
    for scene, shading in CASES:
        m = mitsuba_scene(scene, shading)
        theirs = np.stack([by_mitsuba(m, "independent", spp, s)[0] for s in range(seeds)]).astype(np.float64)
        mean, var = theirs.mean(0), theirs.var(0, ddof=1) / seeds
        image, variance, _, _ = by_lobe(scene, shading, *sampled("independent", ours, *mis(scene)))
        # Rounding of f32 on either side: even pixels without noise differ in the last digits.
        rounding = (4e-6 * np.maximum(mean, image)) ** 2
        z = (image - mean) / np.sqrt(var + variance + rounding + 1e-30)
        tests = z.size
        limit = -NormalDist().inv_cdf((1 - 0.99 ** (1 / tests)) / 2)
        passed = (np.abs(z) <= limit).mean()
        bands = [(image[..., c].mean() - mean[..., c].mean()) / np.sqrt((var + variance + rounding)[..., c].sum()) * image[..., c].size
                 for c in range(3)]
        relative = image.mean((0, 1)) / mean.mean((0, 1)) - 1
        print(f"| {scene}, {shading} | {ours} spp | {seeds} x {spp} spp | {100 * passed:.4f} % of {tests} (limit {limit:.2f}) | {np.abs(z).max():.2f} | "
              + ", ".join(f"{b:+.2f}" for b in bands) + " | " + ", ".join(f"{r:+.1e}" for r in relative) + " |", flush=True)


def mis(scene):
    return [] if scene == "point" else ['integrator.strategy="mis"']


def speed():
    variants, counts = ["llvm_ad_rgb"] + ["scalar_rgb"] * a.scalar, [16, 64]
    seconds = {}  # of each round, by program, scene, shading and samples
    for scene in SCENES: measure(scene, variants, counts, seconds)
    rate = lambda *key: f"{a.res * a.res * key[-1] / statistics.median(seconds[key]) / 1e6:.2f}"
    def ratio(key, other):
        """Of the seconds of each round: median, lowest and highest."""
        r = [s / t for s, t in zip(seconds[key], seconds[other])]
        return f"{statistics.median(r):.2f} ({min(r):.2f} to {max(r):.2f})"
    print("\nMillions of samples a second; ratio of lobe, same estimator, to Mitsuba: median of the rounds, lowest and highest. Times are\n"
          "lobe's `render` and that of mi.render.\n\n| scene | spp | lobe, same estimator | "
          + "".join(f"{v} | ratio | " for v in variants) + "lobe, auto, sobol |\n" + "|---" * (4 + 2 * len(variants)) + "|")
    for shading in SHADINGS:
        for spp in counts:
            for scene in SCENES:
                case = scene, shading, spp
                theirs = "".join(f"{rate(v, *case)} | {ratio((v, *case), ('lobe', *case))} | " for v in variants)
                print(f"| {scene}, {shading} | {spp} | {rate('lobe', *case)} | {theirs}{rate('auto', *case)} |")
    programs = {"lobe": "lobe, same estimator", "auto": "lobe, auto, sobol", "llvm_ad_rgb": "llvm_ad_rgb"}
    print(f"\nThe same times (wall time, {a.threads} threads), smooth over flat.\n\n| scene | spp | " + " | ".join(programs.values())
          + " |\n" + "|---" * (2 + len(programs)) + "|")
    for spp in counts:
        for scene in SCENES:
            print(f"| {scene} | {spp} | " + " | ".join(ratio((p, scene, "smooth", spp), (p, scene, "flat", spp)) for p in programs) + " |", flush=True)


def measure(scene, variants, counts, seconds):
    # Scalar is slow, and its speed per sample does not depend on their number.
    samples = lambda variant, spp: spp if variant == "llvm_ad_rgb" else min(spp, 32)
    # Kernels have code for the lights of all scenes in memory: there is one scene at a time, compiled before the first round.
    gc.collect()
    theirs = {}
    for variant in variants:
        use(variant)
        for shading in SHADINGS: theirs[variant, shading] = mitsuba_scene(scene, shading)
        for shading in SHADINGS:
            for spp in counts: by_mitsuba(theirs[variant, shading], "independent", samples(variant, spp), 1000)
    for spp in counts:
        for run in range(a.runs):
            for shading in SHADINGS:
                note = lambda program, s: seconds.setdefault((program, scene, shading, spp), []).append(s)
                for variant in variants:
                    use(variant)
                    n = samples(variant, spp)
                    note(variant, by_mitsuba(theirs[variant, shading], "independent", n, run)[1] * spp / n)
                note("lobe", lobe_seconds(scene, shading, *sampled("independent", spp, *mis(scene))))
                note("auto", lobe_seconds(scene, shading, *sampled("sobol", spp, "sampler.replicates=1")))


def error():
    use("llvm_ad_rgb")
    print("\n| scene | reference's own relMSE | Mitsuba: spp, sampler, time | its relMSE | lobe in that time | its relMSE | ratio |\n|---|---|---|---|---|---|---|")
    for scene in ["sky", "area"]:
        m = mitsuba_scene(scene, a.shading)
        gc.collect()  # the scene before, as in measure
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
            ours = [by_lobe(scene, a.shading, "--no-layers", "--time", f"{t:.4f}", "--seed", str(s), "--set", 'sampler.type="sobol"', "--set", "sampler.replicates=1") for s in range(a.runs)]
            mine = statistics.median(rel(o[0]) for o in ours) - own
            took, n = statistics.median(o[2] for o in ours), ours[0][3]
            print(f"| {scene}, {a.shading} | {own:.2e} | {spp}, {sampler}, {t:.3f} s | {e:.3e} | {n} spp, {took:.3f} s | {mine:.3e} | {mine / e:.3f} |", flush=True)


def use(variant):
    if mi.variant() != variant:
        mi.set_variant(variant)
        sensors.clear()
    import drjit as dr
    dr.set_thread_count(a.threads)


sensors = {}
place_mesh()
for case in CASES: write_toml(*case)
use("llvm_ad_rgb")
for part in a.parts: {"agree": agree, "speed": speed, "error": error}[part]()
