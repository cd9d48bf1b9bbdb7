"""Two and three effects in one record."""

import numpy as np

from .. import record as records
from .. import shapes
from ..case import Planted
from .logs import force_of, plant_air, today, with_thread
from .periodic import named, plant_gear, plant_screw, resolved, worm_on_the_sky
from .smooth import both_ways, passes


def strong(level):
    """Effects together are asked about where one could be named."""
    return max(8.0, float(level))


def screw_and_gear(rng, level):
    case = resolved(rng, 8)
    return named(case, plant_screw(case, rng, strong(level)), plant_gear(case, rng, 12))


def two_gears(rng, level):
    case = resolved(rng, 8)
    orders = [order for _, order, _ in case.machine.gears][:2]
    return named(case, *[plant_gear(case, rng, strong(level), order) for order in orders])


def screw_and_wear(rng, level):
    case = resolved(rng, 3)
    span = case.machine.length_mm
    place, width = float(rng.uniform(0.3, 0.7) * span), float(rng.uniform(0.04, 0.09) * span)
    bump = Planted("screw-wear", "motion", shapes.bump(case.record, place, width), strong(level),
                   scaled={"height": 1.0}, shaped={"position": place, "width": width})
    return named(case, plant_screw(case, rng, 15), bump)


def backlash_and_screw(rng, level):
    case = both_ways(rng, rows=1500)
    case.record = records.sampled(rng, case.machine, records.turned_about(case.machine, 2), 1500, even=False)
    play = Planted("backlash", "motion", case.record.direction / 2, strong(level), scaled={"width": 1.0})
    return named(case, plant_screw(case, rng, 20), play)


def warm_air_and_gear(rng, level):
    case = passes(rng, 4, length_mm=800.0, rows=1500)
    legs = records.there_and_back(case.machine, 4)
    case.record = records.sampled(rng, case.machine, legs, 1500, even=False)
    today(rng, case)
    return named(case, plant_air(case, rng, "air-temperature", strong(level)), plant_gear(case, rng, 12))


def weather(rng, level):
    """All three quantities of the air change, as they do."""
    case = passes(rng, 4, length_mm=800.0)
    today(rng, case)
    one = plant_air(case, rng, "air-temperature", 30)
    two = plant_air(case, rng, "air-pressure", None)
    three = plant_air(case, rng, "air-humidity", None)
    return named(case, one, two, three)


def growth_and_screw(rng, level):
    case = resolved(rng, 3)
    legs = records.there_and_back(case.machine, 3)
    case.record = records.sampled(rng, case.machine, legs, 1200, even=False)
    case.columns = ("time_s", "position_mm", "direction")
    tau = float(rng.uniform(0.1, 0.3) * case.record.t[-1])
    warm = Planted("headstock-growth", "length-reference", 1 - np.exp(-case.record.t / tau), strong(level) + 7,
                   scaled={"amplitude": 1.0}, shaped={"time_constant": tau})
    return named(case, plant_screw(case, rng, 12), warm)


def thread_and_recorder(rng, level):
    """The force on the thread, a gear on both."""
    case = with_thread(rng, 2, both=True)
    legs = records.there_and_back(case.machine, 2)
    case.record = records.sampled(rng, case.machine, legs, 1200, even=False)
    soft = Planted("grinding-force", "workpiece", force_of(case, rng), strong(level), scaled={"compliance": 1.0})
    return named(case, plant_gear(case, rng, 12), soft)


def three_at_once(rng, level):
    case = both_ways(rng, rows=1800)
    case.record = records.sampled(rng, case.machine, records.turned_about(case.machine, 2), 1800, even=False)
    play = Planted("backlash", "motion", case.record.direction / 2, strong(level), scaled={"width": 1.0})
    return named(case, plant_screw(case, rng, 20), plant_gear(case, rng, strong(level)), play)


def worm_with_overtones(rng, level):
    """A worm on the sky wobbles twice a turn as well."""
    case = worm_on_the_sky(rng, level)
    order = case.machine.gears[0][1]
    return named(case, plant_gear(case, rng, 25, order), plant_gear(case, rng, strong(level), 2 * order))


SCENES = [screw_and_gear, two_gears, screw_and_wear, backlash_and_screw, warm_air_and_gear, weather, growth_and_screw,
          thread_and_recorder, three_at_once, worm_with_overtones]
