"""Nothing hidden: the file holds all there is, and what is left is noise of every colour."""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Case, Planted
from ..machine import grinder, telescope
from ..noise import Noise, workshop


def plain(rng, rows=None, noise=None, legs=None, **over):
    """A recorder over one to three passes: where most scenes begin."""
    machine = grinder(rng, **over)
    legs = legs(machine) if legs else records.there_and_back(machine, int(rng.integers(1, 4)))
    rows = rows or int(rng.choice([300, 500, 900, 1500, 2500]))
    record = records.sampled(rng, machine, legs, rows)
    noise = noise or workshop(rng)
    columns = ("time_s", "position_mm") + (("direction", "speed_rpm") if np.any(record.direction < 0) else ())
    return Case("", "nothing", machine, record, channels={"error_um": noise}, columns=columns)


def know(case, name, entry, shape, amplitude, table):
    """An effect that the file holds as it is."""
    case.known.append(Planted(name, entry, shape, amplitude=amplitude))
    case.machine.effects.append(table)


def know_screw(case, rng, um=None):
    um, phase = float(rng.uniform(0.5, 3)) if um is None else um, float(np.round(rng.uniform(-180, 180), 1))
    um = float(np.round(um, 3))
    shape = shapes.screw(case.record, case.machine, 1, phase)
    table = {"kind": "screw-periodic", "amplitude": f"{um!r} um", "phase": f"{phase!r} deg"}
    know(case, "screw-periodic", "motion", shape, um, table)


def know_slope(case, rng, linear=None, quadratic=None):
    linear = float(np.round(rng.uniform(-40, 40), 1)) if linear is None else linear
    quadratic = float(np.round(rng.uniform(-30, 30), 1)) if quadratic is None else quadratic
    x = case.record.metres
    table = {"kind": "screw-progressive", "linear": f"{linear!r} um/m", "quadratic": f"{quadratic!r} um/m^2"}
    know(case, "screw-progressive", "motion", linear * x + quadratic * x**2, 1.0, table)


def nothing_white(rng, level):
    return plain(rng, noise=Noise(float(rng.uniform(0.02, 0.1))))


def nothing_coloured(rng, level):
    white = float(rng.uniform(0.02, 0.05))
    return plain(rng, noise=Noise(white, white * float(rng.uniform(0.6, 2)), float(rng.uniform(10, 60))))


def nothing_slow_noise(rng, level):
    """A drift that is plainly noise: its memory is a tenth of the pass or less, and it is large."""
    white = float(rng.uniform(0.02, 0.05))
    case = plain(rng, rows=1500)
    seconds = np.ptp(case.record.t) / len(np.unique(case.record.passes))
    case.channels["error_um"] = Noise(white, 3 * white, seconds * float(rng.uniform(0.04, 0.1)))
    return case


def nothing_tails(rng, level):
    return plain(rng, noise=Noise(0.05, 0.02, 40, tails=3, outliers=0.004))


def nothing_known_effects(rng, level):
    case = plain(rng)
    know_screw(case, rng)
    know_slope(case, rng)
    return case


def nothing_compensated_air(rng, level):
    """The air is logged and changes, but a wavelength compensator takes it out."""
    case = plain(rng, rows=1200)
    t = case.record.t
    records.log(rng, case.record, "air_temperature_c", 20.4 + records.course(rng, t, 0.6), 0.01, 0.005)
    records.log(rng, case.record, "air_pressure_hpa", 1009 + records.course(rng, t, 1.5), 0.1, 0.03)
    case.record.true.clear()
    return case


def nothing_few_rows(rng, level):
    return plain(rng, rows=200)


def nothing_many_rows(rng, level):
    return plain(rng, rows=int(rng.choice([9000, 20000, 50000])), length_mm=800.0, range=1,
                 noise=Noise(0.04, 0.02, 30))


def nothing_rotary(rng, level):
    machine = telescope(rng)
    record = records.clocked(rng, machine, float(rng.uniform(1500, 4000)), float(rng.uniform(2, 4)))
    noise = Noise(float(rng.uniform(0.4, 1.0)), float(rng.uniform(0.2, 0.6)), float(rng.uniform(10, 40)))
    return Case("", "nothing", machine, record, channels={"error_arcsec": noise}, columns=("time_s",))


def nothing_thread(rng, level):
    case = plain(rng)
    case.channels["lead_error_um"] = workshop(rng, float(rng.uniform(0.03, 0.1)))
    return case


SCENES = [nothing_white, nothing_coloured, nothing_slow_noise, nothing_tails, nothing_known_effects,
          nothing_compensated_air, nothing_few_rows, nothing_many_rows, nothing_rotary, nothing_thread]
