"""The kinds of scene. A scene is a function of (rng, level) that returns a Case; its name is its kind."""

from . import closed, forms, logs, nothing, outside, periodic, sampling, mistakes, smooth, together

KINDS = [
    scene
    for room in (nothing, periodic, smooth, logs, closed, together, forms, outside, sampling, mistakes)
    for scene in room.SCENES
]
# Standard errors of the optimal fit at which an effect of the catalogue is planted, by turns.
LEVELS = (8, 12, 5, 30, 3)
