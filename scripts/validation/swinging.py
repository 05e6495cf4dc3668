"""The closed form of the swinging cube and, in the plane, the swinging square, and true norms (5.3) of a run's errors."""

import math

import numpy as np

import vtu

AMPLITUDE, DENSITY, YOUNG, POISSON = 5e-4, 1100, 17e6, 0.3
MU, LAMBDA = YOUNG / 2 / (1 + POISSON), YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))


class Wave:
    """u = U cos(w t) grad(prod sin(pi X_i / 2 + pi / 2)) of as many factors as there are dimensions, w = sqrt(d) pi c / 2."""

    def __init__(self, dimension):
        self.dimension = dimension
        self.frequency = math.sqrt(dimension * (LAMBDA + 2 * MU) / DENSITY) * math.pi / 2

    def fields(self, X, time):
        """By name, one row a particle; the stress as six components with off-diagonals times sqrt(2)."""
        d = self.dimension
        sine, cosine = np.sin(np.pi * X[:, :d] / 2), np.cos(np.pi * X[:, :d] / 2)
        without = lambda *axes: np.prod([cosine[:, k] for k in range(d) if k not in axes] or [np.ones(len(X))], axis=0)
        mode = np.zeros((len(X), 3))
        for i in range(d):
            mode[:, i] = sine[:, i] * without(i)
        swing = AMPLITUDE * math.cos(self.frequency * time)
        swell = d * np.pi / 2 * swing * without()
        stress = np.zeros((len(X), 6))
        for k, (i, j) in enumerate(COMPONENTS):
            if i == j:
                stress[:, k] = LAMBDA * swell + (2 * MU * swell / d if i < d else 0)
            elif j < d:
                stress[:, k] = math.sqrt(2) * -MU * np.pi * swing * sine[:, i] * sine[:, j] * without(i, j)
        return {"displacement": swing * mode,
                "velocity": -AMPLITUDE * self.frequency * math.sin(self.frequency * time) * mode,
                "pressure": ((LAMBDA + 2 * MU / 3) * swell)[:, None], "stress": stress}


def rows(path, name, columns):
    return np.array(vtu.read_array(path, name)).reshape(-1, columns)


def errors(run, wave, time):
    """Relative L2 errors by field, of the frame nearest to a time."""
    cloud = run.folder / "cloud.vtp"
    X, V = rows(cloud, "Points", 3), rows(cloud, "volume", 1)
    moment, frame = min(run.frames(), key=lambda frame: abs(frame[0] - time))
    stress = rows(frame, "Stress", 6)
    stress[:, 3:] *= math.sqrt(2)
    found = {"displacement": rows(frame, "Points", 3) - X, "velocity": rows(frame, "Velocity", 3),
             "pressure": rows(frame, "Pressure", 1), "stress": stress}
    exact = wave.fields(X, moment)
    return {name: math.sqrt((V * (found[name] - exact[name]) ** 2).sum() / (V * exact[name] ** 2).sum()) for name in exact}
