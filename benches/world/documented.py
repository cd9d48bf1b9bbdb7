"""δ of an effect from a data file's columns and the documents' formulas alone: the other way to every planted curve."""

import numpy as np

from . import air

AIR = {"air-temperature": (0, "air_temperature_c"), "air-pressure": (1, "air_pressure_hpa"),
       "air-humidity": (2, "humidity_pct")}
# Entry of each effect: what the recorder and the thread see of it.
ENTRY = {"screw-periodic": "motion", "gear-error": "motion", "screw-progressive": "motion", "screw-wear": "motion",
         "backlash": "motion", "wind-up": "motion", "clamping-runout": "workpiece", "grinding-force": "workpiece",
         "workpiece-expansion": "workpiece", "wheel-wear": "workpiece", "steady-sag": "workpiece"}


def number(text):
    return float(text.split()[0]) if isinstance(text, str) else text


class File:
    """A machine file and its table."""

    def __init__(self, machine, columns):
        self.machine, self.columns = machine, columns
        self.rotary = machine.get("output", {}).get("rotary", False)
        self.lead = 1296.0 if self.rotary else number(machine["workpiece"]["lead"])
        self.t = columns.get("time_s", np.zeros(len(columns["pass"])))
        self.x = columns.get("position_mm", self.t * number(machine["spindle"]["speed"]) / 60 * self.lead)
        self.turns, self.metres = self.x / self.lead, self.x / 1e3
        laser = machine["laser"]
        self.half_wave = number(laser["wavelength"]) / 2
        self.reference = [number(laser["reference_" + key]) for key in ("temperature", "pressure", "humidity")]

    def ground(self):
        out = np.zeros(len(self.t))
        for one in np.unique(self.columns["pass"]):
            rows = self.columns["pass"] == one
            out[rows] = np.abs(self.x[rows] - self.x[rows][0])
        return out

    def since_turning(self):
        way, passes = self.columns["direction"], self.columns["pass"]
        out, turned = np.full(len(self.t), 1e6), None
        for row in range(1, len(out)):
            if passes[row] != passes[row - 1]:
                turned = None
            elif way[row] != way[row - 1]:
                turned = (self.x[row] + self.x[row - 1]) / 2
            out[row] = 1e6 if turned is None else abs(self.x[row] - turned)
        return out

    def rational(self):
        """Slope that the machine file itself implies."""
        if self.rotary:
            return 0.0
        wheels, lines = self.machine["dividers"], self.machine["grating"]["lines"]
        return 1e6 * (lines * wheels["b"] * self.half_wave / (self.lead * 1e3 * wheels["a"]) - 1)


def sine(waves, degrees):
    return np.sin(2 * np.pi * waves + np.radians(degrees))


def thin(file, **changed):
    here = list(file.reference)
    for nth, column in AIR.values():
        if column in changed:
            here[nth] = changed[column]
    return 1e6 * (1 - air.index(*here) / air.index(*file.reference))


def delta(effect, p, file):
    """None for an effect that needs more than columns: the loop's, the meter's, the recorder's own."""
    column, x, t = file.columns, file.x, file.t
    if effect in AIR:
        name = AIR[effect][1]
        return file.metres * thin(file, **{name: column[name]})
    formulas = {
        "screw-periodic": lambda: p["amplitude"] * sine(
            p.get("harmonic", 1) * x / number(file.machine["lead_screw"]["lead"]), p["phase"]),
        "gear-error": lambda: p["amplitude"] * sine(p["order"] * file.turns, p["phase"]),
        "grating-graduation": lambda: p["amplitude"] * sine(p["harmonic"] * file.turns, p["phase"]),
        "grating-eccentricity": lambda: file.lead * p["eccentricity"] * sine(file.turns, p["phase"]) / (
            np.pi * number(file.machine["grating"]["diameter"])),
        "clamping-runout": lambda: p["amplitude1"] * sine(file.turns, p["phase1"])
        + p["amplitude2"] * sine(2 * file.turns, p["phase2"]),
        "screw-progressive": lambda: p["linear"] * file.metres + p["quadratic"] * file.metres**2,
        "screw-wear": lambda: p["height"] * np.exp(-((x - p["position"]) ** 2) / 2 / p["width"] ** 2),
        "backlash": lambda: p["width"] * column["direction"] / 2,
        "wind-up": lambda: column["direction"] * column["force_n"] * p["compliance"] * (
            1 - 2 * np.exp(-file.since_turning() / p["sliding_distance"])),
        "dead-path": lambda: p["path"] * thin(file, **{name: column[name] for _, name in AIR.values()
                                                       if name in column}),
        "laser-drift": lambda: file.metres * (p.get("rate", 0) * t / 3600 + p.get("hop", 0) * (
            t >= p.get("hop_time", 0))),
        "abbe": lambda: 4.848e-3 * p["offset"] * column["bed_pitch_arcsec"],
        "fringe-slip": lambda: p["count"] * file.half_wave * (t >= p["time"]),
        "grating-slip": lambda: p["count"] * file.lead * 1e3 / file.machine["grating"]["lines"] * (t >= p["time"]),
        "lost-steps": lambda: p["count"] * number(file.machine["drive"]["step"]) * (t >= p["time"]),
        "lever-ratio": lambda: (1 - p["gain"]) * number(file.machine["drive"]["step"]) * column["steps"],
        "workpiece-expansion": lambda: -number(file.machine["workpiece"]["expansion"]) * file.metres * (
            column["workpiece_temperature_c"] - 20),
        "grinding-force": lambda: p["compliance"] * column["force_n"],
        "wheel-wear": lambda: -p["rate"] * file.ground() / 1e3,
        "steady-sag": lambda: p["amplitude"] * np.sin(np.pi * x / p["spacing"]) ** 2,
        "headstock-growth": lambda: p["amplitude"] * (1 - np.exp(-t / p["time_constant"])),
        "phase-drift": lambda: p["rate"] * t / 3600,
        "compensator-staircase": lambda: np.sign(p["rate"]) * file.half_wave * np.floor(
            x * 1e-3 * abs(p["rate"]) / file.half_wave),
    }
    return formulas[effect]() if effect in formulas else None


def seen(effect, values, channel):
    """What a channel shows of δ with the loop open."""
    entry = ENTRY.get(effect, "reference")
    if channel == "lead_error_um":
        return values if entry in ("motion", "workpiece") else 0 * values
    return -values if entry == "motion" else 0 * values if entry == "workpiece" else values
