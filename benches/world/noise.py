"""Noise of a channel, and its whitening: white and one Ornstein-Uhlenbeck part, by their own state space."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Noise:
    white: float = 0.04  # rms
    slow: float = 0.0  # rms of the part with memory
    memory_s: float = 60.0  # its correlation time
    tails: float = 0.0  # degrees of freedom of Student's t, 0: Gaussian
    outliers: float = 0.0  # share of rows
    weight: np.ndarray | None = None  # of the white part, row by row

    def scaled(self, factor):
        return Noise(self.white * factor, self.slow * factor, self.memory_s, self.tails, self.outliers, self.weight)

    def sigma(self, rows):
        return self.white * (np.ones(rows) if self.weight is None else self.weight)


def draw(rng, noise, t):
    return white(rng, noise, len(t)) + slow(rng, noise, t)


def white(rng, noise, rows):
    if noise.tails:
        drawn = rng.standard_t(noise.tails, rows) / np.sqrt(noise.tails / (noise.tails - 2))
    else:
        drawn = rng.standard_normal(rows)
    hit = rng.random(rows) < noise.outliers
    drawn[hit] += rng.choice([-1, 1], hit.sum()) * rng.uniform(8, 20, hit.sum())
    return noise.sigma(rows) * drawn


def slow(rng, noise, t):
    """Exact steps of the Ornstein-Uhlenbeck process from row to row."""
    keep = np.exp(-np.diff(t, prepend=t[0]) / noise.memory_s)
    out, state = np.empty(len(t)), rng.standard_normal()
    kicks = rng.standard_normal(len(t))
    for row in range(len(t)):
        state = keep[row] * state + np.sqrt(max(0.0, 1 - keep[row] ** 2)) * kicks[row]
        out[row] = state
    return noise.slow * out


def whiten(noise, t, columns):
    """Innovations of a Kalman filter over their standard deviations: unit variance where columns hold this noise."""
    out = np.array(columns, float)
    sigma = noise.sigma(len(t))
    if noise.slow == 0:
        return out / sigma[:, None]
    keep = np.exp(-np.diff(t, prepend=t[0]) / noise.memory_s)
    state, variance = np.zeros(out.shape[1]), noise.slow**2
    for row in range(len(t)):
        state, variance = keep[row] * state, keep[row] ** 2 * variance + (1 - keep[row] ** 2) * noise.slow**2
        total = variance + sigma[row] ** 2
        innovation = out[row] - state
        state = state + variance / total * innovation
        variance = variance * sigma[row] ** 2 / total
        out[row] = innovation / np.sqrt(total)
    return out


def workshop(rng, white=None):
    """The usual recorder: mostly white, often a drift with memory, sometimes heavy tails or outliers."""
    white = float(rng.uniform(0.02, 0.08)) if white is None else white
    slow = white * float(rng.choice([0, 0.3, 0.7, 1.2]))
    return Noise(
        white, slow, float(rng.uniform(15, 150)), tails=float(rng.choice([0, 0, 0, 5])),
        outliers=float(rng.choice([0, 0, 0, 0.003])),
    )
