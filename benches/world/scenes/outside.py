"""Shapes that the catalogue does not have: right is `unexplained`, or a formula of that shape.

Sized so that what two effects of the catalogue leave of them is eight standard errors or more.
"""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Case, Planted
from ..machine import telescope
from ..noise import Noise
from .logs import log_air, today
from .nothing import plain
from .periodic import phase, resolved
from .smooth import passes


def outside(case, shape, level, entry="motion", near=(), formula=(), scaled=None, shaped=None):
    """`formula` are the words by which `helixlock discover` knows this shape; none when it has no formula."""
    case.expect, case.allowed = "outside", set(near)
    case.planted = [Planted("outside", entry, shape, max(15.0, 2.0 * level), scaled=scaled or {}, shaped=shaped or {})]
    case.formula = [formula] if isinstance(formula, str) else list(formula)
    return case


def along(case):
    """Travel as a share of the length."""
    return case.record.x / case.machine.length_mm


def kink(rng, level):
    case = passes(rng, 2)
    place, length = rng.uniform(0.35, 0.7), case.machine.length_mm
    return outside(case, np.maximum(along(case) - place, 0), level, formula="kink at one place",
                   scaled={"size": 1 / length}, shaped={"at_mm": place * length})


def square_wave(rng, level):
    """A face cam: one half of every turn stands higher."""
    case = resolved(rng, 8)
    return outside(case, np.sign(shapes.sine(case.record.turns, phase(rng)) + 1e-9), level,
                   formula="square wave each turn", scaled={"size": 2.0})


def comb(rng, level):
    """A chipped tooth: one short knock every so many turns, an order that no wheel has."""
    case = resolved(rng, 4, rows=2500)
    order = float(rng.uniform(0.11, 0.19))
    share = np.mod(order * case.record.turns + rng.uniform(), 1)
    return outside(case, np.exp(-0.5 * ((share - 0.5) / 0.07) ** 2), level, formula="knocks at even distances",
                   scaled={"size": 1.0}, shaped={"period_mm": case.machine.lead_mm / order, "width": 0.07})


def half_wave(rng, level):
    case = passes(rng, 2)
    period = rng.uniform(0.3, 0.6)
    return outside(case, np.maximum(np.sin(2 * np.pi * along(case) / period + rng.uniform(0, 6)), 0), level,
                   formula="half waves", scaled={"size": 1.0}, shaped={"period_mm": period * case.machine.length_mm})


def triangle(rng, level):
    case = passes(rng, 2)
    period = rng.uniform(0.5, 0.9)
    return outside(case, np.abs(np.mod(along(case) / period + rng.uniform(), 1) - 0.5), level, formula="triangles",
                   scaled={"size": 1.0}, shaped={"period_mm": period * case.machine.length_mm})


def root(rng, level):
    case = passes(rng, 2)
    length = case.machine.length_mm
    return outside(case, np.sqrt(np.maximum(along(case) - 20 / length, 0)), 30, formula="root from one place on",
                   scaled={"size": length ** -0.5}, shaped={"at_mm": 20.0})


def rise_and_fall(rng, level):
    """Coolant warms the head, then the room takes the heat away."""
    case = passes(rng, 4)
    s = case.record.t / case.record.t[-1]
    peak = rng.uniform(0.12, 0.25)
    return outside(case, s / peak * np.exp(1 - s / peak), level, "length-reference", formula="rise and fall",
                   scaled={"size": 1.0}, shaped={"peak_s": peak * case.record.t[-1]})


def unlisted_order(rng, level):
    case = resolved(rng, 9)
    order = unlisted(rng, case)
    return outside(case, shapes.gear(case.record, order, phase(rng)), level, formula="sine of an order",
                   scaled={"amplitude": 1.0}, shaped={"order": order})


def unlisted_worm(rng, level):
    """A telescope whose file knows no worm: at one speed no clock tells its wave from an order."""
    machine = telescope(rng, listed=False)
    teeth = float(rng.choice([144, 180, 225, 360]))
    period = 86164.1 / teeth
    record = records.clocked(rng, machine, float(rng.uniform(4, 9)) * period, float(rng.uniform(2, 5)))
    noise = Noise(float(rng.uniform(0.4, 0.9)), float(rng.uniform(0.2, 0.5)), float(rng.uniform(8, 30)))
    case = Case("", "outside", machine, record, channels={"error_arcsec": noise}, columns=("time_s",))
    return outside(case, shapes.gear(record, teeth, phase(rng)), level, formula=("sine of an order", "sine in time"),
                   scaled={"amplitude": 1.0})


def unlisted(rng, case):
    """An order that is no wheel's, no overtone of spindle, screw or wheel."""
    taken = [order * k for order in case.machine.lines_of_train() for k in range(1, 9)] + list(range(1, 30))
    taken += [k * case.machine.lead_mm / case.machine.screw_mm for k in range(1, 30)]
    while True:
        order = float(np.round(rng.uniform(1.3, 7.5), 3))
        if min(abs(order - other) for other in taken) > 0.06:
            return order


def bed_temperature(rng, level):
    """The bed's scale grows: travel times its temperature, logged, and no effect of the catalogue."""
    case = passes(rng, 4, length_mm=800.0)
    true = 21 + records.course(rng, case.record.t, 0.5)
    records.log(rng, case.record, "bed_temperature_c", true, 0.01, 0.004)
    return outside(case, case.record.metres * (true - 20), level, formula="straight relation times the travel",
                   scaled={"size": 1e-3})


