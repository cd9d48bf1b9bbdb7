//! Units as instruments write them in headers, each with factor and offset to that of our column.

use super::HeaderUnit;

pub(super) const SECONDS: &[HeaderUnit] = &[
    ("s", 1.0, 0.0),
    ("sec", 1.0, 0.0),
    ("seconds", 1.0, 0.0),
    ("ms", 1e-3, 0.0),
    ("us", 1e-6, 0.0),
    ("min", 60.0, 0.0),
    ("h", 3600.0, 0.0),
    ("day", 86_400.0, 0.0),
];
pub(super) const MILLIMETRES: &[HeaderUnit] = &[
    ("mm", 1.0, 0.0),
    ("m", 1e3, 0.0),
    ("cm", 10.0, 0.0),
    ("um", 1e-3, 0.0),
    ("in", 25.4, 0.0),
    ("inch", 25.4, 0.0),
];
pub(super) const MICROMETRES: &[HeaderUnit] = &[
    ("um", 1.0, 0.0),
    ("nm", 1e-3, 0.0),
    ("mm", 1e3, 0.0),
    ("m", 1e6, 0.0),
    ("pm", 1e-6, 0.0),
    ("in", 25_400.0, 0.0),
    ("mil", 25.4, 0.0),
    ("uin", 0.0254, 0.0),
];
pub(super) const TURNS: &[HeaderUnit] = &[
    ("rev", 1.0, 0.0),
    ("turns", 1.0, 0.0),
    ("deg", 1.0 / 360.0, 0.0),
    ("rad", 1.0 / std::f64::consts::TAU, 0.0),
];
pub(super) const ARCSECONDS: &[HeaderUnit] = &[
    ("arcsec", 1.0, 0.0),
    ("arcmin", 60.0, 0.0),
    ("deg", 3600.0, 0.0),
    ("mdeg", 3.6, 0.0),
    ("gon", 3240.0, 0.0),
    ("mgon", 3.24, 0.0),
    ("rad", 648_000.0 / std::f64::consts::PI, 0.0),
    ("mrad", 648.0 / std::f64::consts::PI, 0.0),
    ("urad", 0.648 / std::f64::consts::PI, 0.0),
];
pub(super) const TURNS_A_MINUTE: &[HeaderUnit] = &[
    ("rpm", 1.0, 0.0),
    ("1/min", 1.0, 0.0),
    ("1/s", 60.0, 0.0),
    ("rad/s", 30.0 / std::f64::consts::PI, 0.0),
];
pub(super) const CELSIUS: &[HeaderUnit] = &[
    ("c", 1.0, 0.0),
    ("degc", 1.0, 0.0),
    ("k", 1.0, -273.15),
    ("degf", 5.0 / 9.0, -160.0 / 9.0),
    ("f", 5.0 / 9.0, -160.0 / 9.0),
];
pub(super) const HECTOPASCALS: &[HeaderUnit] = &[
    ("hpa", 1.0, 0.0),
    ("mbar", 1.0, 0.0),
    ("pa", 1e-2, 0.0),
    ("kpa", 10.0, 0.0),
    ("bar", 1e3, 0.0),
    ("mmhg", 1.333_223_874, 0.0),
    ("inhg", 33.863_886_4, 0.0),
];
pub(super) const PER_CENT: &[HeaderUnit] = &[("%", 1.0, 0.0), ("pct", 1.0, 0.0), ("%rh", 1.0, 0.0)];
pub(super) const NEWTONS: &[HeaderUnit] =
    &[("n", 1.0, 0.0), ("kn", 1e3, 0.0), ("kgf", 9.806_65, 0.0), ("lbf", 4.448_221_615_260_5, 0.0)];
