"""One case: what is planted, how large it must be to stand out as asked, and whether the data can tell it."""

from dataclasses import dataclass, field

import numpy as np

from . import noise as noises
from .machine import Machine
from .record import Record
from .rivals import rivals

# δ of an entry as each sensor shows it with the loop open.
GAINS = {
    "error_um": {"motion": -1, "length-reference": 1, "angle-reference": 1, "electronics": 1, "actuator": 1,
                 "workpiece": 0},
    "lead_error_um": {"motion": 1, "length-reference": 0, "angle-reference": 0, "electronics": 0, "actuator": -1,
                      "workpiece": 1},
}
GAINS["error_arcsec"] = GAINS["error_um"]
# Rows that the search for rivals is thinned to, in evidence counted as all.
MOST_ROWS = 2500
# Below these a rival draws the same curve: twice log likelihood, or share of the signal it does not reach.
LEAST_DIFFERENCE, LEAST_SHARE = 6.0, 0.1
# Effects that come in whole numbers.
COUNTED = {"fringe-slip", "grating-slip", "lost-steps"}


@dataclass
class Planted:
    name: str  # of the catalogue; or "outside"
    entry: str
    shape: np.ndarray  # δ for unit amplitude
    level: float | None = None  # wanted: standard errors of the optimal fit
    amplitude: float = 1.0
    fixed: bool = False  # physics or whole numbers fix the amplitude: the noise gives way
    scaled: dict = field(default_factory=dict)  # parameters for unit amplitude
    shaped: dict = field(default_factory=dict)  # parameters that do not grow with it
    reached: float = 0.0  # standard errors of it, all other planted ones free
    nearest: float = 0.0  # twice log likelihood by which two effects of the catalogue fall short of it
    alike: list = field(default_factory=list)  # effects that the data cannot tell from it
    evidence: float = 0.0  # twice the log likelihood that it gains when the noise has to be found as well
    size_um: float = 0.0  # of one of a counted thing: its rivals come in whole numbers too

    def parameters(self):
        return {key: value * self.amplitude for key, value in self.scaled.items()} | self.shaped


@dataclass
class Case:
    kind: str
    expect: str  # which rule of `judge` holds
    machine: Machine
    record: Record
    planted: list = field(default_factory=list)  # what the file lacks
    known: list = field(default_factory=list)  # what file and data hold
    channels: dict = field(default_factory=dict)  # column → Noise
    allowed: set = field(default_factory=set)  # names that are near the truth: neither asked for nor false
    columns: tuple = ("time_s", "position_mm")
    decimals: dict = field(default_factory=lambda: {"time_s": 4, "position_mm": 4})
    doubts: tuple = ()  # words of which one must stand in a doubt
    mend: object = None  # columns, machine → None: the mistake of input
    loop: object = None  # Loop of a closed machine
    notes: str = ""
    level: float = 0.0
    thin: int = 1  # every so many rows are written
    formula: list = field(default_factory=list)  # words of `helixlock discover` for a shape outside the catalogue


class Court:
    """Whitened space of all channels with the passes' zeros (and whatever is given) taken out."""

    def __init__(self, case, stride=1):
        self.case, self.rows = case, slice(None, None, stride * case.thin)
        self.base = self.basis(self.white(offsets_of(case)))

    def white(self, stacks):
        """One column a shape: `stacks` maps channel → columns."""
        t = self.case.record.t[self.rows]
        parts = []
        for channel, noise in self.case.channels.items():
            if noise.weight is not None:
                noise = noises.Noise(noise.white, noise.slow, noise.memory_s, weight=noise.weight[self.rows])
            parts.append(noises.whiten(noise, t, stacks[channel][self.rows]))
        return np.vstack(parts)

    def shapes(self, pairs):
        """Whitened columns of (entry, shape) pairs."""
        table = {}
        for channel in self.case.channels:
            table[channel] = np.column_stack([GAINS[channel][entry] * shape for entry, shape in pairs])
        return self.white(table)

    def errors(self, one):
        """Standard errors of unit amplitude, the zeros of the passes free."""
        return float(np.linalg.norm(self.rest(self.shapes([(one.entry, one.shape)]), self.base)))

    @staticmethod
    def basis(columns):
        scale = np.linalg.norm(columns, axis=0)
        q, r = np.linalg.qr(columns[:, scale > 0] / scale[scale > 0])
        return q[:, np.abs(np.diag(r)) > 1e-9]

    @staticmethod
    def rest(columns, basis):
        return columns - basis @ (basis.T @ columns)


