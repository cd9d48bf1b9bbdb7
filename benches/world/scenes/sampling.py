"""What the sampling instants can and cannot resolve."""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Planted
from ..noise import Noise
from .nothing import plain
from .periodic import phase


def shaken(case, rng, hertz, level, expect):
    shape = shapes.sine(hertz * case.record.t, phase(rng))
    case.planted = [Planted("vibration", "motion", shape, level, scaled={"amplitude": 1.0},
                            shaped={"frequency": hertz})]
    case.expect, case.decimals["time_s"] = expect, 6
    return case


def alias_at_two_rates(rng, level):
    """A motor of 31.7 Hz, far above the comparisons; two speeds with no common rate tell which alias it is."""
    case = plain(rng, rows=2400)
    machine = case.machine
    speeds = [machine.speed_rpm, machine.speed_rpm * 1.37]
    case.record = records.sampled(rng, machine, records.there_and_back(machine, 2, speeds), 2400, even=False)
    case.columns = ("time_s", "position_mm", "direction", "speed_rpm")
    return shaken(case, rng, 31.7, max(15.0, 1.5 * level), "alias")


def alias_at_one_rate(rng, level):
    """The same at one speed and even rows: which of the frequencies it is cannot be known."""
    case = plain(rng, rows=1200)
    legs = [records.Leg(20, case.machine.length_mm, case.machine.speed_rpm)]
    case.record = records.sampled(rng, case.machine, legs, 1200, even=True, drop=0)
    return shaken(case, rng, 31.7, max(15.0, 1.5 * level), "unresolvable")


def shaken_below_the_rate(rng, level):
    """One speed: a frequency and an order are the same. Not an order of any wheel."""
    case = plain(rng, rows=1500)
    legs = [records.Leg(20, case.machine.length_mm, case.machine.speed_rpm)]
    case.record = records.sampled(rng, case.machine, legs, 1500, even=False)
    hertz = float(np.round(rng.uniform(0.15, 0.3) * case.machine.per_turn * case.machine.speed_rpm / 60, 4))
    return shaken(case, rng, hertz, max(12.0, level), "unresolvable")


def mesh_beyond_the_rate(rng, level):
    """Teeth that mesh faster than the comparisons: the listed wheel is likely, an alias of it as good."""
    case = plain(rng, rows=1500)
    case.record = records.sampled(rng, case.machine, records.there_and_back(case.machine, 2), 1500, even=False)
    name, order, teeth = case.machine.gears[0]
    mesh, degrees = order * teeth, phase(rng)
    case.planted = [Planted("gear-error", "motion", shapes.gear(case.record, mesh, degrees), max(12.0, level),
                            scaled={"amplitude": 1.0}, shaped={"order": mesh, "phase": degrees})]
    case.expect, case.allowed = "open", {"gear-error"}
    return case


def targets_of_a_screw(rng, level):
    """21 targets 25 mm apart cannot resolve a screw of 9 to 14 mm: no wave may be named."""
    case = plain(rng)
    case.record = records.targets(rng, case.machine)
    case.columns = ("position_mm", "direction")
    case.decimals["position_mm"] = 3
    case.channels = {"error_um": Noise(float(rng.uniform(0.1, 0.4)))}
    shape = shapes.screw(case.record, case.machine, 1, phase(rng))
    case.planted = [Planted("outside:unresolved wave", "motion", shape, max(12.0, level))]
    case.expect = "unresolved"
    return case


def targets_plain(rng, level):
    """Every target repeats an error of its own: the scale's, which no run can take away."""
    case = targets_of_a_screw(rng, level)
    own = np.random.default_rng(int(rng.integers(1 << 30))).standard_normal(21)
    shape = own[np.round(case.record.x / 25).astype(int)]
    case.planted = [Planted("outside:each target's own", "motion", shape, max(12.0, level))]
    return case


SCENES = [alias_at_two_rates, alias_at_one_rate, shaken_below_the_rate, mesh_beyond_the_rate, targets_of_a_screw,
          targets_plain]
