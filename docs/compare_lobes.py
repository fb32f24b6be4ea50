"""Compares the lobes of lobe with those of Mitsuba 3.9: values, densities and specular events for random directions, and pictures.

    cargo build --release --bin lobe --example evaluate_material
    python3 -m venv venv && venv/bin/pip install mitsuba==3.9.* numpy OpenEXR
    apt-get install libllvm19                       # for Mitsuba's llvm_ad_rgb
    venv/bin/python docs/compare_lobes.py lobes events pictures [--out FOLDER] [--threads 2]

Prints tables in Markdown. docs/lobes.md contains and explains them. On two cores `events` takes
seconds, `lobes` about two minutes and `pictures` about five.

Models that differ by design are made equal before they are compared: Mitsuba's values are multiplied and added to by terms that this script
computes by its own formulas and integrals, in f64. What the terms are is said beside each case.

Relative differences are |ours - theirs| / max(|theirs|, 1e-6). Values of Mitsuba are divided by its cosine. Its `wi` is our `wo`.
"""
import argparse, glob, os, subprocess, tempfile
ap = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
ap.add_argument("parts", nargs="+", choices=["lobes", "events", "pictures"])
ap.add_argument("--target", default="target/release", help="folder of the programs")
ap.add_argument("--out", default=tempfile.mkdtemp(prefix="lobe-mitsuba-"))
ap.add_argument("--pairs", type=int, default=10_000)
ap.add_argument("--threads", type=int, default=2)
ap.add_argument("--mesh", default="assets/object.obj")
ap.add_argument("--only", help="pictures: this material")
ap.add_argument("--res", type=int, default=256)
ap.add_argument("--spp", type=int, default=160)
a = ap.parse_args()
llvm = sorted(glob.glob("/usr/lib/*/libLLVM.so.19*"))
if llvm: os.environ.setdefault("DRJIT_LIBLLVM_PATH", llvm[0])
import numpy as np
import drjit as dr
import mitsuba as mi
mi.set_variant("llvm_ad_rgb")
dr.set_thread_count(a.threads)

os.makedirs(a.out, exist_ok=True)
path = lambda name: os.path.join(a.out, name)
GOLD = dict(eta=[0.222, 0.428, 1.334], k=[3.208, 2.461, 1.872])
BASE = [0.8, 0.4, 0.1]  # of plastics
ETA = 1.5


# ---- the models, in f64: unit vectors are rows, z is the normal, alpha is a pair

dot = lambda v, w: (v * w).sum(-1)
unit = lambda v: v / np.sqrt(dot(v, v))[..., None]
up = lambda w: np.concatenate([w[..., :2], np.abs(w[..., 2:])], -1)


def stretch(w, alpha):
    return np.sqrt((alpha[0] * w[..., 0]) ** 2 + (alpha[1] * w[..., 1]) ** 2 + w[..., 2] ** 2)


def g1(w, alpha):
    """Smith's masking for GGX: 1 / (1 + Lambda)."""
    z = np.abs(w[..., 2])
    return 2 * z / (z + stretch(w, alpha))


def correlated(wo, wi, alpha):
    """Masking and shadowing correlated by height, 1 / (1 + Lambda(wo) + Lambda(wi)), over the product of both G1 (Heitz 2014)."""
    go, gi = g1(wo, alpha), g1(wi, alpha)
    return 1 / (1 / go + 1 / gi - 1) / (go * gi)


def dielectric(cos, eta):
    """Fresnel's equations, and the cosine of the refracted direction; eta is the index on the far side over that on the near side."""
    cos_t = np.sqrt(np.maximum(1 - (1 - cos**2) / eta**2, 0))
    across, along = (cos - eta * cos_t) / (cos + eta * cos_t), (eta * cos - cos_t) / (eta * cos + cos_t)
    return np.where(cos_t > 0, (across**2 + along**2) / 2, 1), cos_t


def conductor(cos, eta, k):
    cos_t = np.sqrt(1 - (1 - cos**2) / (eta + 1j * k) ** 2)
    across = (cos - (eta + 1j * k) * cos_t) / (cos + (eta + 1j * k) * cos_t)
    along = ((eta + 1j * k) * cos - cos_t) / ((eta + 1j * k) * cos + cos_t)
    return (np.abs(across) ** 2 + np.abs(along) ** 2) / 2


def cosine_mean(of_cos, points=400):
    """The mean over directions above, weighted by the cosine, of what depends on the cosine only."""
    x, weight = np.polynomial.legendre.leggauss(points)  # in cos
    cos = (x + 1) / 2
    return (of_cos(cos) * cos * weight).sum(-1)


