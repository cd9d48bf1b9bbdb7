"""What the data carry when the noise has to be found as well: twice the log likelihood of a shape, noise refitted.

The Ornstein-Uhlenbeck part has a tridiagonal precision, so that the likelihood of it and white noise costs one banded
Cholesky factor; both sizes and the memory are free, with the shape and without it.
"""

import numpy as np
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.optimize import minimize

from .case import GAINS
from .loop import fallen_short

# Levels below are not asked for, whatever the noise.
LEAST_LEVEL = 7.9
# Rows further than this many robust deviations from the fit are outliers of the instrument.
OUTLIER = 5.0
# Steps of the search, and the longest memory as a share of the record: longer ones are drifts, not noise.
STEPS, LONGEST = 160, 1.0


def deviance(t, data, columns, start):
    """Least of −2 log likelihood over the noise, the columns' amplitudes profiled out."""
    gaps = np.maximum(np.diff(t), 1e-9)
    stack = np.column_stack([data, columns])
    best = np.inf
    for first in (start, start + np.array([0.0, 0.7, 1.5])):
        found = minimize(cost, first, args=(gaps, stack, LONGEST * (t[-1] - t[0])), method="Nelder-Mead",
                         options={"maxfev": STEPS, "xatol": 0.01, "fatol": 0.02})
        best = min(best, found.fun)
    return float(best)


def cost(logs, gaps, stack, longest):
    white, slow, memory = np.exp(logs)
    if not (1e-3 < memory < longest and 1e-9 < slow < 1e6 and 1e-9 < white < 1e6):
        return 1e15
    keep = np.exp(-gaps / memory)
    fresh = -np.expm1(-2 * gaps / memory) * slow**2
    diagonal = np.concatenate([[1 / slow**2], 1 / fresh])
    diagonal[:-1] += keep**2 / fresh
    band = np.vstack([np.concatenate([[0.0], -keep / fresh]), diagonal + 1 / white**2])
    factor = cholesky_banded(band)
    pulled = cho_solve_banded((factor, False), stack)
    inner = stack.T @ stack / white**2 - stack.T @ pulled / white**4
    amplitudes = np.linalg.lstsq(inner[1:, 1:], inner[1:, 0], rcond=1e-12)[0]
    left = inner[0, 0] - amplitudes @ inner[1:, 0]
    logdet = 2 * np.sum(np.log(factor[1])) + np.log(slow**2) + np.sum(np.log(fresh))
    return left + logdet + 2 * len(stack) * np.log(white)


def gained(t, data, without, shape, noise):
    """By how much twice the log likelihood grows with `shape` beside the columns `without`."""
    start = np.log([noise.white, max(noise.slow, 0.2 * noise.white), noise.memory_s])
    return deviance(t, data, without, start) - deviance(t, data, np.column_stack([without, shape]), start)


def weigh(case, columns):
    """Evidence of every planted effect that is large enough to be asked for, the others beside it."""
    rows = slice(None, None, case.thin)
    zeros = case.record.offsets()[rows]
    for one in case.planted:
        one.evidence = 0.0
        for channel, noise in case.channels.items():
            if GAINS[channel][one.entry] == 0 or one.reached < LEAST_LEVEL:
                continue
            others = [GAINS[channel][other.entry] * other.shape[rows] for other in case.planted if other is not one]
            without = np.column_stack([zeros] + [shape for shape in others if np.any(shape)])
            left = left_of(case, columns, channel)[rows]
            shape = as_run(case, columns, one)[rows]
            kept = sound(left, np.column_stack([without, shape]))
            one.evidence += gained(case.record.t[rows][kept], left[kept], without[kept], shape[kept], noise)


def as_run(case, columns, one):
    """The shape; an actuator's follows the steps that the loop took, noise and all."""
    if case.loop is None or one.entry != "actuator" or case.loop.lost:
        return one.shape
    return fallen_short(case.loop, case.machine, case.record.t, columns["steps"])


def sound(data, columns):
    """Rows that are no outliers of a robust fit of all that is there."""
    kept = np.ones(len(data), bool)
    for _ in range(3):
        rest = data - columns @ np.linalg.lstsq(columns[kept], data[kept], rcond=None)[0]
        kept = np.abs(rest) < OUTLIER * 1.4826 * np.median(np.abs(rest)) + 1e-12
    return kept


def left_of(case, columns, channel):
    """The channel less what the file knows."""
    out = columns[channel].copy()
    if channel == "error_um":
        out -= case.machine.rational_um_m * case.record.metres
    if "steps" in columns:
        out += case.machine.step_um * columns["steps"]
    for one in case.known:
        out -= GAINS[channel][one.entry] * one.amplitude * one.shape
    return out
