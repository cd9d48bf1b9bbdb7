"""Effects that the catalogue names, in a form that is not quite its formula.

Right is the name (the cause is found), or `unexplained` (the form is not the catalogue's); another name is false.
"""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Planted
from ..noise import Noise
from .logs import with_thread
from .nothing import know_screw, know_slope
from .periodic import phase, resolved
from .smooth import both_ways, passes


def form(case, name, entry, shape, level, near=()):
    case.expect, case.allowed = "form", {name, *near}
    case.planted = [Planted("outside:" + name, entry, shape, max(12.0, 2.5 * level))]
    return case


def smooth_backlash(rng, level):
    """Play that is taken up over some millimetres of way."""
    case = both_ways(rng)
    way = np.minimum(case.record.way, 1e6) / float(rng.uniform(2, 15))
    turned = case.record.way < 1e8
    shape = 0.5 * case.record.direction * np.where(turned, 1 - 2 * np.exp(-way), 1)
    return form(case, "backlash", "motion", shape, level)


def backlash_over_an_angle(rng, level):
    """A flank is reached after a share of a turn: a ramp from one side to the other."""
    case = both_ways(rng)
    share = np.clip(case.record.way / (case.machine.lead_mm * float(rng.uniform(0.3, 1.5))), 0, 1)
    shape = 0.5 * case.record.direction * (2 * share - 1)
    return form(case, "backlash", "motion", shape, level)


def two_time_constants(rng, level):
    """Bearing and casting warm up, one fast, one slow."""
    case = passes(rng, 3, rows=1200)
    t, end = case.record.t, case.record.t[-1]
    fast, slow = float(rng.uniform(0.03, 0.06)) * end, float(rng.uniform(0.4, 0.8)) * end
    shape = 0.5 * (1 - np.exp(-t / fast)) + (1 - np.exp(-t / slow))
    return form(case, "headstock-growth", "length-reference", shape, level, {"phase-drift"})


def three_harmonics(rng, level):
    """A wobble with its overtones: each is the catalogue's own."""
    case = resolved(rng, 5)
    degrees = [phase(rng) for _ in range(3)]
    case.planted = [
        Planted("screw-periodic", "motion", shapes.screw(case.record, case.machine, k, degrees[k - 1]), size,
                scaled={"amplitude": 1.0}, shaped={"harmonic": k, "phase": degrees[k - 1]})
        for k, size in ((1, 25.0), (2, 14.0), (3, 10.0))
    ]
    case.expect, case.allowed = "form", {"screw-periodic"}
    return case


def trapezoidal_wear(rng, level):
    """Worn evenly over the stretch that is used most."""
    case = passes(rng, 2)
    span, x = case.machine.length_mm, case.record.x
    middle, flat, slope = rng.uniform(0.4, 0.6) * span, rng.uniform(0.08, 0.15) * span, rng.uniform(0.02, 0.05) * span
    shape = np.clip((flat + slope - np.abs(x - middle)) / slope, 0, 1)
    return form(case, "screw-wear", "motion", shape, level)


def lopsided_wear(rng, level):
    case = passes(rng, 2)
    span, x = case.machine.length_mm, case.record.x
    top = rng.uniform(0.35, 0.6) * span
    width = np.where(x < top, 0.03, 0.1) * span
    return form(case, "screw-wear", "motion", np.exp(-0.5 * ((x - top) / width) ** 2), level)


def wheel_wears_fast_then_slow(rng, level):
    """A freshly dressed wheel loses its sharp grains first."""
    case = with_thread(rng, 3, both=True)
    way = case.record.ground / case.machine.length_mm
    shape = -(1 - np.exp(-way / 0.15) + 0.6 * way)
    return form(case, "wheel-wear", "workpiece", shape, level)


def expansion_of_another_alloy(rng, level):
    """The workpiece grows more than the file's factor: the cause is right, the factor is not the textbook's."""
    case = with_thread(rng, 3)
    true = 20 + records.course(rng, case.record.t, float(rng.uniform(0.3, 0.6)))
    records.log(rng, case.record, "workpiece_temperature_c", true, 0.01, 0.004, 60.0)
    factor = float(rng.choice([0.4, 1.8, 2.8]))
    shape = factor * shapes.expansion(case.record, case.machine, true)
    case.notes = f"factor {factor:g}"
    case = form(case, "workpiece-expansion", "workpiece", shape, 12)
    case.planted[0].fixed = True
    return case


def ripple_of_second_order(rng, level):
    """Unequal gains of the two photodiodes: twice a fringe."""
    case = passes(rng, 2, rows=2000)
    know_slope(case, rng, linear=float(np.round(rng.uniform(25, 60), 1)))
    machine, record = case.machine, case.record
    error = -case.known[0].shape + machine.rational_um_m * record.metres
    starts = record.starts()
    error = error - np.repeat(error[starts], np.diff(np.append(starts, len(record))))
    shape = np.sin(8 * np.pi * error / machine.wavelength_um + np.radians(phase(rng)))
    case.channels["error_um"] = Noise(0.01)
    return form(case, "fringe-nonlinearity", "length-reference", shape, level)


def other_value(rng, level):
    """The file holds the wobble, but the machine's has grown since."""
    case = resolved(rng, 3)
    know_screw(case, rng, um=1.5)
    wave = case.known[0]
    case = form(case, "screw-periodic", "motion", wave.shape, level)
    case.notes = "the file's own amplitude is smaller than the data's"
    return case


def other_slope(rng, level):
    case = passes(rng, 3)
    know_slope(case, rng, linear=25.0, quadratic=-12.0)
    return form(case, "screw-progressive", "motion", case.known[0].shape / 10, level)


def delay(rng, level):
    """A following error: the table is late by τ·v, whatever the wave; three speeds, both ways."""
    case = passes(rng, 4)
    machine = case.machine
    speeds = [machine.speed_rpm * factor for factor in (1.0, 1.0, 2.5, 2.5)]
    legs = []
    for nth, speed in enumerate(speeds):
        ends = (20.0, machine.length_mm) if nth % 2 == 0 else (machine.length_mm, 20.0)
        legs.append(records.Leg(*ends, speed, joined=nth in (1, 3), pause_s=3.0))
    case.record = records.sampled(rng, machine, legs, 1200)
    case.columns = ("time_s", "position_mm", "direction", "speed_rpm")
    shape = -case.record.direction * case.record.speed * machine.lead_mm / 60
    return form(case, "recorder-lag", "motion", shape, level, {"backlash"})


SCENES = [smooth_backlash, backlash_over_an_angle, two_time_constants, three_harmonics, trapezoidal_wear,
          lopsided_wear, wheel_wears_fast_then_slow, expansion_of_another_alloy, ripple_of_second_order, other_value,
          other_slope, delay]