def visible_normals(wo, alpha, n):
    """Of n x n points of the unit square, by Heitz 2018, "Sampling the GGX Distribution of Visible Normals", and their weights.
    Points are dense where normals are steep, which lose most: 1 - u is the fourth power of what is even."""
    t, v = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n) + 0.5) / n)
    weights = t.ravel() ** 3 / (t**3).sum()
    r, phi = np.sqrt(1 - t.ravel() ** 4), 2 * np.pi * v.ravel()
    h = unit(wo * [*alpha, 1])[:, None, :]
    t = np.where(h[..., :1] ** 2 + h[..., 1:2] ** 2 > 0, np.stack([-h[..., 1], h[..., 0], 0 * h[..., 0]], -1), [1.0, 0, 0])
    t, s = unit(t), (1 + h[..., 2]) / 2
    b = np.cross(h, t)
    x, y = r * np.cos(phi), r * np.sin(phi)
    y = (1 - s) * np.sqrt(1 - x**2) + s * y
    m = x[..., None] * t + y[..., None] * b + np.sqrt(np.maximum(1 - x**2 - y**2, 0))[..., None] * h
    return unit(np.concatenate([m[..., :2] * alpha, np.maximum(m[..., 2:], 0)], -1)), weights


def lost(w, alpha, eta=None, transmits=False, n=128):
    """The fraction of light from each direction above that single scattering does not return; eta None is a mirror."""
    if alpha[0] == alpha[1] and len(w) > 512:  # linear between nodes of the cosine
        root = np.linspace(1e-3, 1, 512)
        nodes = np.stack([np.sqrt(1 - root**4), 0 * root, root**2], -1)
        return np.interp(np.sqrt(w[..., 2]), root, lost(nodes, alpha, eta, transmits))
    def of_some(wo):
        m, weights = visible_normals(wo, alpha, n)
        wo = wo[:, None, :]
        cos = dot(wo, m)
        def kept(wi, side):  # G2 / G1
            return np.where(wi[..., 2] * side > 0, correlated(wo, wi, alpha) * g1(wi, alpha), 0)
        reflected = kept(2 * cos[..., None] * m - wo, 1)
        if eta is None: return 1 - reflected @ weights
        f, cos_t = dielectric(cos, eta)
        returned = f * reflected
        if transmits: returned += (1 - f) * kept((cos / eta - cos_t)[..., None] * m - wo / eta, -1)
        return 1 - returned @ weights
    return np.concatenate([of_some(some) for some in np.array_split(w, max(1, len(w) * n * n // 100_000))])


def mean_lost(alpha, *interface):
    """Its mean over directions, weighted by the cosine: Gauss's rule over the cosine, the midpoint rule around the normal."""
    x, weight = np.polynomial.legendre.leggauss(48)
    cos, turns = (x + 1) / 2, 1 if alpha[0] == alpha[1] else 24
    sum = 0
    for phi in (np.arange(turns) + 0.5) / turns * np.pi / 2:
        sin = np.sqrt(1 - cos**2)
        sum += (lost(np.stack([sin * np.cos(phi), sin * np.sin(phi), cos], -1), alpha, *interface) * cos * weight).sum() / turns
    return sum


def unbounded_to_bounded(wo, alpha):
    """Density of bounded visible normals over that of all visible ones (Tokuyoshi and Eto 2024, equation 5)."""
    z, t = wo[..., 2], stretch(wo, alpha)
    s2, a2 = (1 + np.sqrt(1 - z**2)) ** 2, min(alpha) ** 2
    return (z + t) / ((1 - a2) * s2 / (s2 + a2 * z**2) * z + t)


def multiple_pdf(w, alpha):
    """Density of the directions that the crate draws for light that meets several facets (src/bxdf/microfacet/multiple.rs)."""
    z2, a2 = w[..., 2] ** 2, (alpha[0] ** 2 + alpha[1] ** 2) / 2
    return np.abs(w[..., 2]) * (1 - a2) / (np.pi * (z2 + a2 * (1 - z2)) * -np.log(a2))


def lobe_shares(first, second):
    """Probability of each of two lobes, from the albedos that they estimate."""
    return 0.05 + 0.9 * first / (first + second), 0.05 + 0.9 * second / (first + second)


class Coat:
    """Diffuse reflection below a coat: T(wo) T(wi) / (pi mean T) times what the base reflects of light that enters."""
    def __init__(self, alpha):
        self.alpha, self.smooth = alpha, max(alpha) == 0
        self.mean = cosine_mean(lambda c: 1 - dielectric(c, ETA)[0]) if self.smooth else mean_lost(alpha, ETA)
        leaving = self.mean / ETA**2
        self.factor = np.array(BASE) * leaving / (1 - np.array(BASE) * (1 - leaving)) / (np.pi * self.mean)

    def entering(self, w):
        return 1 - dielectric(w[..., 2], ETA)[0] if self.smooth else lost(w, self.alpha, ETA)

    def f(self, wo, wi):
        return self.factor * (self.entering(wo) * self.entering(wi))[..., None]

    def shares(self, wo):
        """Of the coat's reflection and of the base."""
        below = self.entering(wo) * self.mean * np.pi * self.factor.max()
        return lobe_shares(dielectric(wo[..., 2], ETA)[0], below)


def multiple_of_metal(wo, wi, alpha):
    """Value of light that meets several facets (Kulla and Conty 2017), and what is lost from wo."""
    cos_mean = np.array([cosine_mean(lambda c: conductor(c, e, k)) for e, k in zip(GOLD["eta"], GOLD["k"])])
    mean, of_o, of_i = mean_lost(alpha), lost(wo, alpha), lost(wi, alpha)
    factor = cos_mean**2 * (1 - mean) / (1 - cos_mean * mean)
    return factor * (of_o * of_i / (np.pi * mean))[..., None], of_o


def multiple_of_glass(wo, wi, alpha):
    """Value and density of light that meets several facets, and what is lost from wo."""
    sides = [(ETA, True), (1 / ETA, True)]
    means = [mean_lost(alpha, *side) for side in sides]
    below, reflects = wo[..., 2] < 0, wo[..., 2] * wi[..., 2] > 0
    def of(w, is_below):
        result = np.empty(len(w))
        for side, which in zip(sides, (~is_below, is_below)): result[which] = lost(up(w[which]), alpha, *side)
        return result
    of_o, far = of(wo, below), np.where(reflects, below, ~below)
    of_i = of(wi, far)
    # eta^2 times what crosses is the same from both sides: the mean of both, if each loss crossed like light at a smooth boundary.
    transmitted = cosine_mean(lambda c: 1 - dielectric(c, ETA)[0])
    both = (transmitted * means[0] + transmitted * means[1]) / 2
    both = min(both, means[0], means[1] * ETA**2)
    crossing = np.where(below, both / (means[1] * ETA**2), both / means[0])
    share = np.where(reflects, 1 - crossing, crossing)
    scale = np.where(reflects, 1, np.where(below, ETA**-2, ETA**2))
    f = share * of_o * of_i / (np.pi * np.where(far, means[1], means[0]) * scale)
    return f[..., None], share * multiple_pdf(wi, alpha), of_o


# ---- both programs

rgb = lambda values: {"type": "rgb", "value": list(values)}


def theirs(bsdf, wo, wi):
    """Value without the cosine, and density."""
    bsdf, si = mi.load_dict(bsdf), dr.zeros(mi.SurfaceInteraction3f, len(wo))
    si.wi = mi.Vector3f(wo.T)
    f, pdf = bsdf.eval_pdf(mi.BSDFContext(), si, mi.Vector3f(wi.T))
    return np.array(f).T / np.abs(wi[:, 2:]).astype(np.float64), np.array(pdf).astype(np.float64)


def ours(material, rows, *options):
    """What examples/evaluate_material.rs answers for a material of the scene file, or for options of its own."""
    which = [path("materials.toml"), material] if isinstance(material, str) else ["--facets", *map(str, material)]
    lines = "\n".join(" ".join(f"{x:.9g}" for x in row) for row in rows)
    run = subprocess.run([os.path.join(a.target, "examples/evaluate_material"), *which, *options], input=lines, check=True, stdout=subprocess.PIPE, text=True)
    return np.array([line.split() for line in run.stdout.splitlines()], dtype=np.float64)


def directions(n, sides, rng):
    """Uniform over one hemisphere or both, without those within 1e-3 of the surface: there, 1 - F cancels in f32 in both programs."""
    w = unit(rng.normal(size=(2 * n, 3))).astype(np.float32)
    w = w[np.abs(w[:, 2]) > 1e-3][:n]
    return w if sides == 2 else up(w)


def materials():
    text = "".join(f'[material.{name}]\n{keys}\n' for name, keys in {
        "diffuse": f'type = "matte"\nkd = {BASE}',
        "metal": f'type = "metal"\nmetal = [{GOLD["eta"]}, {GOLD["k"]}]',
        "glass": f'type = "glass"\neta = {ETA}',
        "thin": f'type = "thin-glass"\neta = {ETA}',
        "plastic": f'type = "plastic"\nkd = {BASE}\neta = {ETA}',
        **{named("metal", (x, y)): f'type = "metal"\nmetal = [{GOLD["eta"]}, {GOLD["k"]}]\nroughness = {x}\nroughness_v = {y}' for x, y in ALPHAS},
        **{named("glass", (x, y)): f'type = "glass"\neta = {ETA}\nroughness = {x}\nroughness_v = {y}' for x, y in ALPHAS},
        **{named("plastic", (x, y)): f'type = "plastic"\nkd = {BASE}\neta = {ETA}\nroughness = {x}\nroughness_v = {y}' for x, y in ALPHAS},
    }.items())
    with open(path("materials.toml"), "w") as out: out.write(text)


named = lambda kind, alpha: f"{kind}-{alpha[0] * 100:.0f}-{alpha[1] * 100:.0f}"
ALPHAS = [(0.1, 0.1), (0.3, 0.3), (0.1, 0.4)]
rough = lambda kind, alpha, **keys: {"type": kind, "distribution": "ggx", "sample_visible": True, "alpha_u": alpha[0], "alpha_v": alpha[1], **keys}
IOR, METAL = dict(int_ior=ETA, ext_ior=1.0), {key: rgb(value) for key, value in GOLD.items()}
PLASTIC = dict(**IOR, nonlinear=True)


def largest(x, y):
    return np.abs(x - y) / np.maximum(np.abs(y), 1e-6)


def row(name, parameters, corrections, our, their, corrected, i):
    """One row: the largest relative difference, and that of all light that uniform directions see, or of all samples. Each of `our`, `their` and `corrected` is a value and a density, and `i` are the directions of the light."""
    cells = []
    for other in (their, corrected) if corrections else (their,):
        for x, y, cos in zip(our, other, (np.abs(i[:, 2:]), 1)):
            cells.append(f"{largest(x, y).max():.1e}, {(np.abs(x - y) * cos).sum() / (y * cos).sum():.1e}")
    print(f"| {name} | {parameters} | " + " | ".join(cells + ["", ""][: 4 - len(cells)]) + f" | {corrections} |", flush=True)


def lobes():
    rng = np.random.default_rng(1)
    print("\n| Mitsuba | parameters | f, as it is | pdf, as it is | f, corrected | pdf, corrected | corrected for |" + "\n" + "|---" * 7 + "|")
    def pairs(sides):
        wo = directions(a.pairs, sides[0], rng)
        wi = directions(a.pairs, sides[1], rng)
        return wo, wi, wo.astype(np.float64), wi.astype(np.float64)
    def of(material, wo, wi):
        values = ours(material, np.concatenate([wo, wi], -1))
        return values[:, :3], values[:, 3]

    wo, wi, o, i = pairs((1, 2))
    their = theirs({"type": "diffuse", "reflectance": rgb(BASE)}, wo, wi)
    row("diffuse", "", "", of("diffuse", wo, wi), their, their, i)

    for alpha in ALPHAS:
        wo, wi, o, i = pairs((1, 1))
        their = theirs(rough("roughconductor", alpha, **METAL), wo, wi)
        once = their[0] * correlated(o, i, alpha)[:, None], their[1] * unbounded_to_bounded(o, alpha)
        row("roughconductor", f"alpha {alpha}, one facet", "G, bound", of([*alpha, *GOLD["eta"], *GOLD["k"]], wo, wi), their, once, i)
        some = slice(None if alpha[0] == alpha[1] else a.pairs // 5)  # losses are integrated for each direction
        wo, wi, o, i, their, once = wo[some], wi[some], o[some], i[some], [x[some] for x in their], [x[some] for x in once]
        multiple, of_o = multiple_of_metal(o, i, alpha)
        all = once[0] + multiple, (1 - of_o) * once[1] + of_o * multiple_pdf(i, alpha)
        row("roughconductor", f"alpha {alpha}", "G, bound, multiple", of(named("metal", alpha), wo, wi), their, all, i)

    for alpha in ALPHAS:
        wo, wi, o, i = [x[: None if alpha[0] == alpha[1] else a.pairs // 5] for x in pairs((2, 2))]
        their = theirs(rough("roughdielectric", alpha, **IOR), wo, wi)
        once = their[0] * correlated(o, i, alpha)[:, None], their[1]
        multiple, pdf, of_o = multiple_of_glass(o, i, alpha)
        all = once[0] + multiple, (1 - of_o) * once[1] + of_o * pdf
        our = of(named("glass", alpha), wo, wi)
        row("roughdielectric", f"alpha {alpha}", "G, multiple", our, their, all, i)
        few = multiple[:, 0] < 1e-3 * all[0][:, 0]  # what is not integrated decides
        row("roughdielectric", f"alpha {alpha}, {few.sum()} pairs of little multiple scattering", "G, multiple",
            *[[x[few] for x in both] for both in (our, their, all)], i[few])

    wo, wi, o, i = pairs((1, 1))
    their = theirs({"type": "plastic", **PLASTIC, "diffuse_reflectance": rgb(BASE)}, wo, wi)
    coat = Coat((0, 0))
    # Mitsuba's mean within is a fitted polynomial.
    inner, fitted = 1 - coat.mean / ETA**2, float(mi.fresnel_diffuse_reflectance(mi.Float(1 / ETA))[0])
    base = np.array(BASE)
    exact = their[0] * (1 - base * fitted) / (1 - base * inner)
    row("plastic", "base only", "mean, selection", of("plastic", wo, wi), their, (exact, coat.shares(o)[1] * i[:, 2] / np.pi), i)

    for alpha in ALPHAS[:2]:
        wo, wi, o, i = pairs((1, 1))
        plastic = {"type": "roughplastic", "distribution": "ggx", "alpha": alpha[0], **PLASTIC}
        their = theirs({**plastic, "diffuse_reflectance": rgb(BASE)}, wo, wi)
        glossy = theirs({**plastic, "diffuse_reflectance": rgb([0.0] * 3)}, wo, wi)[0] * correlated(o, i, alpha)[:, None]
        coat = Coat(alpha)
        facets = theirs(rough("roughconductor", alpha, **METAL), wo, wi)[1] * unbounded_to_bounded(o, alpha)
        above, below = coat.shares(o)
        corrected = glossy + coat.f(o, i), above * facets + below * i[:, 2] / np.pi
        row("roughplastic", f"alpha {alpha[0]}", "G, bound, base, selection", of(named("plastic", alpha), wo, wi), their, corrected, i)


def events():
    """Specular events for the same directions and sample values: differences are absolute for directions and probabilities."""
    rng = np.random.default_rng(2)
    print("\n| Mitsuba | events | of another kind | direction | weight, relative | probability | eta |\n|---|---|---|---|---|---|---|")
    cases = [("conductor", "metal", {"type": "conductor", **METAL}, 1), ("dielectric", "glass", {"type": "dielectric", **IOR}, 2),
             ("thindielectric", "thin", {"type": "thindielectric", **IOR}, 2),
             ("plastic", "plastic", {"type": "plastic", **PLASTIC, "diffuse_reflectance": rgb(BASE)}, 1)]
    for name, material, bsdf, sides in cases:
        wo, u = directions(a.pairs, sides, rng), rng.random((a.pairs, 3), dtype=np.float32)
        if name == "plastic": u[:, 0] = 0  # either program's coat
        bsdf, si = mi.load_dict(bsdf), dr.zeros(mi.SurfaceInteraction3f, a.pairs)
        si.wi = mi.Vector3f(wo.T)
        their, weight = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[:, 0]), mi.Point2f(u[:, 1:].T))
        to, pdf, eta = np.array(their.wo).T, np.array(their.pdf), np.array(their.eta)
        weight = np.array(weight).T.astype(np.float64)
        our = ours(material, np.concatenate([wo, u], -1), "--sample")
        wi, f, our_pdf, our_eta, specular = our[:, :3], our[:, 3:6], our[:, 6], our[:, 7], our[:, 8]
        our_weight = f * np.abs(wi[:, 2:]) / our_pdf[:, None]
        note = ""
        if name == "plastic":  # selected otherwise: weight times probability is the Fresnel reflectance
            our_weight, weight, note = our_weight * our_pdf[:, None], weight * pdf[:, None], " times probability"
        same = ((wi[:, 2] > 0) == (to[:, 2] > 0)) & (specular == 1)
        worst = lambda x: f"{x[same].max():.1e}"
        print(f"| {name} | {a.pairs} | {(~same).sum()} | {worst(np.abs(wi - to).max(-1))} | {worst(largest(our_weight, weight).max(-1))}{note} | "
              f"{worst(np.abs(our_pdf - pdf))} | {worst(np.abs(our_eta - eta))} |", flush=True)


# ---- pictures

EYE, TARGET, FOV, DEPTH = [0.9, 3.4, -6.9], [-0.02, 1.15, 0.0], 27, 10
FLOOR, SKY, LAMP = [0.65, 0.5, 0.35], [0.5, 0.55, 0.6], [4.0, 3.8, 3.5]
SHAPES = {  # corner and edges; the lamp faces down
    "floor": ([-8.0, 0.0, -8.0], [0.0, 0.0, 16.0], [16.0, 0.0, 0.0]), "lamp": ([-4.0, 5.0, -3.5], [3.0, 0.0, 0.0], [0.0, 0.0, 3.0])}
PICTURES = {  # Mitsuba's plugin, ours, and the roughness if the models differ
    "glass": ({"type": "dielectric", **IOR}, f'type = "glass"\neta = {ETA}', None),
    "rough glass": (rough("roughdielectric", (0.3, 0.3), **IOR), f'type = "glass"\neta = {ETA}\nroughness = 0.3', 0.3),
    "metal": ({"type": "conductor", **METAL}, f'type = "metal"\nmetal = [{GOLD["eta"]}, {GOLD["k"]}]', None),
    "rough metal": (rough("roughconductor", (0.2, 0.2), **METAL), f'type = "metal"\nmetal = [{GOLD["eta"]}, {GOLD["k"]}]\nroughness = 0.2', 0.2),
    "plastic": ({"type": "plastic", **PLASTIC, "diffuse_reflectance": rgb(BASE)}, f'type = "plastic"\nkd = {BASE}\neta = {ETA}', None),
    "rough plastic": ({"type": "roughplastic", "distribution": "ggx", "alpha": 0.2, **PLASTIC, "diffuse_reflectance": rgb(BASE)},
                      f'type = "plastic"\nkd = {BASE}\neta = {ETA}\nroughness = 0.2', 0.2),
}


class Table:
    """A function of the cosine, by linear interpolation over its root."""
    LAST = 511
    def __init__(self, of_directions):
        cos = np.maximum((np.arange(self.LAST + 1) / self.LAST) ** 2, 1e-7)
        self.values = mi.Float(of_directions(np.stack([np.sqrt(1 - cos**2), 0 * cos, cos], -1)))

    def __call__(self, cos):
        at = dr.sqrt(dr.abs(cos)) * self.LAST
        i = dr.minimum(mi.UInt32(at), self.LAST - 1)
        low, high = dr.gather(mi.Float, self.values, i), dr.gather(mi.Float, self.values, i + 1)
        return low + (at - mi.Float(i)) * (high - low)


class Corrected(mi.BSDF):
    """One of Mitsuba's rough plugins, with the terms in which lobe differs; samples are those of the plugin, mixed with cosine-weighted ones."""
    EVEN = 0.2
    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        plugin, _, self.alpha = PICTURES[props["picture"]]
        self.kind = plugin["type"]
        self.two_sided = self.kind == "roughdielectric"
        self.plugin = mi.load_dict(plugin)
        self.m_components, self.m_flags = [int(mi.BSDFFlags.Glossy)], mi.BSDFFlags.Glossy | mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        alpha, color = (self.alpha,) * 2, lambda v: mi.Color3f(*map(float, v))
        if self.kind == "roughconductor":
            self.lost, mean = Table(lambda w: lost(w, alpha)), mean_lost(alpha)
            f = np.array([cosine_mean(lambda c: conductor(c, e, k)) for e, k in zip(GOLD["eta"], GOLD["k"])])
            self.factor = color(f**2 * (1 - mean) / (1 - f * mean) / (np.pi * mean))
        elif self.kind == "roughplastic":
            coat = Coat(alpha)
            self.lost, self.factor = Table(coat.entering), color(coat.factor)
            self.coat = mi.load_dict({**plugin, "diffuse_reflectance": rgb([0.0] * 3)})
        else:
            self.sides = [Table(lambda w, eta=eta: lost(w, alpha, eta, True)) for eta in (ETA, 1 / ETA)]
            self.means = [float(mean_lost(alpha, eta, True)) for eta in (ETA, 1 / ETA)]
            both = cosine_mean(lambda c: 1 - dielectric(c, ETA)[0]) * sum(self.means) / 2
            self.both = float(min(both, self.means[0], self.means[1] * ETA**2))

    def added(self, o, i):
        co, ci = o.z, i.z
        if not self.two_sided:
            return dr.select((co > 0) & (ci > 0), self.factor * self.lost(co) * self.lost(ci), 0)
        below, reflects = co < 0, co * ci > 0
        far = dr.select(reflects, below, ~below)
        of = lambda c, is_below: dr.select(is_below, self.sides[1](c), self.sides[0](c))
        own, other = [dr.select(side, self.means[1], self.means[0]) for side in (below, far)]
        crossing = self.both / dr.select(below, self.means[1] * ETA**2, self.means[0])
        scale = dr.select(reflects, 1, dr.select(below, ETA**-2, ETA**2))
        return mi.Color3f(dr.select(reflects, 1 - crossing, crossing) * of(co, below) * of(ci, far) / (other * scale * dr.pi))

    def eval(self, ctx, si, wi, active=True):
        g1 = lambda w: 2 * dr.abs(w.z) / (dr.abs(w.z) + dr.sqrt(self.alpha**2 * (1 - w.z**2) + w.z**2))
        go, gi = g1(si.wi), g1(wi)
        base = self.coat if self.kind == "roughplastic" else self.plugin
        once = base.eval(ctx, si, wi, active) / ((1 / go + 1 / gi - 1) * go * gi)
        return dr.select(active & (wi.z != 0), once + self.added(si.wi, wi) * dr.abs(wi.z), 0)

    def pdf(self, ctx, si, wi, active=True):
        even = dr.abs(wi.z) / dr.pi * (0.5 if self.two_sided else dr.select(wi.z > 0, mi.Float(1), 0))
        return (1 - self.EVEN) * self.plugin.pdf(ctx, si, wi, active) + self.EVEN * even

    def eval_pdf(self, ctx, si, wi, active=True):
        return self.eval(ctx, si, wi, active), self.pdf(ctx, si, wi, active)

    def sample(self, ctx, si, u, v, active=True):
        even = u < self.EVEN
        rest = dr.select(even, u / self.EVEN, (u - self.EVEN) / (1 - self.EVEN))
        bs, _ = self.plugin.sample(ctx, si, rest, v, active & ~even)
        w = mi.warp.square_to_cosine_hemisphere(v)
        w.z = dr.select(self.two_sided & (rest < 0.5), -w.z, w.z)
        # A facet may reflect downwards or refract upwards: no event.
        crosses = bs.sampled_type == mi.UInt32(+mi.BSDFFlags.GlossyTransmission)
        is_event = even | ((bs.pdf > 0) & (crosses == (bs.wo.z * si.wi.z < 0)))
        bs.wo = dr.select(even, w, bs.wo)
        bs.pdf = dr.select(is_event, self.pdf(ctx, si, bs.wo, active), 0)
        bs.eta = dr.select(bs.wo.z * si.wi.z > 0, mi.Float(1), dr.select(si.wi.z > 0, mi.Float(ETA), 1 / ETA))
        bs.sampled_type, bs.sampled_component = mi.UInt32(+mi.BSDFFlags.GlossyReflection), mi.UInt32(0)
        active &= bs.pdf > 0
        return bs, dr.select(active, self.eval(ctx, si, bs.wo, active) / bs.pdf, 0)


def mitsuba_scene(bsdf):
    T = mi.ScalarTransform4f
    def rectangle(name, **more):
        corner, u, v = map(np.array, SHAPES[name])
        to_world = np.eye(4)
        to_world[:3] = np.stack([u / 2, v / 2, unit(np.cross(u, v)), corner + u / 2 + v / 2], -1)
        return {"type": "rectangle", "to_world": T(to_world), **more}
    return mi.load_dict({
        "type": "scene", "integrator": {"type": "path", "max_depth": DEPTH + 1, "rr_depth": 1000},
        "sensor": {"type": "perspective", "fov": FOV, "to_world": T().look_at(origin=EYE, target=TARGET, up=[0, 1, 0]),
                   "film": {"type": "hdrfilm", "width": a.res, "height": a.res, "rfilter": {"type": "box"}, "pixel_format": "rgb", "component_format": "float32"}},
        "object": {"type": "obj", "filename": path("object.obj"), "face_normals": True, "bsdf": bsdf},
        "floor": rectangle("floor", bsdf={"type": "twosided", "b": {"type": "diffuse", "reflectance": rgb(FLOOR)}}),
        "lamp": rectangle("lamp", emitter={"type": "area", "radiance": rgb(LAMP)}, bsdf={"type": "diffuse", "reflectance": rgb([0.0] * 3)}),
        "sky": {"type": "constant", "radiance": rgb(SKY)}})


def write_toml(material):
    shapes = "".join(f'[shape.{name}]\ntype = "rectangle"\ncorner = {corner}\nedges = [{u}, {v}]\n' + more for (name, (corner, u, v)), more in
                     zip(SHAPES.items(), ['material = "floor"\n', f"emission = {LAMP}\n"]))
    with open(path("picture.toml"), "w") as out:
        out.write(f"[camera]\neye = {EYE}\nlook_at = {TARGET}\nfov = {FOV}\n[film]\nresolution = [{a.res}, {a.res}]\n"
                  f'[sampler]\ntype = "independent"\nspp = {a.spp}\n[integrator]\ntype = "path"\nmax_depth = {DEPTH}\nroulette = false\n'
                  f'[light.sky]\ntype = "sky"\nradiance = {SKY}\n[material.floor]\ntype = "matte"\nkd = {FLOOR}\n[material.object]\n{material}\n'
                  f'[shape.object]\nobj = "object.obj"\nmaterial = "object"\n{shapes}')


def by_mitsuba(bsdf, runs=32):
    scene = mitsuba_scene(bsdf)
    images = np.stack([np.array(mi.render(scene, spp=a.spp // runs, seed=seed))[:, ::-1] for seed in range(runs)]).astype(np.float64)
    return images.mean(0), images.var(0, ddof=1) / runs


def by_lobe(name):
    import OpenEXR
    file = path(name.replace(" ", "-") + ".exr")
    subprocess.run([os.path.join(a.target, "lobe"), "render", path("picture.toml"), "-o", file, "--threads", str(a.threads)], check=True, capture_output=True)
    channels = {key: np.array(c.pixels) for key, c in OpenEXR.File(file, separate_channels=True).channels().items()}
    return [np.stack([channels[prefix + band] for band in "RGB"], -1).astype(np.float64) for prefix in ("", "variance.")]


def pictures():
    import OpenEXR
    from statistics import NormalDist
    mi.register_bsdf("corrected", Corrected)
    # Flat, and well above the floor: neither interpolated normals nor offsets of ray origins are compared here.
    with open(a.mesh) as mesh, open(path("object.obj"), "w") as out:
        for key, *words in filter(None, map(str.split, mesh)):
            if key == "v": out.write(f"v {words[0]} {float(words[1]) + 0.05:.6f} {words[2]}\n")
            if key == "f": out.write("f " + " ".join(word.split("/")[0] for word in words) + "\n")
    print("\n| object | Mitsuba | pixels and bands that pass | largest z | mean z^2 | mean R, G, B: difference in standard errors | of itself |" + "\n" + "|---" * 7 + "|")
    for name, (plugin, material, alpha) in PICTURES.items():
        if a.only not in (None, name): continue
        write_toml(material)
        image, variance = by_lobe(name)
        for model in ["as it is"] + ["corrected"] * (alpha is not None):
            bsdf = plugin if model == "as it is" else {"type": "corrected", "picture": name}
            if name not in ("glass", "rough glass"): bsdf = {"type": "twosided", "b": bsdf} if model == "as it is" else bsdf
            mean, var = by_mitsuba(bsdf)
            file = path(f"{name}-{model}.exr".replace(" ", "-"))
            OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}, {"RGB": mean.astype(np.float32)}).write(file)
            rounding = (4e-6 * np.maximum(mean, image)) ** 2
            both = var + variance + rounding
            z = (image - mean) / np.sqrt(both + 1e-30)
            limit = -NormalDist().inv_cdf((1 - 0.99 ** (1 / z.size)) / 2)
            means = [(image - mean)[..., c].sum() / np.sqrt(both[..., c].sum()) for c in range(3)]
            relative = image.mean((0, 1)) / mean.mean((0, 1)) - 1
            print(f"| {name} | {model} | {100 * (np.abs(z) <= limit).mean():.4f} % of {z.size} (limit {limit:.2f}) | {np.abs(z).max():.2f} | {(z**2).mean():.3f} | "
                  + ", ".join(f"{m:+.2f}" for m in means) + " | " + ", ".join(f"{r:+.1e}" for r in relative) + " |", flush=True)


materials()
for part in a.parts: {"lobes": lobes, "events": events, "pictures": pictures}[part]()
