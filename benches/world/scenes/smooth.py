"""One effect of the catalogue over travel, time or a reversal, that needs no log."""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Planted
from ..noise import Noise, workshop
from .nothing import know_screw, plain
from .periodic import named


def both_ways(rng, **over):
    """Two passes that turn about inside."""
    case = plain(rng, **over)
    legs = records.turned_about(case.machine, int(rng.integers(1, 3)))
    case.record = records.sampled(rng, case.machine, legs, len(case.record))
    case.columns = ("time_s", "position_mm", "direction")
    return case


def passes(rng, times=3, **over):
    """Forward and reverse by turns, so that travel and time part."""
    return plain(rng, legs=lambda machine: records.there_and_back(machine, times), **over)


def progressive(rng, level):
    case = passes(rng)
    x = case.record.metres
    linear, bend = float(rng.choice([-1, 1])), float(rng.uniform(1, 3) * rng.choice([-1, 1]))
    return named(case, Planted("screw-progressive", "motion", linear * x + bend * x**2, level,
                               scaled={"linear": linear, "quadratic": bend}))


def wear(rng, level):
    case = passes(rng)
    span = case.machine.length_mm
    place, width = float(rng.uniform(0.25, 0.75) * span), float(rng.uniform(0.03, 0.09) * span)
    return named(case, Planted("screw-wear", "motion", shapes.bump(case.record, place, width), level,
                               scaled={"height": 1.0}, shaped={"position": place, "width": width}))


def backlash(rng, level):
    case = both_ways(rng)
    return named(case, Planted("backlash", "motion", case.record.direction / 2, level, scaled={"width": 1.0}))


def targets_reversal(rng, level):
    """ISO 230-2: 21 targets, five runs, reversal error; each target repeats its own error."""
    case = plain(rng, screw_mm=5.0)
    case.record = records.targets(rng, case.machine)
    case.columns = ("position_mm", "direction") if rng.random() < 0.5 else ("time_s", "position_mm", "direction")
    case.decimals |= {"position_mm": 3, "time_s": 1}
    case.channels = {"error_um": Noise(float(rng.uniform(0.1, 0.4)))}
    return named(case, Planted("backlash", "motion", case.record.direction / 2, level, scaled={"width": 1.0}))


def drift(rng, level):
    case = passes(rng)
    return named(case, Planted("phase-drift", "electronics", case.record.t / 3600, level, scaled={"rate": 1.0}))


def growth(rng, level):
    case = passes(rng)
    tau = float(rng.uniform(0.1, 0.35) * case.record.t[-1])
    return named(case, Planted("headstock-growth", "length-reference", 1 - np.exp(-case.record.t / tau), level,
                               scaled={"amplitude": 1.0}, shaped={"time_constant": tau}))


def laser_drift(rng, level):
    case = passes(rng, 4)
    shape = case.record.metres * case.record.t / 3600
    return named(case, Planted("laser-drift", "length-reference", shape, level, scaled={"rate": 1.0}))


def mode_hop(rng, level):
    case = passes(rng, 3)
    at = float(rng.uniform(0.35, 0.65) * case.record.t[-1])
    shape = case.record.metres * (case.record.t >= at)
    return named(case, Planted("laser-drift", "length-reference", shape, level, scaled={"hop": 1.0},
                               shaped={"hop_time": at}))


def crooked_beam(rng, level):
    """One slope over travel, nothing else: cosine, screw, and air are alike, and one must say so."""
    case = passes(rng, 2)
    shape = 0.5 * case.record.metres
    case = named(case, Planted("cosine", "length-reference", shape, level))
    case.planted[0].amplitude = 1.0
    return case


def fringe_slip(rng, level):
    return slip(rng, level, "fringe-slip", "length-reference", lambda machine: machine.wavelength_um / 2)


def grating_slip(rng, level):
    return slip(rng, level, "grating-slip", "angle-reference", lambda machine: machine.lead_mm * 1e3 / machine.lines)


