"""scripts/pictures.py finds what is stale: beside a program that writes known pictures, each thing that may go wrong with one is named."""
import contextlib
import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest
import zlib

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
SPEC = importlib.util.spec_from_file_location("pictures", SCRIPTS / "pictures.py")
pictures = importlib.util.module_from_spec(SPEC)
sys.modules["pictures"] = pictures
SPEC.loader.exec_module(pictures)

# It writes the picture that the file "now" beside it describes: a hash and a scene; at the small size another hash.
PROGRAM = """#!{python} -B
import pathlib, sys
sys.path.insert(0, "{tests}")
import pictures_test
here, words = pathlib.Path(__file__).parent, sys.argv
shown, scene = (here / "now").read_text().split("|")
size = words[words.index("--size") + 1] if "--size" in words else "1280x720"
folder = pathlib.Path(words[words.index("-o") + 1])
folder.mkdir(parents=True)
small = size == pictures_test.pictures.SMALL["--size"]
(folder / "puddle.0001.png").write_bytes(pictures_test.png(shown + "small" * small, f"run.size = {{size}}\\n{{scene}}"))
"""


def png(shown, scene):
    """A PNG of texts alone."""
    def chunk(kind, content):
        return len(content).to_bytes(4, "big") + kind + content + zlib.crc32(kind + content).to_bytes(4, "big")
    return b"\x89PNG\r\n\x1a\n" + chunk(b"tEXt", b"rainref:picture_hash\0" + shown.encode()) + chunk(b"tEXt", b"rainref:scene\0" + scene.encode())


class Check(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name).resolve()
        for folder in ("docs/images", "docs/gallery"):
            (self.root / folder).mkdir(parents=True)
        (self.root / "README.md").write_text("![a](docs/images/a.png)\n")
        (self.root / "docs/pictures.txt").write_text("# Head\ndocs/images/a.png - - - rainref run scenes/a.toml --size 8x8\n")
        self.program = self.root / "program"
        self.program.write_text(PROGRAM.format(python=sys.executable, tests=pathlib.Path(__file__).resolve().parent))
        self.program.chmod(0o755)
        pictures.ROOT, pictures.LIST = self.root, self.root / "docs/pictures.txt"
        self.now("first", "rain.rate = 1")
        listed = pictures.read_list()
        pictures.make(self.program, listed["docs/images/a.png"], has_small=True)
        pictures.write_list(listed)

    def now(self, shown, scene):
        (self.root / "now").write_text(f"{shown}|{scene}")

    def said(self, is_whole=False):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            failed = pictures.check(self.program, is_whole)
        self.assertEqual(failed, bool(out.getvalue()))
        return out.getvalue()

    def test_what_was_just_made_is_good(self):
        self.assertEqual(self.said() + self.said(is_whole=True), "")
        self.assertTrue(pictures.LIST.read_text().startswith("# Head\ndocs/images/a.png "))

    def test_other_bits_are_stale_at_both_sizes(self):
        self.now("second", "rain.rate = 1")
        self.assertIn("a.png: is stale: its command at a small size gives secondsmall, it gave firstsmall", self.said())
        self.assertIn("a.png: is stale: its command gives second, it gave first", self.said(is_whole=True))

    def test_another_scene_is_said(self):
        self.now("first", "rain.rate = 2")
        self.assertIn("a.png: was made of another scene than its command names now", self.said())

    def test_a_file_from_elsewhere_is_said(self):
        (self.root / "docs/images/a.png").write_bytes(png("other", "run.size = 8x8\nrain.rate = 1"))
        self.assertIn("a.png: is another file than scripts/gallery wrote", self.said())
        self.assertIn("a.png: holds the note of another picture: other for first", self.said())
        (self.root / "docs/images/a.png").unlink()
        self.assertIn("a.png: is missing", self.said())

    def test_each_picture_has_one_line_and_is_shown(self):
        (self.root / "docs/gallery/b.jpg").write_bytes(b"b")
        (self.root / "README.md").write_text("")
        self.assertIn("docs/gallery/b.jpg: is shown, but docs/pictures.txt has no line of it", self.said())
        (self.root / "docs/images/a.png").unlink()
        self.assertIn("docs/images/a.png: has a line in docs/pictures.txt, but no document shows it", self.said())


if __name__ == "__main__":
    unittest.main()
