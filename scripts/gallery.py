"""docs/gallery and docs/images, for scripts/gallery: gallery.py PROGRAM [--check | --check-all | --page | SCENE or FILE...]. What a scene
differs in from the defaults is read from its picture, where the program has written it."""
import dataclasses
import re
import sys
import tomllib

import pictures
from pictures import ROOT

GALLERY = ROOT / "docs/gallery"
SHEET = GALLERY / "sheet.jpg"
KEYS = ROOT / "docs/gallery.toml"  # what each picture shows: a table for each scene
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


def picture_of(name):
    return GALLERY / (name.replace("/", "_") + ".jpg")


def line_of(name, listed):
    """Its line of docs/pictures.txt, with the command of today."""
    file = picture_of(name).relative_to(ROOT).as_posix()
    known = listed.get(file, pictures.Picture(file, pictures.NONE, pictures.NONE, pictures.NONE, ""))
    return dataclasses.replace(known, command=" ".join(command(name)))


def values_of(table, prefix=""):
    """{"vehicle.drive_cycle": value} of a TOML table."""
    found = {}
    for key, value in table.items():
        found |= values_of(value, f"{prefix}{key}.") if isinstance(value, dict) else {prefix + key: value}
    return found


def parameters(name, scene):
    """A picture's scene as docs/gallery.toml holds it: to be pasted into a file at the root of the sources, so files are named from there."""
    path = ROOT / f"scenes/{name}.toml"
    own = values_of(tomllib.loads(path.read_text()))
    lines = [f'effect = "{own["effect"]}"']
    for line in scene.splitlines():
        key, value = line.split(" = ", 1)
        file = own.get(key)
        if isinstance(file, str) and file and (path.parent / file).is_file():
            value = f'"{(path.parent / file).resolve().relative_to(ROOT).as_posix()}"'
        if key not in ("effect", "run.frames"):
            lines.append(f"{key} = {value}")
    return lines


def section(name):
    return "\n".join([
        f"### {name}", "", f"[![{name}]({picture_of(name).name})](../../scenes/{name}.toml)", "", sentence(name), "", "```sh",
        " ".join(command(name)), "```", ""])


def known_scenes():
    """{name: its keys}, as docs/gallery.toml stands."""
    if not KEYS.exists():
        return {}
    parts = re.split(r'(?m)^\["(.*)"\]\n', KEYS.read_text())
    return dict(zip(parts[1::2], parts[2::2]))


def write_keys(names, texts):
    head = "# What differs from the defaults in the picture of each scene in docs/gallery. Written by scripts/gallery; a test compares it with the scenes.\n"
    tables = ["\n".join([f'["{name}"]', *parameters(name, texts[name].strip()), ""]) for name in names]
    KEYS.write_text(head + "\n" + "\n".join(tables))


def write_sheet(names):
    sources = [word for name in names for word in ("-i", picture_of(name))]
    width, height = TILE
    tiles = "".join(f"[{k}:v]scale={width}:{height}:force_original_aspect_ratio=decrease:flags=area,pad={width}:{height}:(ow-iw)/2:(oh-ih)/2,"
                    f"setsar=1[t{k}];" for k in range(len(names)))
    joined = "".join(f"[t{k}]" for k in range(len(names))) + f"concat=n={len(names)}:v=1,tile={COLUMNS}x{-(-len(names) // COLUMNS)}"
    pictures.ffmpeg(*sources, *pictures.exact("-filter_complex", tiles + joined, "-frames:v", 1), SHEET)


def write_page(names):
    page = ["# Gallery", "", "<!-- scripts/gallery writes this page. -->", "",
            "For anyone who looks for a scene to start from. Each picture links to its scene file; the command below it makes it in full size. "
            "`--first` skips frames to save time. [gallery.toml](../gallery.toml) lists the keys that differ from the defaults.", "", "![All of them](sheet.jpg)", ""]
    group = ""
    for name in names:
        if name.split("/")[0] != group:
            group = name.split("/")[0]
            page += [f"## {'To be looked at' if group == 'gallery' else group}", ""]
        page.append(section(name))
    (GALLERY / "README.md").write_text("\n".join(page).rstrip() + "\n")


def main():
    program, wanted = sys.argv[1], sys.argv[2:]
    if wanted in (["--check"], ["--check-all"]):
        sys.exit(pictures.check(program, wanted == ["--check-all"]))
    names, listed = scenes(), pictures.read_list()
    others = [file for file in listed if not file.startswith("docs/gallery/")]
    for name in wanted:
        if name not in names + others + ["--page"]:
            sys.exit(f"{name}: expected --check, --check-all, --page, or some of {', '.join(names + others)}")
    GALLERY.mkdir(exist_ok=True)
    texts = known_scenes()
    made = {file: listed[file] for file in others}
    for file in others:
        if wanted and file not in wanted:
            continue
        if listed[file].is_made:
            print(f"Rendering {file}", file=sys.stderr, flush=True)
            pictures.make(program, listed[file], has_small=True)
            pictures.write_list(listed)
        else:
            listed[file].sha = pictures.sha_of(listed[file].path)
    for name in names:
        line = line_of(name, listed)
        made[line.file] = line
        if line.sha == pictures.NONE and line.path.exists():
            line.sha = pictures.sha_of(line.path)
        if not wanted or name in wanted or name not in texts or not line.path.exists():
            print(f"Rendering {name}", file=sys.stderr, flush=True)
            texts[name] = pictures.make(program, line, has_small=False)["scene"]
            listed[line.file] = line
            pictures.write_list(listed)
    for old in GALLERY.glob("*.jpg"):
        if old != SHEET and old not in [picture_of(name) for name in names]:
            old.unlink()
    if wanted != ["--page"]:
        write_sheet(names)
    sheet = SHEET.relative_to(ROOT).as_posix()
    made[sheet] = pictures.Picture(sheet, pictures.sha_of(SHEET), pictures.NONE, pictures.NONE, "all of docs/gallery")
    write_page(names)
    write_keys(names, texts)
    pictures.write_list(made)
    total = sum(p.stat().st_size for p in GALLERY.iterdir())
    print(f"{len(names)} scenes, {total / 1e6:.1f} MB in docs/gallery", file=sys.stderr)


if __name__ == "__main__":
    main()
