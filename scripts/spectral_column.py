#!/usr/bin/python3
"""Reference for the bending column (examples/bending-column): spectral elements, explicit in time. They share nothing with the program.

    scripts/spectral_column.py [POISSON [FINENESS [END]]]

writes the path of the upper corner (6, 0.5, 0.5) m of the free end, of the middle of its face (6, 0, 0) m and of the centres of the
corner cells of Voronoi lattices with 4 and 8 cells per metre as CSV: time [s], current coordinates [m]. Hexahedra of order six on
Gauss-Lobatto points with lumped masses, smaller towards the clamp and the faces; half of the column, cut at its plane of symmetry.
FINENESS multiplies the elements in each direction. A few minutes with 1. Needs python3-numpy.
"""

import sys

import numpy as np

LENGTH, HALF = 6.0, 0.5
YOUNG, DENSITY, SPEED = 17e6, 1100.0, 10.0
ORDER = 6
# Points of Gauss, Lobatto: ends and zeros of the derivative of Legendre's polynomial.
POINTS = np.concatenate([[-1.0], np.polynomial.legendre.Legendre.basis(ORDER).deriv().roots().real, [1.0]])
WEIGHTS = 2.0 / (ORDER * (ORDER + 1) * np.polynomial.legendre.Legendre.basis(ORDER)(POINTS) ** 2)
POISSON = 0.45


def lagrange(at):
    """Values at `at` of the polynomials that are one at one of POINTS."""
    others = [np.delete(POINTS, i) for i in range(ORDER + 1)]
    return np.array([np.prod((at - o) / (p - o)) for p, o in zip(POINTS, others)])


def derivatives():
    """D[i, j]: derivative of polynomial j at point i."""
    rows = []
    for j in range(ORDER + 1):
        others = np.delete(POINTS, j)
        polynomial = np.polynomial.Polynomial.fromroots(others) / np.prod(POINTS[j] - others)
        rows.append(polynomial.deriv()(POINTS))
    return np.array(rows).T


def edges(fineness):
    """Where elements end in x, y and z."""
    x = LENGTH * np.linspace(0.0, 1.0, 8 * fineness + 1) ** 1.5
    y = HALF * (1.0 - (1.0 - np.linspace(0.0, 1.0, fineness + 1)) ** 1.3)
    return x, y, np.concatenate([-y[::-1], y[1:]])


class Column:
    def __init__(self, poisson, fineness):
        self.mu, self.lame = YOUNG / 2 / (1 + poisson), YOUNG * poisson / (1 + poisson) / (1 - 2 * poisson)
        self.edges = edges(fineness)
        counts = [len(e) - 1 for e in self.edges]
        axes = [np.concatenate([e[:1]] + [a + (b - a) * (POINTS[1:] + 1) / 2 for a, b in zip(e, e[1:])]) for e in self.edges]
        self.X = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
        sizes = [len(a) for a in axes]
        local = np.arange(ORDER + 1)
        self.nodes = np.array([[[[np.ravel_multi_index((ORDER * i + a, ORDER * j + b, ORDER * k + c), sizes) for c in local]
                                 for b in local] for a in local]
                               for i in range(counts[0]) for j in range(counts[1]) for k in range(counts[2])])
        h = np.array([[self.edges[0][i + 1] - self.edges[0][i], self.edges[1][j + 1] - self.edges[1][j],
                       self.edges[2][k + 1] - self.edges[2][k]]
                      for i in range(counts[0]) for j in range(counts[1]) for k in range(counts[2])])
        self.scale = 2.0 / h  # of derivatives
        self.weight = np.einsum("e,a,b,c->eabc", h.prod(1) / 8, WEIGHTS, WEIGHTS, WEIGHTS)
        self.D = derivatives()
        self.mass = DENSITY * np.bincount(self.nodes.ravel(), self.weight.ravel(), len(self.X))
        self.clamped, self.mirrored = self.X[:, 0] == 0.0, self.X[:, 1] == 0.0
        speed = np.sqrt((self.lame + 2 * self.mu) / DENSITY)
        self.largest_step = 0.35 * h.min() * (POINTS[1] - POINTS[0]) / 2 / speed

    def forces(self, x):
        y = x[self.nodes]
        F = np.empty(y.shape + (3,))
        F[..., 0] = np.einsum("ai,eibcd->eabcd", self.D, y) * self.scale[:, None, None, None, None, 0]
        F[..., 1] = np.einsum("bi,eaicd->eabcd", self.D, y) * self.scale[:, None, None, None, None, 1]
        F[..., 2] = np.einsum("ci,eabid->eabcd", self.D, y) * self.scale[:, None, None, None, None, 2]
        cofactor = np.stack([np.cross(F[..., 1], F[..., 2]), np.cross(F[..., 2], F[..., 0]),
                             np.cross(F[..., 0], F[..., 1])], -1)
        J = np.sum(F[..., 0] * cofactor[..., 0], -1)
        P = self.mu * F + ((self.lame * np.log(J) - self.mu) / J)[..., None, None] * cofactor
        P *= self.weight[..., None, None] * self.scale[:, None, None, None, None, :]
        f = np.einsum("ia,eibcd->eabcd", self.D, P[..., 0]) + np.einsum("ib,eaicd->eabcd", self.D, P[..., 1])
        f += np.einsum("ic,eabid->eabcd", self.D, P[..., 2])
        flat = self.nodes.ravel()
        return -np.stack([np.bincount(flat, f[..., d].ravel(), len(x)) for d in range(3)], 1)

    def hold(self, v):
        v[self.clamped] = 0.0
        v[self.mirrored, 1] = 0.0

    def at(self, point, x):
        """Position of the material point."""
        place, shape = [], []
        counts = [len(e) - 1 for e in self.edges]
        for e, p in zip(self.edges, point):
            i = min(np.searchsorted(e, p, "right") - 1, len(e) - 2)
            place.append(i)
            shape.append(lagrange(2 * (p - e[i]) / (e[i + 1] - e[i]) - 1))
        return np.einsum("a,b,c,abcd->d", *shape, x[self.nodes[np.ravel_multi_index(place, counts)]])


PROBES = {"corner": (6, 0.5, 0.5), "end": (6, 0, 0), "in8": (5.875, 0.375, 0.375), "in16": (5.9375, 0.4375, 0.4375)}


def main():
    poisson = float(sys.argv[1]) if len(sys.argv) > 1 else POISSON
    column = Column(poisson, int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    end, every = float(sys.argv[3]) if len(sys.argv) > 3 else 1.0, 0.01
    steps = int(np.ceil(every / column.largest_step))
    dt = every / steps
    x, v = column.X.copy(), np.zeros_like(column.X)
    v[:, 2] = SPEED * column.X[:, 0] / LENGTH
    v += 0.5 * dt * column.forces(x) / column.mass[:, None]
    column.hold(v)
    print("t," + ",".join(f"{axis}_{name}" for name in PROBES for axis in ("x1", "x3")))
    for frame in range(round(end / every) + 1):
        print(f"{frame * every:.9g}," + ",".join(f"{p[i]:.9g}" for p in (column.at(X, x) for X in PROBES.values()) for i in (0, 2)),
              flush=True)
        for _ in range(steps):
            x += dt * v
            v += dt * column.forces(x) / column.mass[:, None]
            column.hold(v)


if __name__ == "__main__":
    main()
