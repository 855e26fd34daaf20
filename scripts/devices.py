#!/usr/bin/python3
"""What the files of docs/devices say together (src/web/pages/census.html and examples/ports/wgsl/census.mjs make them), and those of
docs/devices/verdicts (scripts/full/verdicts).

scripts/devices.py table     the tables of docs/notes/devices.md, and the largest error of each function
scripts/devices.py write     puts the former there; exit code 1 where a port that computes nothing does not fail
scripts/devices.py typical   each number of src/judge/profiles/typical.toml against what was measured; exit code 1 where a device lies outside
                             that is not known to, or a known one no longer does
"""
import json
import math
import pathlib
import re
import struct
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts"))  # tests load this file from elsewhere
import verdicts  # noqa: E402

DOCUMENT = ROOT / "docs/notes/devices.md"
VERDICTS = ROOT / "docs/devices/verdicts"
BEGIN, END = "<!-- scripts/devices.py write -->\n", "<!-- end of scripts/devices.py write -->\n"

# What lies outside `typical`, as (file, number of the profile): software devices, which approximate more coarsely than GPUs, whose habits the
# profile holds.
SWIFTSHADER = {"exp2", "log_near_one", "sin_cos", "sin_cos_beyond", "unorm_load"}
LAVAPIPE = {"exp2", "atan2", "unorm_load", "srgb_store_ulp"}
# How reports say so: `known_outside` of the profile. Devices by name, each with what of it lies outside.
NAMES = {"SwiftShader": SWIFTSHADER, "lavapipe": LAVAPIPE}
WORDS = {"exp2": "exp2", "log_near_one": "logarithms near 1", "sin_cos": "sines and cosines", "sin_cos_beyond": "sines and cosines", "atan2": "atan2",
         "unorm_load": "loads of 8 bits", "srgb_store_ulp": "sRGB stores"}
KNOWN = {(stem, key) for stem, outside in [("chromium-swiftshader", SWIFTSHADER), ("node-swiftshader", SWIFTSHADER), ("firefox-lavapipe", LAVAPIPE)]
         for key in outside}


def known_words():
    """"SwiftShader (exp2, ...), lavapipe (...)": in the order of WORDS."""
    return ", ".join(f"{name} ({', '.join(dict.fromkeys(words for key, words in WORDS.items() if key in outside))})" for name, outside in NAMES.items())


def devices(folder):
    """{stem: census} of a folder's files."""
    found = {}
    for path in sorted(folder.glob("*.json")):
        census = json.loads(path.read_text())
        if census.get("schema") != "rainref.census/1":
            sys.exit(f"{path}: schema: expected rainref.census/1, found {census.get('schema')}")
        found[path.stem] = census
    if not found:
        sys.exit(f"{folder}: no device is there")
    return found


# ---- the tables ----

def same(values):
    """One text where all are alike, else all of them with their names."""
    return next(iter(values.values())) if len(set(values.values())) == 1 else ", ".join(f"{name}: {value}" for name, value in values.items())


def short_rounding(text):
    return {"to nearest, ties to even": "nearest"}.get(text, text)


def weight_words(weights):
    return "as floats" if weights["bits"] is None else f"{weights['bits']} bits, {weights['rounding']}"


def verdict_words(census):
    sums = {}
    for port in census["ports"]:
        for status, count in port["verdicts"].items():
            sums[status] = sums.get(status, 0) + count
    others = sorted({o["pass"] + ("" if o["status"] == "WARN" else f" {o['status']}") for port in census["ports"] for o in port["others"]})
    return ", ".join(f"{count} {status}" for status, count in sums.items()) + (f" ({', '.join(others)})" if others else "")


def order_words(order):
    changed = [f"`{written}` becomes `{made}`" for written, made in order.items() if made != "as written"]
    return "; ".join(changed) or "as written"


def device_name(census):
    device = census["device"]
    words = [device["vendor"], device["architecture"], device["description"] or device["device"]]
    return " ".join(word for word in words if word) or "name hidden"


