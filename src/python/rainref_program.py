"""The command `rainref` of an installed wheel: it starts the program that lies in the package. It is no part of the package, because
importing that needs NumPy."""

import os
import subprocess
import sys
from pathlib import Path

_NAME = "rainref.exe" if sys.platform == "win32" else "rainref"
_HERE = Path(__file__).resolve().parent


def program() -> Path:
    """Returns the program in the package or, in a clone, that of the build folder. Exits with one sentence if there is none."""
    places = [_HERE / "rainref/bin" / _NAME, _HERE.parents[1] / "build/release/bin" / _NAME]
    for place in places:
        if place.exists():
            return place
    sys.exit(f"rainref: this package was made without the program: {places[0]} does not exist")


def main() -> None:
    """Runs the program with the arguments of this process, and ends as it ends."""
    path = str(program())
    arguments = [path, *sys.argv[1:]]
    if sys.platform == "win32":  # execv there returns to the shell before the program has ended
        sys.exit(subprocess.run(arguments).returncode)
    os.execv(path, arguments)


if __name__ == "__main__":
    main()
