"""A machine: leads, gears, dividers, laser; its numbers for the physics, its text for the program."""

from dataclasses import dataclass, field

# B/A = S·5/22 for the metric track of 13906 lines; A and B below 1000.
DIVIDERS = {4: (110, 100), 5: (132, 150), 6: (110, 150), 8: (88, 160), 10: (66, 150), 12: (55, 150)}
# Wheels between spindle and screw: name, turns per spindle turn, teeth.
TRAINS = [
    [("first change gear", 2.5, 48), ("second change gear", 0.8, 60), ("worm", 7.2, 30)],
    [("stud gear", 1.75, 36), ("idler", 0.6, 70), ("feed worm", 5.4, 25)],
    [("driver", 3.2, 40), ("driven", 1.28, 100)],
]


@dataclass
class Machine:
    lead_mm: float = 6
    length_mm: float = 500
    screw_mm: float = 12
    speed_rpm: float = 6
    gears: list = field(default_factory=lambda: list(TRAINS[0]))
    lines: int = 13906
    disc_mm: float = 200
    wavelength_um: float = 0.63281983
    a: int = 110
    b: int = 150
    range: int = 2
    step_um: float = 0.0125
    step_hz: float = 160
    closed: bool = False
    rotary: bool = False
    alpha_ppm: float = 11.5
    reference: tuple = (20.0, 1013.25, 50.0)
    effects: list = field(default_factory=list)

    @property
    def rational_um_m(self):
        """Slope that the rational dividers leave against the true number of fringes."""
        if self.rotary:
            return 0.0
        turn_by_laser = self.lines * self.b * self.wavelength_um / 2 / self.a  # µm a spindle turn
        return (turn_by_laser / (self.lead_mm * 1e3) - 1) * 1e6

    @property
    def per_turn(self):
        """Comparisons a spindle turn."""
        return self.lines / self.a / self.range

    @property
    def range_um(self):
        return self.range * self.b * self.wavelength_um / 2

    def lines_of_train(self):
        """Every order that the list of gears accounts for: shafts and meshes."""
        shafts = [order for _, order, _ in self.gears]
        return shafts + [order * teeth for _, order, teeth in self.gears if teeth]

    def toml(self):
        out = ['title = "A machine of the second world"']
        if self.rotary:
            out += ["[output]", "rotary = true"]
        else:
            out += ["[workpiece]", f'lead = "{self.lead_mm:g} mm"', f'length = "{self.length_mm:g} mm"']
            out += [f'expansion = "{self.alpha_ppm:g} ppm/K"']
            out += ["[lead_screw]", f'lead = "{self.screw_mm:g} mm"']
        out += ["[spindle]", f'speed = "{self.speed_rpm:.10g} rpm"']
        for name, order, teeth in self.gears:
            out += ["[[gear]]", f'name = "{name}"', f"order = {order!r}"] + ([f"teeth = {teeth}"] if teeth else [])
        out += ["[grating]", f"lines = {self.lines}", f'diameter = "{self.disc_mm:g} mm"']
        t, p, h = self.reference
        out += ["[laser]", f'wavelength = "{self.wavelength_um!r} um"', f'reference_temperature = "{t!r} degC"']
        out += [f'reference_pressure = "{p!r} hPa"', f'reference_humidity = "{h!r} %"']
        out += ["[dividers]", f"a = {self.a}", f"b = {self.b}", f"range = {self.range}"]
        unit = "arcsec" if self.rotary else "um"
        out += ["[drive]", f'step = "{self.step_um:g} {unit}"', f'frequency = "{self.step_hz:g} Hz"']
        out += ["[loop]", f"closed = {str(self.closed).lower()}"]
        for effect in self.effects:
            out += ["[[effect]]"] + [f"{key} = {toml_value(value)}" for key, value in effect.items()]
        return "\n".join(out) + "\n"


def toml_value(value):
    return f'"{value}"' if isinstance(value, str) else repr(value)


def grinder(rng, **over):
    lead = int(rng.choice([4, 5, 6, 8, 10]))
    a, b = DIVIDERS[lead]
    own = dict(
        lead_mm=lead, a=a, b=b, speed_rpm=float(rng.choice([5, 6, 8, 10])),
        length_mm=float(rng.choice([300, 400, 500, 600, 800])), screw_mm=float(rng.choice([9, 12, 14])),
        gears=list(TRAINS[rng.integers(len(TRAINS))]), alpha_ppm=float(rng.choice([10.6, 11.5, 12.0])),
    )
    return Machine(**(own | over))


def telescope(rng, listed=True):
    """A worm drive on the sky: one turn in a sidereal day of 86164.1 s."""
    teeth = int(rng.choice([144, 180, 225, 360]))
    return Machine(
        rotary=True, speed_rpm=60 / 86164.1, gears=[("worm", float(teeth), 0)] if listed else [], step_um=0.01,
        lead_mm=1296000e-3,
    )


def rotary_table(rng):
    """A dividing table on its worm, 90 to 1; its own bearing stands in the list of wheels."""
    return Machine(rotary=True, speed_rpm=float(rng.choice([0.2, 0.5])), step_um=0.01, lead_mm=1296000e-3,
                   gears=[("table", 1.0, 0), ("worm", 90.0, 0)])
