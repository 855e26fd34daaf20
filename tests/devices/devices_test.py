"""The census of devices: the document's tables are what scripts/devices.py makes, `typical` is not narrower than a device that is not known to lie
outside, and a device that lies outside in any one number is found."""
import copy
import importlib.util
import pathlib
import struct
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEC = importlib.util.spec_from_file_location("devices", ROOT / "scripts/devices.py")
devices = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(devices)

PROFILE = tomllib.loads((ROOT / "src/judge/profiles/typical.toml").read_text())
FOUND = devices.devices(ROOT / "docs/devices")


def moved(sample, ulp):
    """A sample "a b result" whose result is some floats further off."""
    words = sample.split()
    value = struct.unpack(">f", bytes.fromhex(words[-1]))[0]
    return " ".join([*words[:-1], struct.pack(">f", value + ulp * devices.gap(value)).hex()])


def ideal():
    """A device that does what `typical` says, made from the first file."""
    census = copy.deepcopy(next(iter(FOUND.values())))
    habits = census["habits"]
    for key, (sweeps, exact) in devices.FUNCTIONS.items():
        for sweep in sweeps:
            habits["accuracy"][sweep]["worst"] = [rounded(sample, exact) for sample in habits["accuracy"][sweep]["worst"]]
    for function, exact in devices.SINES.items():
        for to in ("pi", "100 pi", "2^16"):
            entry = habits["accuracy"][f"{function}(a), to {to}"]
            entry["worst"] = [rounded(sample, exact) for sample in entry["worst"]]
    habits["load"]["unorm8_ulp"] = 0
    return census


def rounded(sample, exact):
    words = sample.split()[:-1]
    return " ".join([*words, struct.pack(">f", exact(*devices.floats(" ".join(words)))).hex()])


class Devices(unittest.TestCase):
    def outside(self, census):
        """The numbers in which this device lies outside."""
        return {key for key, judge in devices.MEASURED.items() if not judge(PROFILE, census["habits"])[0]}

    def test_document(self):
        text = devices.DOCUMENT.read_text()
        self.assertEqual(text, devices.document_with(text, devices.tables(FOUND)), "scripts/devices.py write mends it")

    def test_typical_is_not_narrower(self):
        lines, good = devices.typical(FOUND, PROFILE, devices.KNOWN)
        self.assertTrue(good, "\n".join(lines))

    def test_every_number_is_listed(self):
        listed = "\n".join(devices.typical(FOUND, PROFILE, devices.KNOWN)[0])
        for key in PROFILE:
            if key not in ("name", "reference"):
                self.assertIn(f"\n{key} = ", listed)

    def test_ideal_device_is_inside(self):
        self.assertEqual(self.outside(ideal()), set())

    def test_each_number_finds_a_device_outside(self):
        def changed(change):
            census = ideal()
            change(census["habits"])
            return self.outside(census)

        def with_error(sweep, error):
            def change(habits):
                entry = habits["accuracy"][sweep]
                entry["worst"] = [moved(sample, error) for sample in entry["worst"]]
            return changed(change)

        for key, (sweeps, _) in devices.FUNCTIONS.items():
            self.assertEqual(with_error(sweeps[0], 2**20 if "near_one" in key or key == "pow_is_inherited" else 200), {key})
        for sweep in ("sin(a), to pi", "cos(a), to 100 pi"):
            self.assertEqual(with_error(sweep, 2**12), {"sin_cos"})
        self.assertEqual(with_error("sin(a), to 2^16", 2**20), {"sin_cos_beyond"})

        def put(*path):
            def change(habits):
                for key in path[:-2]:
                    habits = habits[key]
                habits[path[-2]] = path[-1]
            return changed(change)
        self.assertEqual(put("rounding", "a + b", 3), {"basic"})
        self.assertEqual(put("filter", "texels", {"bits": 6, "rounding": "cut", "furthest": 2**-6}), {"subtexel_bits", "coordinate_bits"})
        self.assertEqual(put("filter", "product", "furthest", 2**-7), {"subtexel_bits"})
        self.assertEqual(put("filter", "levels", {"bits": 5, "rounding": "cut", "furthest": 2**-5}), {"lod_bits"})
        self.assertEqual(put("load", "unorm8_ulp", 1), {"unorm_load"})
        self.assertEqual(put("half_store", "render", "rounding", "up"), {"half_store"})
        self.assertEqual(put("half_store", "storage", "overflow", "NaN"), {"half_overflow"})
        self.assertEqual(put("half_store", "render", "subnormals", "flushed to zero"), {"half_store_flush"})
        self.assertEqual(put("unorm8_store", "storage", "furthest", 0.99), {"unorm_store_ulp"})
        self.assertEqual(put("srgb8_store", "render", "furthest", 0.7), {"srgb_store_ulp"})
        # The profile allows all of what these ask; a narrower one does not.
        fused = ideal()
        fused["habits"]["contraction"]["a * b + c"] = "fused"
        self.assertFalse(devices.contraction(PROFILE | {"contraction": {"value": False}}, fused["habits"])[0])
        self.assertFalse(devices.flush(PROFILE | {"flush": {"value": "never"}}, fused["habits"])[0])

    def test_known_must_lie_outside(self):
        (stem, key), *_ = devices.KNOWN
        mended = FOUND | {stem: ideal()}
        lines, good = devices.typical(mended, PROFILE, devices.KNOWN)
        self.assertFalse(good)
        self.assertIn("inside, but listed as outside", "\n".join(lines))
        self.assertFalse(devices.typical(FOUND, PROFILE, {})[1])
        self.assertFalse(devices.typical(FOUND, PROFILE, devices.KNOWN | {("no such file", "exp2"): ""})[1])


if __name__ == "__main__":
    unittest.main()
