"""docs/pictures.txt, for scripts/gallery: which pictures the documents show, what made them, and whether they still are what it makes.

A line is FILE SHA256 SHOWN SMALL COMMAND: the first 16 digits of the file's hash; what `rainref hash` says of the picture that it shows (of a
film, of its last frame); the same of the command's first frames at a small size, which the ordinary tests make again; and the command. "-" is
a hash that is not known: of a file that no command makes, which has a sentence, of the small ones of docs/gallery, and of pictures that were not
made since the list was begun. Commands of docs/gallery are the gallery's, the others are written there by hand."""
import dataclasses
import hashlib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = ROOT / "docs/pictures.txt"
SMALL = {"--size": "96x54", "--frames": "20"}
WIDTH, QUALITY = 640, 4  # of a JPEG: pixels; ffmpeg's -q:v, 2 (best) to 31
NONE = "-"


@dataclasses.dataclass
class Picture:
    file: str  #: from the root of the sources
    sha: str
    shown: str
    small: str
    command: str

    @property
    def is_made(self):
        return self.command.startswith("rainref run ")

    @property
    def path(self):
        return ROOT / self.file


def read_list():
    """The lines of docs/pictures.txt, by file."""
    found = {}
    for line in LIST.read_text().splitlines():
        if line.startswith("#"):
            continue
        picture = Picture(*line.split(" ", 4))
        if picture.file in found:
            sys.exit(f"{LIST}: {picture.file} is there twice")
        found[picture.file] = picture
    return found


def write_list(pictures):
    head = [line for line in LIST.read_text().splitlines() if line.startswith("#")]
    lines = [" ".join(dataclasses.astuple(pictures[file])) for file in sorted(pictures)]
    LIST.write_text("\n".join(head + lines) + "\n")


def sha_of(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def notes_of(path):
    """What rainref says of a PNG in its texts (tEXt, and iTXt that is not compressed), without the prefix "rainref:"."""
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
            texts[keyword.decode().removeprefix("rainref:")] = rest.decode("utf-8" if kind == b"iTXt" else "latin-1")
        at += 12 + size
    return texts


def ffmpeg(*words):
    subprocess.run(["ffmpeg", "-nostdin", "-loglevel", "error", "-y", *map(str, words)], check=True)


def exact(*words):
    """ffmpeg's arguments for one picture whose bytes hold no date and no version."""
    return [*words, "-q:v", QUALITY, "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"]


def run(program, command, folder, is_small=False, film=None):
    """Runs a command of the list, or the small one that stands for it; gives the PNG of its last frame. Without a name for it there is no film."""
    words = command.split()[1:]
    replaced = {"--film": str(film) if film else None} | (SMALL | {"--first": None} if is_small else {})
    for option, value in replaced.items():
        if option in words:
            del words[words.index(option):words.index(option) + 2]
        elif option == "--film":
            continue
        words += [option, value] if value else []
    subprocess.run([program, *words, "-o", str(folder)], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return max(folder.glob("*.png"))


def make(program, picture, has_small):
    """Makes the file anew, and its hashes. Gives the notes of the PNG that it shows."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        png = run(program, picture.command, folder / "whole", film=folder / "film.gif")
        if picture.path.suffix == ".gif":
            shutil.copyfile(folder / "film.gif", picture.path)
        elif picture.path.suffix == ".png":
            shutil.copyfile(png, picture.path)
        else:
            ffmpeg("-i", png, "-vf", f"scale={WIDTH}:-2:flags=area+accurate_rnd+full_chroma_int", *exact(), picture.path)
        notes = notes_of(png)
        picture.sha, picture.shown = sha_of(picture.path), notes["picture_hash"]
        picture.small = notes_of(run(program, picture.command, folder / "small", is_small=True))["picture_hash"] if has_small else NONE
    return notes


def shown_files():
    """Pictures that README.md and the documents show or link to, and what lies beside those."""
    found = set()
    for document in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]:
        for link in re.findall(r"\]\(([^)\s]+\.(?:png|jpg|gif))\)", document.read_text()):
            found.add((document.parent / link).resolve().relative_to(ROOT).as_posix())
    for folder in ("docs/images", "docs/gallery"):
        found |= {path.relative_to(ROOT).as_posix() for path in (ROOT / folder).iterdir() if path.suffix != ".md"}
    return found


def shared(scene):
    """What a picture's scene and that of the small one have in common."""
    return [line for line in scene.splitlines() if not line.startswith(("run.size = ", "run.frames = "))]


def complaints(program, picture, is_whole):
    """Why the file is not what its line says, or what the program makes now."""
    if not picture.path.exists():
        return ["is missing"]
    found = []
    if sha_of(picture.path) != picture.sha:
        found.append(f"is another file than scripts/gallery wrote: {sha_of(picture.path)} for {picture.sha}")
    if not picture.is_made:
        return found
    notes = notes_of(picture.path) if picture.path.suffix == ".png" else None
    if notes is not None and notes.get("picture_hash") != picture.shown:
        found.append(f"holds the note of another picture: {notes.get('picture_hash')} for {picture.shown}")
    expected = picture.shown if is_whole else picture.small
    if expected == NONE:
        return found + (["was not made since docs/pictures.txt was begun"] if is_whole else [])
    with tempfile.TemporaryDirectory() as temporary:
        fresh = notes_of(run(program, picture.command, pathlib.Path(temporary) / "again", not is_whole))
    if notes is not None and shared(notes.get("scene", "")) != shared(fresh["scene"]):
        found.append("was made of another scene than its command names now")
    if fresh["picture_hash"] != expected:
        found.append(f"is stale: its command {'' if is_whole else 'at a small size '}gives {fresh['picture_hash']}, it gave {expected}")
    return found


def check(program, is_whole):
    """Prints what is wrong with the pictures; gives whether anything is. `is_whole`: each is made again in its own size."""
    listed, shown = read_list(), shown_files()
    problems = [f"{file}: is shown, but docs/pictures.txt has no line of it" for file in sorted(shown - listed.keys())]
    problems += [f"{file}: has a line in docs/pictures.txt, but no document shows it" for file in sorted(listed.keys() - shown)]
    for file in sorted(listed.keys() & shown):
        problems += [f"{file}: {why}" for why in complaints(program, listed[file], is_whole)]
    for problem in problems:
        print(problem)
    if problems:
        print("scripts/gallery makes the pictures anew; with names of scenes or files, those alone")
    return bool(problems)
