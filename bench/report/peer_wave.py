"""What a user would write instead of wave_step: a wave equation in NumPy, and in Numba's parallel loops.

Run by the bench with the system's Python: reads requests, PEER SIDE THREADS SECONDS a line, and answers each with a line of JSON, either
{"seconds", "hash", "version"} or {"reason"}. Arithmetic of the corrected wave_step in float, with the edge repeated by a border of one texel.
"""
import functools
import hashlib
import json
import sys
import time

import numpy as np

GAMMA, COURANT = np.float32(0.995), np.float32(0.24)


def numpy_step(newest, previous):
    c = newest[1:-1, 1:-1]
    around = newest[1:-1, :-2] + newest[1:-1, 2:] + newest[:-2, 1:-1] + newest[2:, 1:-1]
    previous[1:-1, 1:-1] = c + GAMMA * (c - previous[1:-1, 1:-1]) + COURANT * (around - 4 * c)
    repeat_edge(previous)


def repeat_edge(level):
    level[0], level[-1] = level[1], level[-2]
    level[:, 0], level[:, -1] = level[:, 1], level[:, -2]


@functools.cache
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


def with_numpy(_):
    return numpy_step, np.__version__


def with_numba(threads):
    import numba
    numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
    return numba_step(), numba.__version__


PEERS = {"numpy": with_numpy, "numba": with_numba}  # of so many threads: the step and its version


def main():
    for line in sys.stdin:
        peer, side, threads, seconds = line.split()
        try:
            step, version = PEERS[peer](int(threads))
            goes, digest = measure(step, int(side), float(seconds))
            answer = {"seconds": goes, "hash": digest, "version": version}
        except Exception as problem:  # whatever a broken installation raises, other requests are answered
            answer = {"reason": f"{type(problem).__name__}: {problem}"}
        print(json.dumps(answer), flush=True)


main()
