"""What a user would write instead of wave_step: a wave equation in NumPy, and in Numba's parallel loops.

Run by the bench with the system's Python: peer_wave.py SECONDS THREADS... prints a JSON list of rows. Arithmetic of the corrected
wave_step in float, with the edge repeated by a border of one texel.
"""
import hashlib
import json
import sys
import time

import numpy as np

GAMMA, COURANT = np.float32(0.995), np.float32(0.24)
SIDES = (1024, 2048, 4096)


def numpy_step(newest, previous):
    c = newest[1:-1, 1:-1]
    around = newest[1:-1, :-2] + newest[1:-1, 2:] + newest[:-2, 1:-1] + newest[2:, 1:-1]
    previous[1:-1, 1:-1] = c + GAMMA * (c - previous[1:-1, 1:-1]) + COURANT * (around - 4 * c)
    repeat_edge(previous)


def repeat_edge(level):
    level[0], level[-1] = level[1], level[-2]
    level[:, 0], level[:, -1] = level[:, 1], level[:, -2]


def numba_step():
    import numba

    @numba.njit(parallel=True, fastmath=True)
    def step(newest, previous):
        gamma, courant = np.float32(0.995), np.float32(0.24)
        rows, columns = newest.shape
        for y in numba.prange(1, rows - 1):
            for x in range(1, columns - 1):
                c = newest[y, x]
                around = newest[y, x - 1] + newest[y, x + 1] + newest[y - 1, x] + newest[y + 1, x]
                previous[y, x] = c + gamma * (c - previous[y, x]) + courant * (around - np.float32(4) * c)
        previous[0], previous[-1] = previous[1], previous[-2]
        previous[:, 0], previous[:, -1] = previous[:, 1], previous[:, -2]

    return step


def measure(step, side, seconds):
    """Times of single steps after eight, and the hash of the level after these."""
    rng = np.random.default_rng(1)
    newest = np.pad((rng.random((side, side), dtype=np.float32) - np.float32(0.5)) * np.float32(0.1), 1, mode="edge")
    previous = newest.copy()
    for _ in range(8):
        step(newest, previous)
        newest, previous = previous, newest
    digest = hashlib.sha256(newest[1:-1, 1:-1].tobytes()).hexdigest()[:16]
    goes, begin = [], time.perf_counter()
    while len(goes) < 3 or time.perf_counter() - begin < seconds:
        start = time.perf_counter()
        step(newest, previous)
        goes.append(time.perf_counter() - start)
        newest, previous = previous, newest
    return goes, digest


def main():
    seconds, threads = float(sys.argv[1]), [int(t) for t in sys.argv[2:]]
    rows, skipped = [], []

    def add(peer, version, side, count, result):
        rows.append({"peer": peer, "version": version, "row": f"wave_step/corrected/rg32f/{side}", "threads": count,
                     "items": side * side, "seconds": result[0], "hash": result[1]})

    for side in SIDES:
        add("numpy", np.__version__, side, 1, measure(numpy_step, side, seconds))
    try:
        import numba
        step = numba_step()
        for count in threads:
            numba.set_num_threads(min(count, numba.config.NUMBA_NUM_THREADS))
            for side in SIDES:
                add("numba", numba.__version__, side, count, measure(step, side, seconds))
    except Exception as problem:  # whatever a broken installation raises, the other rows stay
        skipped.append({"peer": "numba", "reason": f"{type(problem).__name__}: {problem}"})
    json.dump({"rows": rows, "skipped": skipped}, sys.stdout)


main()
