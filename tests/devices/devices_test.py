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
    for sweep, exact, _ in [*devices.FUNCTIONS.values(), ("pow(a, b)", pow, "")]:
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

    def test_ports_that_compute_nothing_fail(self):
        self.assertEqual(devices.verdicts.faults(devices.verdicts.read(devices.VERDICTS)), [])

    def test_one_that_does_not_fail_is_found(self):
        found = copy.deepcopy(devices.verdicts.read(devices.VERDICTS))
        del found["noise"]
        found["zeros"]["packs"][0]["verdicts"]["display"] = "UNTESTED"
        pack = found["zeros"]["packs"][0]["pack"]
        self.assertEqual(devices.verdicts.faults(found), ["noise: no such file", f"zeros: {pack} display: UNTESTED"])

    def test_a_pack_that_has_changed_is_left_out(self):
        census = {"ports": [{"pack": "a-b", "verdicts": {"PASS": 1, "WARN": 1}, "others": [{"pass": "y", "status": "WARN"}]}]}
        self.assertEqual(devices.verdicts.of_census(census, {"a-b": ["x", "y"]}), [("a", "x", "PASS"), ("a", "y", "WARN")])
        self.assertEqual(devices.verdicts.of_census(census, {"a-b": ["x", "y", "z"]}), [])

    def test_typical_is_not_narrower(self):
        lines, good = devices.typical(FOUND, PROFILE, devices.KNOWN)
        self.assertTrue(good, "\n".join(lines))

    def test_words_of_reports(self):
        """A WARN names the devices of the census that lie outside, and in what."""
        self.assertEqual(PROFILE["known_outside"], devices.known_words())

    def test_coarsest_holds_every_device(self):
        """What fails for lying outside `coarsest` is done by no device of the census, without exceptions."""
        lines, good = devices.typical(FOUND, tomllib.loads((ROOT / "src/judge/profiles/coarsest.toml").read_text()), set())
        self.assertTrue(good, "\n".join(lines))

    def test_every_number_is_listed(self):
        listed = "\n".join(devices.typical(FOUND, PROFILE, devices.KNOWN)[0])
        for key in PROFILE:
            if key not in ("name", "reference", "about", "known_outside"):
                self.assertIn(f"\n{key} = ", listed)

    def test_derived_numbers(self):
        """What a device needs is measured as it was put in; of several devices the widest counts."""
        lines = devices.typical({"a": ideal(), "b": self.off()}, PROFILE, set())[0]
        at = lines.index("sqrt = 1 ulp")
        self.assertEqual(lines[at + 1:at + 3], ["  all 2: 3.5 ulp", "  b: 3.5 ulp: OUTSIDE"])
        self.assertEqual(lines[lines.index("half_store = either") + 1], "  all 2: rne and rtz")

    @staticmethod
    def off():
        census = ideal()
        # The float 3 above one that is half a gap above the exact value.
        x = struct.unpack(">f", bytes.fromhex("3f800001"))[0]
        up = struct.pack(">f", x + 3.5 * 2**-23 - x * 2**-23 / 2).hex()
        census["habits"]["accuracy"]["sqrt(a)"]["worst"] = [f"3f800001 {up}"]
        census["habits"]["half_store"]["render"]["rounding"] = "toward zero"
        return census

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

        for key, (sweep, _, _) in devices.FUNCTIONS.items():
            self.assertEqual(with_error(sweep, 2**20 if "near_one" in key else 200), {key})
        self.assertEqual(with_error("pow(a, b)", 2**20), {"pow_is_inherited"})
        for sweep in ("sin(a), to pi", "cos(a), to pi"):
            self.assertEqual(with_error(sweep, 2**12), {"sin_cos"})
        for sweep in ("cos(a), to 100 pi", "sin(a), to 2^16"):
            self.assertEqual(with_error(sweep, 2**20), {"sin_cos_beyond"})

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
        stem = next(iter(devices.KNOWN))[0]
        mended = FOUND | {stem: ideal()}
        lines, good = devices.typical(mended, PROFILE, devices.KNOWN)
        self.assertFalse(good)
        self.assertIn("inside, but listed as outside", "\n".join(lines))
        self.assertFalse(devices.typical(FOUND, PROFILE, set())[1])
        self.assertFalse(devices.typical(FOUND, PROFILE, devices.KNOWN | {("no such file", "exp2")})[1])


if __name__ == "__main__":
    unittest.main()
