"""Textbook shapes of δ (µm, or arcsec on a rotary chain) for unit amplitude, over a record."""

import numpy as np

from . import air

TAU = 2 * np.pi


def sine(waves, degrees=0.0):
    return np.sin(TAU * waves + np.radians(degrees))


def screw(record, machine, harmonic, degrees):
    """A drunken thread of the machine's own screw: it turns once per lead of travel."""
    return sine(harmonic * record.x / machine.screw_mm, degrees)


def gear(record, order, degrees):
    return sine(order * record.turns, degrees)


def bump(record, place_mm, width_mm):
    return np.exp(-0.5 * ((record.x - place_mm) / width_mm) ** 2)


def eccentric(record, machine, degrees):
    """For 1 µm: the disc's rim reads e·sin θ over its radius as angle; as lead, times S/2π."""
    turn_um = 1296000.0 if machine.rotary else machine.lead_mm * 1e3
    angle_rad = 1.0 / (machine.disc_mm * 1e3 / 2)
    return angle_rad / TAU * turn_um * sine(record.turns, degrees)


def thin_air(record, machine, celsius=None, hpa=None, percent=None):
    """Lengths counted in vacuum wavelengths over n: too short by x·(1 − n/n_ref) when the air is thin."""
    t, p, h = machine.reference
    here = air.index(t if celsius is None else celsius, p if hpa is None else hpa, h if percent is None else percent)
    return 1e6 * (1 - here / air.index(t, p, h))


def expansion(record, machine, celsius):
    return -machine.alpha_ppm * record.metres * (celsius - 20.0)


def wound_up(record, force, sliding_mm):
    """A spring that a turn-about unwinds and winds the other way: from −F to +F over the sliding way."""
    return record.direction * force * (1 - 2 * np.exp(-np.minimum(record.way, 1e6) / sliding_mm))


def first_order(t, driven, tau_s):
    """Output of τ·y' + y = e that starts at rest on e; e is straight between samples."""
    out = np.empty(len(t))
    state = out[0] = driven[0]
    for row in range(1, len(t)):
        gap, slope = t[row] - t[row - 1], 0.0
        if gap > 0:
            slope = (driven[row] - driven[row - 1]) / gap
        decay = np.exp(-gap / tau_s)
        # exact answer to a ramp: e − slope·τ + decaying rest
        state = driven[row] - slope * tau_s + (state - driven[row - 1] + slope * tau_s) * decay
        out[row] = state
    return out


def stairs(record, rate_um_m, wavelength_um):
    """A fringe blocked in every F-th: a loss of half a wavelength after every F fringes of travel."""
    every_mm = 1e6 / abs(rate_um_m) * wavelength_um / 2 / 1e3
    return np.sign(rate_um_m) * wavelength_um / 2 * np.floor(record.x / every_mm)


def play(commanded, width):
    """Backlash between a drive and what it drives: the driven side follows only when a flank is reached."""
    out, place = np.empty(len(commanded)), 0.0
    for row, wanted in enumerate(commanded):
        place = min(max(place, wanted - width / 2), wanted + width / 2)
        out[row] = place
    return out


def stick_slip(record, jump_mm):
    """A sliding mass on a spring: still while the drive goes on, then it jumps; no two jumps are alike."""
    rng = np.random.default_rng(int(jump_mm * 1e6) + len(record))
    out, held = np.empty(len(record)), record.x[0]
    need = jump_mm * rng.uniform(0.7, 1.3)
    for row, place in enumerate(record.x):
        if abs(place - held) > need:
            held, need = place, jump_mm * rng.uniform(0.7, 1.3)
        out[row] = held - place
    return out / (np.ptp(out) + 1e-12)


def relay(column, low, high):
    """Switches on above `high`, off below `low`, and keeps its state between."""
    out, on = np.empty(len(column)), column[0] > (low + high) / 2
    for row, value in enumerate(column):
        on = True if value > high else False if value < low else on
        out[row] = 1.0 if on else -1.0
    return out
