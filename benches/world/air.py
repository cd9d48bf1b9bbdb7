"""Refractive index of air after Ciddor, Applied Optics 35 (1996) 1566, written from the paper."""

import numpy as np

# Saturation vapour pressure, eq. of Davis 1992 as the paper's appendix gives it.
SVP = (1.2378847e-5, -1.9121316e-2, 33.93711047, -6.3431645e3)
# Compressibility, same appendix.
Z = (1.58123e-6, -2.9331e-8, 1.1043e-10, 5.707e-6, -2.051e-8, 1.9898e-4, -2.376e-6, 1.83e-11, -0.765e-8)
GAS, WATER_KG = 8.314510, 0.018015


def compressibility(kelvin, pascal, water):
    t = kelvin - 273.15
    first = Z[0] + Z[1] * t + Z[2] * t**2 + (Z[3] + Z[4] * t) * water + (Z[5] + Z[6] * t) * water**2
    return 1 - pascal / kelvin * first + (pascal / kelvin) ** 2 * (Z[7] + Z[8] * water**2)


def index(celsius, hpa, percent, wavelength_um=0.633, co2_ppm=450.0):
    """n of moist air. Temperature °C, pressure hPa, relative humidity %, vacuum wavelength µm."""
    t, p = np.asarray(celsius, float), np.asarray(hpa, float) * 100
    kelvin = t + 273.15
    saturation = np.exp(SVP[0] * kelvin**2 + SVP[1] * kelvin + SVP[2] + SVP[3] / kelvin)
    enhancement = 1.00062 + 3.14e-8 * p + 5.6e-7 * t**2
    water = np.asarray(percent, float) / 100 * enhancement * saturation / p
    s = 1 / wavelength_um**2
    dry = 1e-8 * (5792105 / (238.0185 - s) + 167917 / (57.362 - s)) * (1 + 0.534e-6 * (co2_ppm - 450))
    vapour = 1.022e-8 * (295.235 + 2.6422 * s - 0.032380 * s**2 + 0.004028 * s**3)
    molar = 1e-3 * (28.9635 + 12.011e-6 * (co2_ppm - 400))
    standard_dry = 101325.0 * molar / (compressibility(288.15, 101325.0, 0.0) * GAS * 288.15)
    standard_vapour = 1333.0 * WATER_KG / (compressibility(293.15, 1333.0, 1.0) * GAS * 293.15)
    here = p / (compressibility(kelvin, p, water) * GAS * kelvin)
    return 1 + here * molar * (1 - water) / standard_dry * dry + here * WATER_KG * water / standard_vapour * vapour