def slip(rng, level, name, entry, size):
    case = passes(rng, 2, noise=workshop(rng))
    inside = case.record.passes == 1 + int(rng.integers(0, 2))
    at = float(np.quantile(case.record.t[inside], rng.uniform(0.3, 0.7)))
    count = int(rng.integers(1, 4)) * int(rng.choice([-1, 1]))
    shape = size(case.machine) * (case.record.t >= at)
    return named(case, Planted(name, entry, shape, level, count, fixed=True, scaled={"count": 1.0},
                               shaped={"time": at}, size_um=size(case.machine)))


def staircase(rng, level):
    case = passes(rng, 2)
    rate = float(rng.uniform(4, 15) * rng.choice([-1, 1]))
    shape = shapes.stairs(case.record, rate, case.machine.wavelength_um)
    case.channels["error_um"] = Noise(0.03, 0.01, 40)
    return named(case, Planted("compensator-staircase", "length-reference", shape, level, 1.0, fixed=True,
                               shaped={"rate": rate}))


def dead_zone(rng, level):
    """The meter's edge, reached in two of five passes by a wobble that the file knows."""
    case = passes(rng, 5)
    know_screw(case, rng, um=float(rng.uniform(1, 2)))
    record, machine = case.record, case.machine
    first = np.where(np.isin(record.passes, [2, 4]), 0.0, 150.0)
    error = -case.known[0].amplitude * case.known[0].shape + machine.rational_um_m * record.metres
    starts = record.starts()
    error = error - np.repeat(error[starts], np.diff(np.append(starts, len(record))))
    width = float(rng.uniform(0.4, 0.9))
    pulse = np.mod(first * machine.wavelength_um / 2 + error, machine.range_um)
    shape = np.where(pulse < width, -pulse, np.where(machine.range_um - pulse < width, machine.range_um - pulse, 0))
    record.logs["initial_phase"] = first
    case.decimals["initial_phase"] = 0
    return named(case, Planted("meter-dead-zone", "electronics", shape, level, 1.0, fixed=True,
                               shaped={"width": width}))


def slow_recorder(rng, level):
    """A recorder's lag at three speeds, beside a wave that the file knows."""
    case = passes(rng, 3)
    machine = case.machine
    speeds = [machine.speed_rpm * factor for factor in (1.0, 2.0, 0.5)]
    case.record = records.sampled(rng, machine, records.there_and_back(machine, 3, speeds), 1500, even=False)
    case.columns = ("time_s", "position_mm", "direction", "speed_rpm")
    know_screw(case, rng, um=float(rng.uniform(2, 5)))
    tau = float(rng.uniform(0.3, 1.2))
    shape = lagging(case, tau)
    return named(case, Planted("recorder-lag", "electronics", shape, level, 1.0, fixed=True,
                               shaped={"time_constant": tau}))


def lagging(case, tau):
    """y − e over the record: the wave's steady answer and what the start of each pass adds, in closed form."""
    record, machine, wave = case.record, case.machine, case.known[0]
    degrees = float(machine.effects[0]["phase"].split()[0])
    out = np.empty(len(record))
    for number in np.unique(record.passes):
        rows = np.flatnonzero(record.passes == number)
        first = rows[0]
        t = record.t[rows] - record.t[first]
        mm_s = machine.lead_mm * record.speed[first] / 60 * record.direction[first]
        omega, slope = shapes.TAU * mm_s / machine.screw_mm, machine.rational_um_m * mm_s / 1e3
        angle = shapes.TAU * record.x[first] / machine.screw_mm + np.radians(degrees) + omega * t
        gain, late = 1 / np.hypot(1, omega * tau), np.arctan(omega * tau)
        drive = slope * t - wave.amplitude * np.sin(angle)
        steady = slope * (t - tau) - wave.amplitude * gain * np.sin(angle - late)
        out[rows] = steady + (drive[0] - steady[0]) * np.exp(-t / tau) - drive
    return out


SCENES = [progressive, wear, backlash, targets_reversal, drift, growth, laser_drift, mode_hop, crooked_beam,
          fringe_slip, grating_slip, staircase, dead_zone, slow_recorder]
