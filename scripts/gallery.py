"""docs/gallery, for scripts/gallery: gallery.py PROGRAM [SCENE...]. What a scene differs in from the defaults is read from its picture,
where the program has written it."""
import pathlib
import re
import subprocess
import sys
import tomllib
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
GALLERY = ROOT / "docs/gallery"
WIDTH, QUALITY = 640, 4  # of the pictures: pixels; ffmpeg's -q:v of JPEG, 2 (best) to 31
COLUMNS, TILE = 6, (240, 135)  # of the sheet
# Frames to show where a scene's last one is not the best, or takes long: a drive in full rain, a wiper in the middle of its stroke, glass
# that was under a bridge for half a second.
FRAMES = {"gallery/drive": 613, "windshield/bridge": 120, "windshield/drive": 160, "windshield/stress": 60}
EFFECTS = ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"]


def scenes():
    """Names such as puddle/default, those made to be looked at first."""
    found = [p.relative_to(ROOT / "scenes").with_suffix("").as_posix() for p in (ROOT / "scenes").rglob("*.toml")]
    return sorted(found, key=lambda name: (["gallery", *EFFECTS].index(name.split("/")[0]), name))


def sentence(name):
    """What the scene file says of itself in its first lines."""
    lines = []
    for line in (ROOT / f"scenes/{name}.toml").read_text().splitlines():
        if not line.startswith("#") or line.startswith("#   "):
            break
        lines.append(line.lstrip("# "))
    text = " ".join(lines)
    return re.split(r" As a film:", text)[0]


def command(name):
    frames = tomllib.loads((ROOT / f"scenes/{name}.toml").read_text())["run"].get("frames", 60)
    shown = FRAMES.get(name, frames)
    words = ["rainref", "run", f"scenes/{name}.toml"]
    if shown != frames:
        words += ["--frames", str(shown)]
    if shown > 1:
        words += ["--first", str(shown - 1)]
    return words


def png_texts(path):
    """keyword: text of a PNG's tEXt and iTXt chunks that are not compressed."""
    data, at, texts = path.read_bytes(), 8, {}
    while at < len(data):
        size = int.from_bytes(data[at:at + 4], "big")
        kind, content = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        if kind in (b"tEXt", b"iTXt"):
            if zlib.crc32(kind + content) != int.from_bytes(data[at + 8 + size:at + 12 + size], "big"):
                sys.exit(f"{path}: a damaged text")
            keyword, rest = content.split(b"\0", 1)
            if kind == b"iTXt":
                rest = rest[2:].split(b"\0", 2)[2]
            texts[keyword.decode()] = rest.decode("utf-8" if kind == b"iTXt" else "latin-1")
        at += 12 + size
    return texts


def ffmpeg(*words):
    subprocess.run(["ffmpeg", "-nostdin", "-loglevel", "error", "-y", *map(str, words)], check=True)


def picture_of(name):
    return GALLERY / (name.replace("/", "_") + ".jpg")


def render(program, name, folder):
    """Its JPEG, and beside it what the page says of its parameters: the scene in the picture, for later runs too."""
    out = folder / name
    words = [program, *command(name)[1:], "-o", out, "--overwrite"]
    subprocess.run(words, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    newest = max(out.glob("*.png"), key=lambda p: p.stat().st_mtime)
    ffmpeg("-i", newest, "-vf", f"scale={WIDTH}:-2:flags=area+accurate_rnd+full_chroma_int", "-q:v", QUALITY, "-map_metadata", "-1",
           "-fflags", "+bitexact", "-flags:v", "+bitexact", picture_of(name))
    return png_texts(newest)["rainref:scene"]


def parameters(scene):
    """Those of the effect, without what every scene says."""
    return [line for line in scene.splitlines() if not line.startswith(("effect = ", "run.frames = "))]


def section(name, scene):
    return "\n".join([
        f"### {name}", "", f"![{name}]({picture_of(name).name})", "", sentence(name), "", "```toml", *parameters(scene), "```", "```sh",
        " ".join(command(name)), "```", ""])


def known_sections():
    """Those of the page as it stands."""
    page = GALLERY / "README.md"
    if not page.exists():
        return {}
    parts = re.split(r"(?m)^### ", page.read_text())[1:]
    return {part.split("\n", 1)[0]: re.search(r"```toml\n(.*?)```", part, re.S).group(1) for part in parts}


def main():
    program, wanted = sys.argv[1], sys.argv[2:]
    names = scenes()
    for name in wanted:
        if name not in names:
            sys.exit(f"{name}: expected one of {', '.join(names)}")
    GALLERY.mkdir(exist_ok=True)
    texts = known_sections()
    folder = ROOT / "out/gallery_page"
    for name in names:
        if wanted and name not in wanted and name in texts and picture_of(name).exists():
            continue
        print(f"Rendering {name}", file=sys.stderr, flush=True)
        texts[name] = render(program, name, folder)
    for old in GALLERY.glob("*.jpg"):
        if old.name != "sheet.jpg" and old not in [picture_of(name) for name in names]:
            old.unlink()
    sources = [word for name in names for word in ("-i", picture_of(name))]
    width, height = TILE
    tiles = "".join(f"[{k}:v]scale={width}:{height}:force_original_aspect_ratio=decrease:flags=area,pad={width}:{height}:(ow-iw)/2:(oh-ih)/2,"
                    f"setsar=1[t{k}];" for k in range(len(names)))
    joined = "".join(f"[t{k}]" for k in range(len(names))) + f"concat=n={len(names)}:v=1,tile={COLUMNS}x{-(-len(names) // COLUMNS)}"
    ffmpeg(*sources, "-filter_complex", tiles + joined, "-frames:v", 1, "-q:v", QUALITY, "-map_metadata", "-1", "-fflags", "+bitexact",
           "-flags:v", "+bitexact", GALLERY / "sheet.jpg")
    page = ["# Gallery", "", "<!-- scripts/gallery writes this page. -->", "",
            f"Every scene of [scenes](../../scenes), {WIDTH} pixels wide: its picture, what it says of itself, its keys that are not as by default "
            "(`rainref describe EFFECT`), and the command that makes the picture in its own size. `--first` only saves time. Made by "
            "`scripts/gallery`.", "", "![All of them](sheet.jpg)", ""]
    group = ""
    for name in names:
        if name.split("/")[0] != group:
            group = name.split("/")[0]
            page += [f"## {'To be looked at' if group == 'gallery' else group}", ""]
        page.append(section(name, texts[name]))
    (GALLERY / "README.md").write_text("\n".join(page).rstrip() + "\n")
    total = sum(p.stat().st_size for p in GALLERY.iterdir())
    print(f"{len(names)} scenes, {total / 1e6:.1f} MB in docs/gallery", file=sys.stderr)


if __name__ == "__main__":
    main()