def error_words(entry):
    if entry["most"] == "Infinity":
        return "no number"
    if entry["unit"] == "ULP":
        return f"{entry['most']:.3g}"
    return f"2^{math.log2(entry['most']):.1f}" if entry["most"] > 0 else "0"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def tables(found):
    """The text between the two marks of the document."""
    def file(stem):
        return f"[{stem}](../devices/{stem}.json)"
    who = [[file(stem), device_name(c) + (", software" if c["device"]["fallback"] else ""), c["by"]["program"], verdict_words(c)]
           for stem, c in found.items()]
    habits = []
    for stem, c in found.items():
        h = c["habits"]
        stores = {way: short_rounding(h["half_store"][way]["rounding"]) for way in ("render", "storage")}
        weights = {"texels": weight_words(h["filter"]["texels"]), "levels": weight_words(h["filter"]["levels"])}
        habits.append([file(stem), same(stores), f"{h['srgb8_store']['render']['furthest']:.3f}", h["load"]["unorm8"], same(weights),
                       same(h["contraction"]), order_words(h["order"]), same(h["subnormals"])])
    return "\n".join([
        table(["file", "device", "run by", "passes of all small packs under `webgpu`"], who),
        table(["file", "stores to halves", "sRGB store, furthest code", "loads of 8 bits", "sampler's weights", "`a * b + c`", "order", "subnormal floats"], habits)]
        + [table(heads, rows) for heads, rows in verdicts.tables(verdicts.read(VERDICTS), found)])


def errors(found):
    """The largest error of each function: in ULP, or absolute as a power of two if the function has zeros."""
    names = list(next(iter(found.values()))["habits"]["accuracy"])
    spelled = {name: re.sub(r"^(.*?)(, (?:to|1/2) .*)?$", r"`\1`\2", name) for name in names}
    return table(["largest error of"] + list(found),
                 [[spelled[name]] + [error_words(c["habits"]["accuracy"][name]) for c in found.values()] for name in names])


def document_with(text, made):
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"{DOCUMENT}: expected one line {BEGIN.strip()} and one {END.strip()}")
    head, rest = text.split(BEGIN)
    return head + BEGIN + "\n" + made + "\n" + END + rest.split(END)[1]


# ---- typical ----

def floats(sample):
    return [struct.unpack(">f", bytes.fromhex(word))[0] for word in sample.split()]


def gap(y):
    """Between the 32-bit floats around y; the larger one at a power of two."""
    return math.ldexp(1, max(math.frexp(y)[1] - 1, -126) - 23)


def allowed(accuracy, y, x):
    part = {"ulp": 0, "ulp_per_x": 0, "relative": 0, "absolute": 0} | {k: v for k, v in accuracy.items() if k != "source"}
    # All zero: the nearest float.
    if not any(part.values()):
        return 0.5 * gap(y)
    return (part["ulp"] + part["ulp_per_x"] * abs(x)) * gap(y) + part["relative"] * abs(y) + part["absolute"]


def pow_allowed(profile, y, x, power):
    """pow as exp2(power * log2(x)), each step as the profile has it."""
    log = math.log2(x)
    off = allowed(profile["log2_near_one" if 0.5 <= x <= 2 else "log2"], log, x) if log else 0
    product = power * log
    exponent = abs(power) * off + 0.5 * gap(product)
    high = 2 ** (product + exponent)
    return max(high - y, y - 2 ** (product - exponent)) + allowed(profile["exp2"], high, product + exponent)


# Of each function: the sweep of the census, the exact value, and which part of the accuracy is asked for.
FUNCTIONS = {
    "division": ("a / b", lambda a, b: a / b, "ulp"),
    "inverse_sqrt": ("inverseSqrt(a)", lambda a: 1 / math.sqrt(a), "ulp"),
    "sqrt": ("sqrt(a)", math.sqrt, "ulp"),
    "exp": ("exp(a)", math.exp, "ulp"),
    "exp2": ("exp2(a)", lambda a: 2.0**a, "ulp"),
    "log": ("log(a)", math.log, "ulp"),
    "log_near_one": ("log(a), 1/2 to 2", math.log, "absolute"),
    "log2": ("log2(a)", math.log2, "ulp"),
    "log2_near_one": ("log2(a), 1/2 to 2", math.log2, "absolute"),
    "atan2": ("atan2(a, b)", math.atan2, "ulp"),
}
SINES = {"sin": math.sin, "cos": math.cos}


# Of each number of the profile a function (profile, habits) -> (whether the device lies inside, what it needs): texts, or (amount, unit).

def samples(habits, sweeps):
    """(arguments, what the device gave, exact value) of each worst sample."""
    for name, exact in sweeps:
        for sample in habits["accuracy"][name]["worst"]:
            *arguments, got = floats(sample)
            yield arguments, got, exact(*arguments)


