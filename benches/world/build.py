"""From a seed to a case: which kind, which level, sized and judged."""

import numpy as np

from .case import judge_data, size
from .scenes import KINDS, LEVELS

# What any two effects of the catalogue leave of an outside shape: eight standard errors, squared.
LEAST_EVIDENCE, MOST_GROWTH = 64.0, 30.0


def build(seed):
    """Kinds come by turns, levels by turns of the turns; everything else is drawn."""
    nth, turn = seed % len(KINDS), seed // len(KINDS)
    scene, level = KINDS[nth], LEVELS[(turn + nth) % len(LEVELS)]
    rng = np.random.default_rng([seed, 20261122])
    case = scene(rng, float(level))
    case.kind, case.level = scene.__name__, float(level)
    size(case)
    judge_data(case)
    if case.expect == "outside":
        grow(case)
    return case, rng


def grow(case):
    """Enlarges what the catalogue could still draw at this size."""
    one = case.planted[0]
    factor = min(MOST_GROWTH, np.sqrt(1.05 * LEAST_EVIDENCE / max(one.nearest, 1e-9)))
    if factor <= 1:
        return
    if one.fixed:
        case.channels = {name: noise.scaled(1 / factor) for name, noise in case.channels.items()}
    else:
        one.amplitude *= factor
    judge_data(case)
