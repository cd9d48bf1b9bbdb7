"""The loop is closed: recorder and counter are logged, the loop hunts by whole steps."""

import numpy as np

from .. import record as records
from ..case import Case, Planted
from ..loop import Loop, fallen_short, run
from ..machine import grinder
from ..noise import Noise
from .nothing import know_screw, know_slope
from .periodic import named, plant_gear


def looped(rng, loop=None):
    """All comparisons of one pass; every fourth is written."""
    machine = grinder(rng, length_mm=float(rng.choice([200, 300])), closed=True)
    legs = records.one_pass(machine)
    record = records.sampled(rng, machine, legs, 10**6, even=True, drop=0)
    case = Case("", "nothing", machine, record, channels={"error_um": Noise(float(rng.uniform(0.02, 0.05)))})
    case.loop, case.thin = loop or Loop(), 4
    know_screw(case, rng, um=float(rng.uniform(1.5, 4)))
    know_slope(case, rng)
    case.record.true["commanded_um"] = machine.step_um * counted(case)
    return case


def counted(case):
    """The counter as a loop without noise runs it: what the actuator's effects are functions of."""
    machine, record = case.machine, case.record
    open_error = machine.rational_um_m * record.metres
    for one in case.known:
        open_error = open_error - one.amplitude * one.shape
    quiet = np.zeros(len(record))
    return run(Loop(), machine, record.t, open_error - open_error[0], quiet)[1]


def closed_nothing(rng, level):
    return looped(rng)


def closed_gear(rng, level):
    case = looped(rng)
    return named(case, plant_gear(case, rng, level))


def weak_lever(rng, level):
    gain = float(rng.choice([0.9, 0.94, 0.97, 1.03, 1.06]))
    case = looped(rng, Loop(gain=gain))
    shape = case.record.true["commanded_um"]
    return named(case, Planted("lever-ratio", "actuator", shape, level, 1 - gain, fixed=True, shaped={"gain": gain}))


def lost_motion(rng, level):
    width = float(rng.uniform(0.1, 0.6))
    case = looped(rng, Loop(lost_motion_um=width))
    shape = fallen_short(case.loop, case.machine, case.record.t, counted(case))
    return named(case, Planted("corrector-lost-motion", "actuator", shape, level, 1.0, fixed=True,
                               shaped={"width": width}))


def lost_steps(rng, level):
    case = looped(rng)
    at = float(rng.uniform(0.3, 0.7) * case.record.t[-1])
    steps = int(rng.integers(12, 80))
    case.loop.lost = ((at, steps),)
    shape = case.machine.step_um * (case.record.t >= at)
    return named(case, Planted("lost-steps", "actuator", shape, level, steps, fixed=True, scaled={"count": 1.0},
                               shaped={"time": at}, size_um=case.machine.step_um))


SCENES = [closed_nothing, closed_gear, weak_lever, lost_motion, lost_steps]
