"""The puddle's pass wave_step in NumPy, written from docs/effects/puddle.md: the port that the other examples judge.

`i` has the inputs by name (wave: newest and previous level, drops: records, shore where the scene has one), `u` the uniforms by name, and
`beyond` is the address rule of the wave with the height beyond its border: ("clamp", 0).
"""

import numpy as np

F = np.float32


def impulse(drops, shape):
    """Heights that drops add: craters (1 - q^2)^2 (1 - 4 q^2)."""
    x = np.arange(shape[1], dtype=F) + F(0.5)
    y = np.arange(shape[0], dtype=F)[:, None] + F(0.5)
    out = np.zeros(shape, F)
    for d in drops:
        s = ((x - d["x"]) / d["radius"]) ** 2 + ((y - d["y"]) / d["radius"]) ** 2
        out += d["amplitude"] * np.maximum(1 - s, 0) ** 2 * (1 - 4 * s)
    return out


def beyond_the_edge(level, rule, border):
    """A level with one more texel around it, as the address rule has it."""
    how = {"clamp": {"mode": "edge"}, "repeat": {"mode": "wrap"}, "border": {"mode": "constant", "constant_values": border}}
    return np.pad(level, 1, **how[rule])


def kept_in_rim(u, shape):
    """Share of both levels that the rim leaves in a step, by row and column."""
    def from_edge(n):
        return np.minimum(np.arange(n, dtype=F) + F(0.5), n - (np.arange(n, dtype=F) + F(0.5)))

    edge = np.minimum(from_edge(shape[1]), from_edge(shape[0])[:, None])
    return 1 - u.rim_damping * np.maximum(1 - u.rim_inverse * edge, 0) ** 2


def wave_step(i, u, beyond):
    """The next level, and what becomes the previous one."""
    here, previous = (i.wave[..., k].astype(F) for k in (0, 1))
    p = beyond_the_edge(here, *beyond)
    laplacian = p[1:-1, :-2] + p[1:-1, 2:] + p[:-2, 1:-1] + p[2:, 1:-1] - 4 * here
    add = impulse(i.drops, here.shape)
    shore = i.shore if "shore" in vars(i) else F(1)
    rim = F(1)
    if u.rim_damping > 0:
        rim = kept_in_rim(u, here.shape)
        previous = u.rest + rim * (previous - u.rest)
    new = here + u.damping * (here - previous) + u.courant_sq * laplacian + add
    return np.stack([u.rest + shore * rim * (new - u.rest), here + shore * add], -1).astype(np.float16)
