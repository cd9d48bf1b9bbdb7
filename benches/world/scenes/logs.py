"""One effect of the catalogue that follows a logged column, or that the thread alone shows."""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Planted
from ..noise import workshop
from .periodic import named
from .smooth import both_ways, passes

AIR = {
    "air-temperature": ("air_temperature_c", "celsius", 0.01, 0.004),
    "air-pressure": ("air_pressure_hpa", "hpa", 0.01, 0.01),
    "air-humidity": ("humidity_pct", "percent", 0.1, 0.05),
}


def log_air(case, rng, name, mean, swing, every_s=None):
    """Logs one quantity of the air; returns its true course."""
    column, _, resolution, noise = AIR[name]
    every_s = float(rng.choice([0, 60, 60])) if every_s is None else every_s
    true = mean + records.course(rng, case.record.t, swing)
    case.decimals[column] = 2
    return records.log(rng, case.record, column, true, resolution, noise, every_s)


def plant_air(case, rng, name, level, fixed=True):
    """The day's means stand in the file as the laser's reference, so only what changes is missing."""
    nth = list(AIR).index(name)
    swing = float(rng.uniform(0.5, 1.5)) * (1.0, 2.0, 10.0)[nth]
    true = log_air(case, rng, name, case.machine.reference[nth], swing)
    shape = case.record.metres * shapes.thin_air(case.record, case.machine, **{AIR[name][1]: true})
    return Planted(name, "length-reference", shape, level, 1.0, fixed=fixed, shaped={"scale": 1.0})


def today(rng, case):
    """The laser is set to today's air."""
    case.machine.reference = (float(np.round(rng.uniform(19, 22), 1)), float(np.round(rng.uniform(985, 1030), 1)),
                              float(np.round(rng.uniform(35, 60))))


def air_scene(name):
    def scene(rng, level):
        case = passes(rng, 4, length_mm=800.0)
        today(rng, case)
        return named(case, plant_air(case, rng, name, level))
    scene.__name__ = name.replace("-", "_")
    return scene


def dead_path(rng, level):
    """The carriage's air is compensated; the path before it is not."""
    case = passes(rng, 3)
    today(rng, case)
    t, p, _ = case.machine.reference
    celsius = log_air(case, rng, "air-temperature", t, float(rng.uniform(0.5, 1.2)))
    hpa = log_air(case, rng, "air-pressure", p, 1.0)
    shape = shapes.thin_air(case.record, case.machine, celsius=celsius, hpa=hpa)
    return named(case, Planted("dead-path", "length-reference", shape, level, float(rng.uniform(0.1, 0.5)), fixed=True,
                               scaled={"path": 1.0}))


def tilted_beam(rng, level):
    """The carriage pitches along the bed; an electronic level logs it."""
    case = passes(rng, 2)
    s = case.record.x / case.machine.length_mm
    true = 2.0 * np.sin(2 * np.pi * 1.3 * s + rng.uniform(0, 6)) + rng.uniform(-1, 1) * s
    records.log(rng, case.record, "bed_pitch_arcsec", true, 0.01, 0.02, 0)
    return named(case, Planted("abbe", "length-reference", np.pi / 648000 * 1e3 * true, level,
                               float(rng.uniform(20, 80)), fixed=True, scaled={"offset": 1.0}))


def force_of(case, rng):
    true = 60 + 25 * records.course(rng, case.record.t, 1.0, "wave") + 5 * np.sin(case.record.x / 17)
    return records.log(rng, case.record, "force_n", true, 0.1, 0.2, 0)


def wind_up(rng, level):
    case = both_ways(rng)
    way = float(rng.uniform(0.3, 2))
    shape = shapes.wound_up(case.record, force_of(case, rng), way)
    return named(case, Planted("wind-up", "motion", shape, level, scaled={"compliance": 1.0},
                               shaped={"sliding_distance": way}))


def with_thread(rng, times=2, both=None):
    """The finished thread, sometimes with the recorder beside it."""
    case = passes(rng, times)
    both = bool(rng.random() < 0.5) if both is None else both
    noise = workshop(rng, float(rng.uniform(0.03, 0.1)))
    case.channels = ({"error_um": case.channels["error_um"]} if both else {}) | {"lead_error_um": noise}
    return case


def warm_workpiece(rng, level):
    case = with_thread(rng, 3)
    true = 20 + rng.uniform(-0.3, 0.3) + records.course(rng, case.record.t, float(rng.uniform(0.15, 0.5)))
    records.log(rng, case.record, "workpiece_temperature_c", true, 0.01, 0.004, float(rng.choice([0, 60])))
    shape = shapes.expansion(case.record, case.machine, true)
    return named(case, Planted("workpiece-expansion", "workpiece", shape, level, 1.0, fixed=True,
                               shaped={"scale": 1.0}))


def grinding_force(rng, level):
    case = with_thread(rng)
    return named(case, Planted("grinding-force", "workpiece", force_of(case, rng), level, scaled={"compliance": 1.0}))


def wheel_wear(rng, level):
    """Dressed between the passes; forward and reverse."""
    case = with_thread(rng, 3, both=True)
    return named(case, Planted("wheel-wear", "workpiece", -case.record.ground / 1e3, level, scaled={"rate": 1.0}))


def sag(rng, level):
    case = with_thread(rng, 2, both=True)
    spacing = float(rng.uniform(0.25, 0.5) * case.machine.length_mm)
    return named(case, Planted("steady-sag", "workpiece", np.sin(np.pi * case.record.x / spacing) ** 2, level,
                               scaled={"amplitude": 1.0}, shaped={"spacing": spacing}))


SCENES = [air_scene(name) for name in AIR] + [dead_path, tilted_beam, wind_up, warm_workpiece, grinding_force,
                                              wheel_wear, sag]
