"""Mistakes of input, where the data show them, and sound data that only look odd."""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Planted
from ..machine import DIVIDERS
from ..noise import Noise
from .logs import log_air, with_thread
from .nothing import know, know_screw, know_slope, plain
from .periodic import named
from .smooth import passes


def doubtful(case, *words):
    case.expect, case.doubts = "doubt", words
    return case


def known_well(rng):
    """A file that the machine obeys, with effects far above the noise."""
    case = plain(rng, rows=900, noise=Noise(0.04, 0.02, 40), legs=lambda machine: records.there_and_back(machine, 2))
    know_screw(case, rng, um=float(rng.uniform(1.5, 3)))
    know_slope(case, rng, linear=float(np.round(rng.uniform(15, 40), 1)))
    return case


def sign_flipped(rng, level):
    case = known_well(rng)
    def mend(columns, case):
        columns["error_um"] = -columns["error_um"]
    case.mend = mend
    return doubtful(case, "sign")


def millimetres_for_micrometres(rng, level):
    """The column's name says µm, the cells hold mm."""
    case = known_well(rng)
    def mend(columns, case):
        columns["error_um"] = columns["error_um"] / 1000
        case.decimals["error_um"] += 3
    case.mend = mend
    return doubtful(case, "unit", "1000", "scale", "mm", "factor")


def nanometres_for_micrometres(rng, level):
    case = known_well(rng)
    def mend(columns, case):
        columns["error_um"] = columns["error_um"] * 1000
        case.decimals["error_um"] = 0
    case.mend = mend
    return doubtful(case, "unit", "1000", "scale", "nm", "factor")


def airy(rng):
    """Air that the file knows of, logged and far above the noise."""
    case = passes(rng, 4, length_mm=800.0, noise=Noise(0.04, 0.02, 40))
    case.machine.reference = (20.0, 1013.25, 50.0)
    celsius = log_air(case, rng, "air-temperature", 20.5, 1.0, 60.0)
    hpa = log_air(case, rng, "air-pressure", 1008.0, 2.0, 60.0)
    for name, logs in (("air-temperature", {"celsius": celsius}), ("air-pressure", {"hpa": hpa})):
        shape = case.record.metres * shapes.thin_air(case.record, case.machine, **logs)
        know(case, name, "length-reference", shape, 1.0, {"kind": name})
    return case


def fahrenheit(rng, level):
    case = airy(rng)
    def mend(columns, case):
        columns["air_temperature_c"] = np.round(columns["air_temperature_c"] * 1.8 + 32, 2)
    case.mend = mend
    return doubtful(case, "fahrenheit", "unit", "°f", "temperature")


def millimetres_of_mercury(rng, level):
    case = airy(rng)
    def mend(columns, case):
        columns["air_pressure_hpa"] = np.round(columns["air_pressure_hpa"] * 760 / 1013.25, 2)
    case.mend = mend
    return doubtful(case, "mmhg", "torr", "unit", "pressure")


def temperatures_swapped(rng, level):
    """Air and workpiece: each under the other's name; both effects stand in the file."""
    case = with_thread(rng, 4, both=True)
    case.channels = {name: Noise(0.04, 0.02, 40) for name in case.channels}
    case.machine.reference = (20.0, 1013.25, 50.0)
    t = case.record.t
    air = log_air(case, rng, "air-temperature", 21.0, 1.2, 60.0)
    work = 23 + records.course(rng, t, 0.8)
    records.log(rng, case.record, "workpiece_temperature_c", work, 0.01, 0.004)
    x = case.record.metres
    know(case, "air-temperature", "length-reference", x * shapes.thin_air(case.record, case.machine, celsius=air), 1.0,
         {"kind": "air-temperature"})
    know(case, "workpiece-expansion", "workpiece", shapes.expansion(case.record, case.machine, work), 1.0,
         {"kind": "workpiece-expansion"})
    def mend(columns, case):
        one, two = "air_temperature_c", "workpiece_temperature_c"
        columns[one], columns[two] = columns[two], columns[one]
    case.mend = mend
    return doubtful(case, "swap", "column", "exchang")


def wrong_dividers(rng, level):
    """The machine's wheel B stands one or two off: the recorder climbs by thousands of µm/m."""
    case = plain(rng, rows=900, legs=lambda machine: records.there_and_back(machine, 2))
    told = case.machine.b
    wheel = told + int(rng.choice([-2, -1, 1, 2]))
    case.notes = f"b is {wheel}, the file says {told}"
    case.expect, case.doubts, case.allowed = "setting", ("divider", "setting", "lead", "ratio"), {"wrong-setting"}
    slope = (1e6 + case.machine.rational_um_m) * (wheel / told - 1)
    case.known.append(Planted("wrong-setting", "angle-reference", slope * case.record.metres))
    return case


def lead_of_the_neighbour(rng, level):
    """The machine grinds 6 mm rightly; the file holds the dividers of a thread of 5 mm."""
    case = plain(rng, rows=700, lead_mm=6, a=110, b=150)
    case.expect, case.doubts, case.allowed = "setting", ("divider", "setting", "lead", "ratio"), {"wrong-setting"}
    def mend(columns, case):
        case.machine.a, case.machine.b = DIVIDERS[5]
    case.mend = mend
    return case


def position_offset(rng, level):
    """The position's zero is not the file's: all that is fixed to the travel stands shifted by the same way."""
    case = known_well(rng)
    span = case.machine.length_mm
    place, width = float(np.round(0.5 * span)), float(np.round(0.03 * span, 1))
    table = {"kind": "screw-wear", "height": "2.5 um", "position": f"{place!r} mm", "width": f"{width!r} mm"}
    know(case, "screw-wear", "motion", shapes.bump(case.record, place, width), 2.5, table)
    offset = float(np.round(rng.uniform(3, 9) * rng.choice([-1, 1]), 2))
    case.notes = f"offset {offset} mm"
    def mend(columns, case):
        columns["position_mm"] = columns["position_mm"] + offset
    case.mend = mend
    return doubtful(case, "position", "offset", "shift")


def sound_altitude(rng, level):
    """A workshop at 2400 m: 760 hPa are sound there."""
    case = passes(rng, 3, length_mm=500.0)
    case.machine.reference = (20.0, 1013.25, 50.0)
    true = log_air(case, rng, "air-pressure", 760.0, 1.0, 60.0)
    shape = case.record.metres * shapes.thin_air(case.record, case.machine, hpa=true)
    return named(case, Planted("air-pressure", "length-reference", shape, None, 1.0, fixed=True, shaped={"scale": 1.0}))


def sound_heat(rng, level):
    """A workshop of 38 °C in summer, known to the file."""
    case = passes(rng, 3)
    case.machine.reference = (20.0, 1013.25, 50.0)
    true = log_air(case, rng, "air-temperature", 38.0, 1.0, 60.0)
    shape = case.record.metres * shapes.thin_air(case.record, case.machine, celsius=true)
    know(case, "air-temperature", "length-reference", shape, 1.0, {"kind": "air-temperature"})
    return case


def sound_large(rng, level):
    """A worn machine: hundreds of micrometres, all of them in the file."""
    case = plain(rng, noise=Noise(0.3, 0.2, 40))
    know_slope(case, rng, linear=float(np.round(rng.uniform(250, 450), 1)), quadratic=-200.0)
    know_screw(case, rng, um=25.0)
    return case


SCENES = [sign_flipped, millimetres_for_micrometres, nanometres_for_micrometres, fahrenheit, millimetres_of_mercury,
          temperatures_swapped, wrong_dividers, lead_of_the_neighbour, position_offset, sound_altitude, sound_heat,
          sound_large]
