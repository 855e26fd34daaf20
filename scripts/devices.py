#!/usr/bin/python3
"""What the files of docs/devices say together (src/web/pages/census.html and examples/ports/wgsl/census.mjs make them).

scripts/devices.py table     the tables of docs/notes/devices.md
scripts/devices.py write     puts them there
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
DOCUMENT = ROOT / "docs/notes/devices.md"
BEGIN, END = "<!-- scripts/devices.py write -->\n", "<!-- end of scripts/devices.py write -->\n"

# What lies outside `typical`, which says what GPUs do: software devices are coarser. {(file, number of the profile): what it does}
SWIFTSHADER = {
    "exp2": "off by 2.9 ULP", "log_near_one": "off by 2^-22.5", "log2_near_one": "off by 2^-22", "pow_is_inherited": "as its exp2 and log2",
    "sin_cos": "off by 2^-12.3", "sin_cos_beyond": "the same near 2^9", "unorm_load": "off by 1 ULP",
}
LAVAPIPE = {
    "exp2": "off by 2.9 ULP", "log_near_one": "off by 2^-22.9", "log2_near_one": "off by 2^-22.5", "pow_is_inherited": "as its exp2 and log2",
    "atan2": "off by 1.6e-7 where the angle is small", "unorm_load": "off by 1 ULP", "srgb_store_ulp": "a coarser curve",
}
KNOWN = {(stem, key): reason for stems, outside in [(("chromium-swiftshader", "node-swiftshader"), SWIFTSHADER), (("firefox-lavapipe",), LAVAPIPE)]
         for stem in stems for key, reason in outside.items()}


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
    names = list(next(iter(found.values()))["habits"]["accuracy"])
    spelled = {name: re.sub(r"^(.*?)(, (?:to|1/2) .*)?$", r"`\1`\2", name) for name in names}
    errors = [[spelled[name]] + [error_words(c["habits"]["accuracy"][name]) for c in found.values()] for name in names]
    return "\n".join([
        table(["file", "device", "run by", "passes of all small packs under `webgpu`"], who),
        table(["file", "stores to halves", "sRGB store, furthest code", "loads of 8 bits", "sampler's weights", "`a * b + c`", "order", "subnormal floats"], habits),
        "Largest errors, in ULP, or absolute as a power of two where the function has zeros:\n",
        table(["function"] + [f"{stem}" for stem in found], errors)])


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


# Of each function: the sweeps of the census, the exact value.
FUNCTIONS = {
    "division": (["a / b"], lambda a, b: a / b),
    "inverse_sqrt": (["inverseSqrt(a)"], lambda a: 1 / math.sqrt(a)),
    "sqrt": (["sqrt(a)"], math.sqrt),
    "exp": (["exp(a)"], math.exp),
    "exp2": (["exp2(a)"], lambda a: 2.0**a),
    "log": (["log(a)"], math.log),
    "log_near_one": (["log(a), 1/2 to 2"], math.log),
    "log2": (["log2(a)"], math.log2),
    "log2_near_one": (["log2(a), 1/2 to 2"], math.log2),
    "atan2": (["atan2(a, b)"], math.atan2),
    "pow_is_inherited": (["pow(a, b)"], lambda a, b: a**b),
}
SINES = {"sin": math.sin, "cos": math.cos}


def function_share(profile, key, habits):
    """The largest error, as a share of what the profile allows there."""
    sweeps = [(name, exact) for name, exact in ([(n, FUNCTIONS[key][1]) for n in FUNCTIONS[key][0]] if key in FUNCTIONS else
              [(f"{f}(a), to {to}", SINES[f]) for f in SINES for to in ("pi", "100 pi")])]
    worst = 0
    for name, exact in sweeps:
        for sample in habits["accuracy"][name]["worst"]:
            *arguments, got = floats(sample)
            y = exact(*arguments)
            error = abs(got - y) if math.isfinite(got) else math.inf
            room = pow_allowed(profile, y, *arguments) if key == "pow_is_inherited" else allowed(profile[key], y, arguments[0])
            worst = max(worst, error / room)
    return worst


def share(key):
    def judge(profile, habits):
        worst = function_share(profile, key, habits)
        return worst <= 1 + 1e-9, f"{worst:.2f} of what is allowed"
    return judge


def beyond(profile, habits):
    """Far arguments: what holds near, its absolute part at least so much for each unit of the argument."""
    near = profile["sin_cos"]
    worst = 0
    for name, exact in SINES.items():
        for sample in habits["accuracy"][f"{name}(a), to 2^16"]["worst"]:
            x, got = floats(sample)
            error = abs(got - exact(x)) if math.isfinite(got) else math.inf
            far = near | {"absolute": max(near.get("absolute", 0), abs(x) * profile["sin_cos_beyond"]["value"])}
            worst = max(worst, error / allowed(far, exact(x), x))
    return worst <= 1, f"{worst:.2f} of what is allowed"


def bits(key, sweeps):
    def judge(profile, habits):
        step = 2.0 ** -profile[key]["value"]
        worst = max(habits["filter"][sweep]["furthest"] for sweep in sweeps)
        return worst <= step, f"{' and '.join(dict.fromkeys(weight_words(habits['filter'][s]) for s in sweeps))}, at most 2^{math.log2(worst):.1f} off" if worst else "exact"
    return judge


def far_texels(profile, habits):
    near, far = habits["filter"]["texels"], habits["filter"]["far_texels"]
    return far == near, "the same weights at texel 1000 as at texel 0" if far == near else f"other weights at texel 1000: {weight_words(far)}"


def half_store(profile, habits):
    names = {"to nearest, ties to even": "rne", "toward zero": "rtz"}
    found = {names.get(habits["half_store"][way]["rounding"], habits["half_store"][way]["rounding"]) for way in ("render", "storage")}
    value = profile["half_store"]["value"]
    return found <= ({"rne", "rtz"} if value == "either" else {value}), " and ".join(sorted(found))


def half_overflow(profile, habits):
    # What profiles allow is said of values below 2^16; beyond, WGSL promises nothing.
    names = {"infinity": "inf", "the largest half": "max"}
    found = {names.get(habits["half_store"][way]["overflow"], habits["half_store"][way]["overflow"]) for way in ("render", "storage")}
    value = profile["half_overflow"]["value"]
    return found <= ({"inf", "max"} if value == "either" else {value}), " and ".join(sorted(found))


def half_flush(profile, habits):
    found = {habits["half_store"][way]["subnormals"] for way in ("render", "storage")}
    return found == {"kept"} or profile["half_store_flush"]["value"], " and ".join(sorted(found))


def code_distance(key, habit):
    def judge(profile, habits):
        worst = max(way["furthest"] for way in habits[habit].values())
        return worst <= max(0.5, profile[key]["value"]) + 1e-6, f"{worst:.3f} codes"
    return judge


def basic(profile, habits):
    off = sum(habits["rounding"].values())
    return off == 0 or profile["basic"]["value"] == "either", "to nearest" if off == 0 else f"{off} of {3 * 4096} not to nearest"


def contraction(profile, habits):
    found = set(habits["contraction"].values())
    return found == {"separate"} or profile["contraction"]["value"], " and ".join(sorted(found))


def flush(profile, habits):
    found = set(habits["subnormals"].values())
    value = profile["flush"]["value"]
    return {"may": True, "never": found == {"kept"}, "must": found == {"flushed to zero"}}[value], " and ".join(sorted(found))


def unorm_load(profile, habits):
    off = habits["load"]["unorm8_ulp"]
    part = profile["unorm_load"]
    return off <= part.get("ulp", 0), "the nearest float" if off == 0 else f"{off:g} ULP from the nearest float"


MEASURED = {
    "basic": basic, "contraction": contraction, "flush": flush,
    **{key: share(key) for key in [*FUNCTIONS, "sin_cos"]},
    "sin_cos_beyond": beyond, "subtexel_bits": bits("subtexel_bits", ["texels", "product"]), "coordinate_bits": far_texels, "lod_bits": bits("lod_bits", ["levels"]),
    "unorm_load": unorm_load, "half_store": half_store, "half_overflow": half_overflow, "half_store_flush": half_flush,
    "unorm_store_ulp": code_distance("unorm_store_ulp", "unorm8_store"), "srgb_store_ulp": code_distance("srgb_store_ulp", "srgb8_store"),
}
# What is measured with another number.
WITH_OTHERS = {"sin_cos_domain": "measured up to 314, with sin_cos"}


def allowed_words(entry):
    if "value" in entry:
        return str(entry["value"]).lower() if isinstance(entry["value"], bool) else str(entry["value"])
    return " + ".join(f"{entry[k]:g} {k}" for k in ("ulp", "ulp_per_x", "relative", "absolute") if k in entry)


def typical(found, profile, known):
    """(lines, whether nothing unknown lies outside)."""
    lines, good = [], True
    software = sum(c["device"]["fallback"] for c in found.values())
    lines.append(f"{len(found)} files, {software} of them of software devices")
    for key, entry in profile.items():
        if key in ("name", "reference"):
            continue
        if key not in MEASURED:
            lines.append(f"{key} = {allowed_words(entry)}: {WITH_OTHERS.get(key, 'no device file supports it')}")
            continue
        lines.append(f"{key} = {allowed_words(entry)}, from {len(found)} devices")
        for stem, census in found.items():
            inside, words = MEASURED[key](profile, census["habits"])
            reason = known.get((stem, key))
            good &= inside == (reason is None)
            mark = "inside" if inside and reason is None else f"OUTSIDE, known: {reason}" if reason and not inside else \
                   "OUTSIDE" if not inside else "inside, but listed as outside"
            lines.append(f"  {stem}: {words}: {mark}")
    for stem, key in known:
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
        print(tables(found), end="")
    elif verb == "write":
        DOCUMENT.write_text(document_with(DOCUMENT.read_text(), tables(found)))
    else:
        lines, good = typical(found, tomllib.loads((ROOT / "src/judge/profiles/typical.toml").read_text()), KNOWN)
        print("\n".join(lines))
        sys.exit(0 if good else 1)


if __name__ == "__main__":
    main(sys.argv[1:])
