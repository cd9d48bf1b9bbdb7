"""What else in the catalogue could draw the same curve: columns of every effect that these data could show."""

import numpy as np

from . import shapes

# Places of shape parameters that are tried: enough that a fit between them gains little.
BUMPS, WIDTHS, STEPS, TAUS, SPACINGS, PLAYS = 24, 7, 60, 10, 14, 12


def waves(argument):
    return [np.sin(shapes.TAU * argument), np.cos(shapes.TAU * argument)]


def rivals(machine, record, channels):
    """(effect, entry, columns) for every effect and every place of its shape."""
    out = periodic(machine, record) + smooth(machine, record) + logged(machine, record) + sudden(machine, record)
    if "commanded_um" in record.true:
        out += actuator(record)
    if "lead_error_um" in channels:
        out += thread(machine, record)
    return out


def periodic(machine, record):
    out = [("gear-error", "motion", waves(order * record.turns)) for order in machine.lines_of_train()]
    out.append(("grating-eccentricity", "angle-reference", waves(record.turns)))
    out += [("grating-graduation", "angle-reference", waves(k * record.turns)) for k in range(2, 25)]
    if not machine.rotary:
        out += [("screw-periodic", "motion", waves(k * record.x / machine.screw_mm)) for k in range(1, 13)]
    hertz = machine.speed_rpm / 60
    orders = machine.lines_of_train() + [machine.lead_mm / machine.screw_mm, 1.0, 2.0]
    out += [("vibration", "motion", waves(order * hertz * record.t)) for order in orders]
    return out


def smooth(machine, record):
    x, t = record.metres, record.t
    out = [("phase-drift", "electronics", [t]), ("laser-drift", "length-reference", [x * t])]
    for tau in np.geomspace(0.05, 3, TAUS) * (t[-1] - t[0]):
        out.append(("headstock-growth", "length-reference", [1 - np.exp(-t / tau)]))
    if machine.rotary:
        return out
    out += [("screw-progressive", "motion", [x**power for power in range(1, top + 1)]) for top in (1, 2, 3)]
    out.append(("cosine", "length-reference", [x]))
    span = np.ptp(record.x)
    for width in np.geomspace(0.02, 0.6, WIDTHS) * span:
        for place in np.linspace(record.x.min(), record.x.max(), BUMPS):
            out.append(("screw-wear", "motion", [shapes.bump(record, place, width)]))
    if np.any(record.direction != record.direction[0]):
        out.append(("backlash", "motion", [record.direction / 2]))
    return out


def logged(machine, record):
    x, true = record.metres, record.true
    out = []
    air = dict(air_temperature_c="celsius", air_pressure_hpa="hpa", humidity_pct="percent")
    for column, keyword in air.items():
        if column in true:
            thin = shapes.thin_air(record, machine, **{keyword: true[column]})
            out.append(({"celsius": "air-temperature", "hpa": "air-pressure", "percent": "air-humidity"}[keyword],
                        "length-reference", [x * thin]))
    if "air_temperature_c" in true:
        logs = {keyword: true[column] for column, keyword in air.items() if column in true}
        out.append(("dead-path", "length-reference", [shapes.thin_air(record, machine, **logs)]))
    if "bed_pitch_arcsec" in true:
        out.append(("abbe", "length-reference", [true["bed_pitch_arcsec"]]))
    if "force_n" in true:
        for way in (0.1, 1.0, 5.0):
            out.append(("wind-up", "motion", [shapes.wound_up(record, true["force_n"], way)]))
    return out


def actuator(record):
    """A lever of another ratio, play of several widths: functions of what the counter commands."""
    commanded = record.true["commanded_um"]
    out = [("lever-ratio", "actuator", [commanded])]
    for width in np.geomspace(0.03, 3, PLAYS):
        out.append(("corrector-lost-motion", "actuator", [commanded - shapes.play(commanded, width)]))
    return out


def sudden(machine, record):
    out = []
    for at in np.linspace(record.t[0], record.t[-1], STEPS + 2)[1:-1]:
        after = (record.t >= at).astype(float)
        out.append(("fringe-slip", "length-reference", [after]))
        if not machine.rotary:
            hop = record.metres * after
            out += [("laser-drift", "length-reference", block) for block in ([hop], [record.metres * record.t, hop])]
    return out


def thread(machine, record):
    x, true = record.metres, record.true
    out = [("clamping-runout", "workpiece", waves(record.turns)), ("wheel-wear", "workpiece", [record.ground])]
    out.append(("clamping-runout", "workpiece", waves(record.turns) + waves(2 * record.turns)))
    for spacing in np.geomspace(40, 1500, SPACINGS):
        out.append(("steady-sag", "workpiece", [np.sin(np.pi * record.x / spacing) ** 2]))
    if "workpiece_temperature_c" in true:
        out.append(("workpiece-expansion", "workpiece", [x * (true["workpiece_temperature_c"] - 20)]))
    if "force_n" in true:
        out.append(("grinding-force", "workpiece", [true["force_n"]]))
    return out