def accuracy(key, sweeps, unit="ulp"):
    """How large `ulp`, or `absolute`, must be where the other parts stay."""
    def judge(profile, habits):
        others = profile[key] | {unit: 0}
        inside, need = True, 0
        for (x, *_), got, y in samples(habits, sweeps):
            error = abs(got - y) if math.isfinite(got) else math.inf
            inside &= error <= allowed(profile[key], y, x) * (1 + 1e-9)
            rest = error - (allowed(others, y, x) if any(others[k] for k in others if k != "source") else 0)
            need = max(need, rest / gap(y) if unit == "ulp" else rest)
        return inside, (need, unit)
    return judge


def sines(profile, habits, *sweeps):
    """The samples of sine and cosine, as (argument, what the device gave, exact value, whether it lies in sin_cos_domain)."""
    domain = profile["sin_cos_domain"]["value"]
    for (x,), got, y in samples(habits, [(f"{name}(a), to {to}", exact) for name, exact in SINES.items() for to in sweeps]):
        yield x, got, y, abs(x) <= domain


def near_sines(profile, habits):
    near, inside, need = profile["sin_cos"], True, 0
    for x, got, y, is_near in sines(profile, habits, "pi", "100 pi"):
        if is_near:
            error = abs(got - y) if math.isfinite(got) else math.inf
            inside &= error <= allowed(near, y, x) * (1 + 1e-9)
            need = max(need, error - allowed(near | {"absolute": 0}, y, x))
    return inside, (need, "absolute")


def beyond(profile, habits):
    """Far arguments: what holds near, its absolute part at least so much for each unit of the argument."""
    near, inside, need = profile["sin_cos"], True, 0
    for x, got, y, is_near in sines(profile, habits, "100 pi", "2^16"):
        if is_near:
            continue
        error = abs(got - y) if math.isfinite(got) else math.inf
        far = near | {"absolute": max(near.get("absolute", 0), abs(x) * profile["sin_cos_beyond"]["value"])}
        inside &= error <= allowed(far, y, x)
        need = max(need, (error - allowed(near | {"absolute": 0}, y, x)) / abs(x))
    return inside, (need, "for each unit of |x|")


def inherited_pow(profile, habits):
    worst = 0
    for (x, power), got, y in samples(habits, [("pow(a, b)", lambda a, b: a**b)]):
        error = abs(got - y) if math.isfinite(got) else math.inf
        worst = max(worst, error / pow_allowed(profile, y, x, power))
    return worst <= 1 + 1e-9, (worst, "of what its exp2 and log2 allow")


def bits(key, sweeps):
    """A weight may be so far from the share as a step of that many bits."""
    def judge(profile, habits):
        furthest = max(habits["filter"][sweep]["furthest"] for sweep in sweeps)
        return furthest <= 2.0 ** -profile[key]["value"], {weight_words(habits["filter"][sweep]) for sweep in sweeps}
    return judge


def far_texels(profile, habits):
    near, far = habits["filter"]["texels"], habits["filter"]["far_texels"]
    return far == near, {"at texel 1000 the weights of texel 0"} if far == near else {f"other weights at texel 1000: {weight_words(far)}"}


def of_stores(key, part, names):
    """What both ways of storing halves do, as the profile calls it."""
    def judge(profile, habits):
        found = {names.get(words, words) for words in (habits["half_store"][way][part] for way in ("render", "storage"))}
        value = profile[key]["value"]
        return found <= (set(names.values()) if value == "either" else {value}), found
    return judge


def half_flush(profile, habits):
    found = {habits["half_store"][way]["subnormals"] for way in ("render", "storage")}
    return found == {"kept"} or profile["half_store_flush"]["value"], found


def code_distance(key, habit):
    def judge(profile, habits):
        worst = max(way["furthest"] for way in habits[habit].values())
        return worst <= max(0.5, profile[key]["value"]) + 1e-6, (worst, "codes")
    return judge


def basic(profile, habits):
    off = sum(habits["rounding"].values())
    return off == 0 or profile["basic"]["value"] == "either", {"to nearest" if off == 0 else "not to nearest"}


def contraction(profile, habits):
    found = set(habits["contraction"].values())
    return found == {"separate"} or profile["contraction"]["value"], found


def flush(profile, habits):
    found = set(habits["subnormals"].values())
    return {"may": True, "never": found == {"kept"}, "must": found == {"flushed to zero"}}[profile["flush"]["value"]], found