def offsets_of(case):
    """Each pass has its own zero on each channel."""
    one, out = case.record.offsets(), {}
    for nth, channel in enumerate(case.channels):
        out[channel] = np.zeros((len(one), one.shape[1] * len(case.channels)))
        out[channel][:, nth * one.shape[1]:(nth + 1) * one.shape[1]] = one
    return out


def size(case):
    """Amplitudes for the levels that are asked; for a fixed one the noise is scaled instead."""
    for one in [one for one in case.planted if one.fixed and one.level]:
        factor = Court(case).errors(one) * abs(one.amplitude) / one.level
        case.channels = {name: noise.scaled(factor) for name, noise in case.channels.items()}
    court = Court(case)
    for one in case.planted:
        if one.level and not one.fixed:
            one.amplitude *= one.level / (court.errors(one) * abs(one.amplitude))


def judge_data(case):
    """How far each planted effect stands out beside the others, and who else would do."""
    if not case.planted:
        return
    stride = max(1, len(case.record) // case.thin // MOST_ROWS)
    court = Court(case, stride)
    mine = court.shapes([(one.entry, one.amplitude * one.shape) for one in case.planted])
    alternatives = rivals(case.machine, case.record, case.channels)
    pairs = [(entry, column) for _, entry, columns in alternatives for column in columns]
    others = court.shapes(pairs)
    for nth, one in enumerate(case.planted):
        rest_of = np.delete(mine, nth, axis=1)
        basis = Court.basis(np.hstack([court.base, rest_of])) if rest_of.size else court.base
        signal, others_left = Court.rest(mine[:, nth], basis), Court.rest(others, basis)
        power = float(signal @ signal) * stride
        one.reached = float(np.sqrt(power))
        left = shares(signal, others_left, alternatives) * stride
        if one.size_um:
            left[[name in COUNTED for name, _, _ in alternatives]] = np.inf
        left[[name == one.name for name, _, _ in alternatives]] = np.inf
        one.alike = sorted({
            name for (name, _, _), unreached in zip(alternatives, left)
            if unreached < LEAST_DIFFERENCE or unreached < LEAST_SHARE * power
        } | whole_rivals(case, one))
        one.nearest = float(left.min())
        if one.name.startswith("outside"):
            one.nearest = pair(signal, others_left, alternatives, int(left.argmin())) * stride


def whole_rivals(case, one):
    """Slips of another kind whose nearest whole number is as large, to within what the data can tell."""
    if not one.size_um:
        return set()
    machine, jump = case.machine, abs(one.amplitude) * one.size_um
    sizes = {"fringe-slip": machine.wavelength_um / 2, "grating-slip": machine.lead_mm * 1e3 / machine.lines}
    if case.loop is not None:
        sizes["lost-steps"] = machine.step_um
    gaps = {name: abs(jump - max(1, round(jump / size)) * size) for name, size in sizes.items() if name != one.name}
    return {name for name, gap in gaps.items() if (gap / jump * one.reached) ** 2 < LEAST_DIFFERENCE}


def pair(signal, columns, alternatives, best):
    """What the best second effect leaves beside the best first."""
    first = sum(len(block) for _, _, block in alternatives[:best])
    basis = Court.basis(columns[:, first:first + len(alternatives[best][2])])
    return float(shares(Court.rest(signal, basis), Court.rest(columns, basis), alternatives).min())


def shares(signal, columns, alternatives):
    """Power of the signal that each alternative leaves."""
    out, first = [], 0
    for _, _, block in alternatives:
        part = columns[:, first:first + len(block)]
        first += len(block)
        norms = np.linalg.norm(part, axis=0)
        usable = part[:, norms > 1e-9] / norms[norms > 1e-9]
        if usable.shape[1] == 0:
            out.append(float(signal @ signal))
            continue
        solution = np.linalg.lstsq(usable, signal, rcond=1e-8)[0]
        out.append(float(np.sum((signal - usable @ solution) ** 2)))
    return np.array(out)