def lagged_column(rng, level):
    """The spindle oil's temperature, felt minutes later."""
    case = passes(rng, 4)
    t = case.record.t
    true = 24 + records.course(rng, t, 1.0, "wave")
    records.log(rng, case.record, "oil_temperature_c", true, 0.01, 0.005)
    return outside(case, shapes.first_order(t, true, 0.08 * t[-1]), level, "length-reference",
                   formula="late relation", scaled={"size": 1.0}, shaped={"late_s": 0.08 * t[-1]})


def resonance(rng, level):
    """A wheel's wave that swells at one speed: two of four passes near it."""
    case = resolved(rng, 8)
    machine = case.machine
    speeds = [machine.speed_rpm * factor for factor in (0.6, 1.0, 1.25, 2.0)]
    case.record = records.sampled(rng, machine, records.there_and_back(machine, 4, speeds), 2000, even=False)
    case.columns = ("time_s", "position_mm", "direction", "speed_rpm")
    order = machine.gears[0][1]
    ratio = case.record.speed / (machine.speed_rpm * 1.1)
    swell = 1 / np.hypot(1 - ratio**2, 0.15 * ratio)
    late = np.degrees(np.arctan2(0.15 * ratio, 1 - ratio**2))
    wave = np.sin(shapes.TAU * order * case.record.turns - np.radians(late))
    return outside(case, swell * wave, max(level, 15), near={"gear-error"}, formula="resonance of a shaft's wave",
                   scaled={"amplitude": 1.0}, shaped={"resonance_rpm": 1.1 * machine.speed_rpm, "damping": 0.075})


def stick_slip(rng, level):
    case = plain(rng, rows=2000)
    travel = np.ptp(case.record.x)
    jumps = shapes.stick_slip(case.record, travel / rng.uniform(25, 50))
    return outside(case, jumps, max(level, 12), near={"stick-slip"})


def thermostat(rng, level):
    """A cooler that a relay switches by the oil's temperature, with hysteresis."""
    case = passes(rng, 4)
    true = 22 + records.course(rng, case.record.t, 1.0, "wave")
    records.log(rng, case.record, "oil_temperature_c", true, 0.01, 0.005)
    return outside(case, shapes.relay(true, 21.6, 22.4), level, "length-reference", formula="relay",
                   scaled={"size": 2.0})


def delayed_air(rng, level):
    """The beam is enclosed: its air follows the logged one by minutes."""
    case = passes(rng, 4, length_mm=800.0)
    today(rng, case)
    true = log_air(case, rng, "air-temperature", case.machine.reference[0], 1.0, 60.0)
    late = shapes.first_order(case.record.t, true, 0.07 * case.record.t[-1])
    shape = case.record.metres * shapes.thin_air(case.record, case.machine, celsius=late)
    case = outside(case, shape, level, "length-reference", {"air-temperature"},
                   formula="late relation times the travel", shaped={"late_s": 0.07 * case.record.t[-1]})
    case.planted[0].fixed, case.planted[0].level = True, 50.0
    return case


def slope_by_column(rng, level):
    """Coolant flow bends the bed: travel times a column that nobody knows."""
    case = passes(rng, 4)
    flow = 12 + 3 * records.course(rng, case.record.t, 1.0)
    records.log(rng, case.record, "coolant_l_min", flow, 0.01, 0.02, 0)
    return outside(case, case.record.metres * (flow - 12), level, formula="straight relation times the travel",
                   scaled={"size": 1e-3})


def modulated_gear(rng, level):
    """A wheel whose wave swells with another wheel's turn."""
    case = resolved(rng, 9, rows=2500)
    one, two = (order for _, order, _ in case.machine.gears[:2])
    swell = 1 + 0.9 * shapes.sine(two * case.record.turns, phase(rng))
    return outside(case, swell * shapes.gear(case.record, one, phase(rng)), max(level, 15), near={"gear-error"},
                   formula="sine that swells with a turn", scaled={"amplitude": 1.0})


def knock(rng, level):
    """A shift for good that is no whole number of fringes, lines or steps."""
    case = passes(rng, 2)
    at = float(np.quantile(case.record.t[case.record.passes == 1], rng.uniform(0.3, 0.7)))
    case = outside(case, case.machine.wavelength_um / 2 * (case.record.t >= at), level, formula="step at one moment",
                   scaled={"size": case.machine.wavelength_um / 2}, shaped={"at_s": at})
    case.planted[0].fixed, case.planted[0].level = True, 40.0
    case.planted[0].amplitude, case.planted[0].size_um = 0.5, case.machine.wavelength_um / 2
    return case


def rack(rng, level):
    """A rack's joint: a sawtooth over travel."""
    case = passes(rng, 2, rows=1500)
    period = rng.uniform(31, 57)
    return outside(case, np.mod(case.record.x / period, 1), level, formula="sawtooth", scaled={"size": 1.0},
                   shaped={"period_mm": period})


def creeping_belt(rng, level):
    """A belt that slips: its wave's period grows along the travel."""
    case = resolved(rng, 6)
    turns = case.record.turns
    grown = turns + rng.uniform(0.02, 0.05) * (turns - turns.min()) ** 2 / np.ptp(turns)
    return outside(case, shapes.sine(unlisted(rng, case) * grown, phase(rng)), level)


def parabola_in_time(rng, level):
    """A load that is hoisted ever faster onto the foundation."""
    case = passes(rng, 4)
    return outside(case, (case.record.t / case.record.t[-1]) ** 2, 30, "length-reference", formula="parabola",
                   scaled={"size": case.record.t[-1] ** -2})


SCENES = [kink, square_wave, comb, half_wave, triangle, root, rise_and_fall, unlisted_order, unlisted_worm,
          bed_temperature, lagged_column, resonance, stick_slip, thermostat, delayed_air, slope_by_column,
          modulated_gear, knock, rack, creeping_belt, parabola_in_time]