def unorm_load(profile, habits):
    off = habits["load"]["unorm8_ulp"]
    return off <= profile["unorm_load"].get("ulp", 0), (off, "ulp from the nearest float")


MEASURED = {
    "basic": basic, "contraction": contraction, "flush": flush,
    **{key: accuracy(key, [(sweep, exact)], unit) for key, (sweep, exact, unit) in FUNCTIONS.items()},
    "pow_is_inherited": inherited_pow,
    "sin_cos": near_sines,
    "sin_cos_beyond": beyond,
    "subtexel_bits": bits("subtexel_bits", ["texels", "product"]), "coordinate_bits": far_texels, "lod_bits": bits("lod_bits", ["levels"]),
    "unorm_load": unorm_load,
    "half_store": of_stores("half_store", "rounding", {"to nearest, ties to even": "rne", "toward zero": "rtz"}),
    # What profiles allow is said of values below 2^16; beyond, WGSL promises nothing.
    "half_overflow": of_stores("half_overflow", "overflow", {"infinity": "inf", "the largest half": "max"}),
    "half_store_flush": half_flush,
    "unorm_store_ulp": code_distance("unorm_store_ulp", "unorm8_store"), "srgb_store_ulp": code_distance("srgb_store_ulp", "srgb8_store"),
}
# What is measured with another number.
WITH_OTHERS = {"sin_cos_domain": "where sin_cos ends and sin_cos_beyond begins"}


def allowed_words(entry):
    if "value" in entry:
        return str(entry["value"]).lower() if isinstance(entry["value"], bool) else str(entry["value"])
    return " + ".join(f"{entry[k]:g} {k}" for k in ("ulp", "ulp_per_x", "relative", "absolute") if k in entry)


def need_words(need):
    return f"{need[0]:.3g} {need[1]}" if isinstance(need, tuple) else " and ".join(sorted(need))


def widest(needs):
    """What holds all of them."""
    return max(needs) if isinstance(needs[0], tuple) else set().union(*needs)


def typical(found, profile, known):
    """(lines, whether nothing unknown lies outside)."""
    gpus = [stem for stem, census in found.items() if not census["device"]["fallback"]]
    lines, good = [f"{len(found)} files, {len(gpus)} of GPUs, the others of software devices"], True
    for key, entry in profile.items():
        if key in ("name", "reference", "about", "known_outside"):
            continue
        lines.append(f"{key} = {allowed_words(entry)}")
        if key not in MEASURED:
            lines.append(f"  {WITH_OTHERS.get(key, 'no device file supports it')}")
            continue
        verdicts = {stem: MEASURED[key](profile, census["habits"]) for stem, census in found.items()}
        for stems, words in ((gpus, f"{len(gpus)} GPUs"), (list(found), f"all {len(found)}")):
            if stems:
                lines.append(f"  {words}: {need_words(widest([verdicts[stem][1] for stem in stems]))}")
        for stem, (inside, need) in verdicts.items():
            is_known = (stem, key) in known
            good &= inside != is_known
            if is_known or not inside:
                mark = "inside, but listed as outside" if inside else "outside, as known" if is_known else "OUTSIDE"
                lines.append(f"  {stem}: {need_words(need)}: {mark}")
    for stem, key in sorted(known):
        if stem not in found or key not in MEASURED:
            lines.append(f"known: no device {stem} or no number {key}")
            good = False
    return lines, good


def main(arguments):
    verb = arguments[0] if arguments else ""
    if len(arguments) != 1 or verb not in ("table", "write", "typical"):
        sys.exit("usage: scripts/devices.py table|write|typical")
    found = devices(ROOT / "docs/devices")
    if verb == "table":
        print(tables(found), errors(found), sep="\n", end="")
    elif verb == "write":
        DOCUMENT.write_text(document_with(DOCUMENT.read_text(), tables(found)))
        wrong = verdicts.faults(verdicts.read(VERDICTS))
        print("\n".join(wrong), end="\n" if wrong else "")
        sys.exit(1 if wrong else 0)
    else:
        lines, good = typical(found, tomllib.loads((ROOT / "src/judge/profiles/typical.toml").read_text()), KNOWN)
        print("\n".join(lines))
        sys.exit(0 if good else 1)


if __name__ == "__main__":
    main(sys.argv[1:])
