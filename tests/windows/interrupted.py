"""Ctrl-C typed at a console while a run writes its files: python3 interrupted.py COMMAND... in an empty folder. The command ends as Windows
ends programs on Ctrl-C, and leaves nothing."""

import os
import pty
import select
import sys
import time
from pathlib import Path

Path("scene.toml").write_text("effect = 'edge_splash'\nvariant = 'corrected'\n[run]\nsize = [24, 16]\n")
process, terminal = pty.fork()
if process == 0:
    arguments = "run scene.toml -o new --frames 1000000 --image none --capture passes --every 1".split()
    os.execvp(sys.argv[1], [*sys.argv[1:], *arguments])
typed = False
end = time.monotonic() + 120
while time.monotonic() < end:
    if select.select([terminal], [], [], 0.05)[0]:
        try:
            if not os.read(terminal, 65536):
                break
        except OSError:  # the terminal's other end is closed
            break
    if not typed and sum(len(files) for _, _, files in os.walk("new")) > 10:
        os.write(terminal, b"\x03")
        typed = True
_, status = os.waitpid(process, 0 if time.monotonic() < end else os.WNOHANG)
if not typed or not os.WIFEXITED(status) or os.WEXITSTATUS(status) != 0xC000013A & 0xFF or sorted(os.listdir()) != ["scene.toml"]:
    sys.exit(f"typed {typed}, status {status}, left {sorted(os.listdir())}")
