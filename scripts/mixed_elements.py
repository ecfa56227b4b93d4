#!/usr/bin/python3
"""References for nearly incompressible solids: linear elasticity in plane strain by Taylor-Hood elements (quadratic
displacements, linear pressure), which neither lock nor alternate, on meshes graded to the singular corners.

    scripts/mixed_elements.py

prints, for several Poisson's ratios and three meshes each, what examples/nearly-incompressible compares with: the rise of the
middle of the right side of Cook's membrane [m], the rise of the block's corner [m], and the force on the punch [N]. Needs
python3-scipy. A few minutes.
"""

import itertools

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linear

YOUNG = 1e6
RATIOS = (0.45, 0.49, 0.499, 0.4999)


def shapes(order, x):
    """Values and derivatives of the shape functions on [0, 1]."""
    if order == 1:
        return np.array([1 - x, x]), np.array([-1.0, 1.0])
    return (np.array([(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)]),
            np.array([4 * x - 3, 4 - 8 * x, 4 * x - 1]))


def numbers(counts, order):
    """Numbers of the nodes of every element, row by row."""
    cells = list(itertools.product(*map(range, counts)))
    sizes = [order * n + 1 for n in counts]
    local = list(itertools.product(range(order + 1), repeat=2))
    return np.array([[np.ravel_multi_index([order * c[k] + l[k] for k in range(2)], sizes) for l in local]
                     for c in cells])


def assemble(rows, columns, blocks, shape):
    """A sparse matrix from one block for every element."""
    i = np.repeat(rows, columns.shape[1], 1).ravel()
    j = np.tile(columns, (1, rows.shape[1])).ravel()
    return sparse.coo_matrix((blocks.ravel(), (i, j)), shape).tocsr()


def solve(grids, mapping, poisson, prescribed, traction=None):
    """Displacements u and reactions at the nodes P (on the parameter square) and X."""
    counts = [len(g) - 1 for g in grids]
    halved = [np.interp(np.arange(2 * n + 1) / 2, np.arange(n + 1), g) for g, n in zip(grids, counts)]
    P = np.array(list(itertools.product(*halved)))
    X = mapping(P)
    mu, lame = YOUNG / 2 / (1 + poisson), YOUNG * poisson / (1 + poisson) / (1 - 2 * poisson)
    quadratic, bilinear = numbers(counts, 2), numbers(counts, 1)
    K, B, M = (np.zeros((len(quadratic), *s)) for s in ((9, 2, 9, 2), (4, 9, 2), (4, 4)))
    points, weights = np.polynomial.legendre.leggauss(3)
    for (x, wx), (y, wy) in itertools.product(zip((points + 1) / 2, weights / 2), repeat=2):
        (Nx, dx), (Ny, dy), (Lx, _), (Ly, _) = shapes(2, x), shapes(2, y), shapes(1, x), shapes(1, y)
        derivative = np.stack([np.outer(dx, Ny).ravel(), np.outer(Nx, dy).ravel()], 1)
        pressure = np.outer(Lx, Ly).ravel()
        jacobian = np.einsum("cni,nj->cij", X[quadratic], derivative)
        G = np.einsum("nj,cji->cni", derivative, np.linalg.inv(jacobian))
        w = wx * wy * np.linalg.det(jacobian)
        K += mu * np.einsum("c,cnk,cmk,ij->cnimj", w, G, G, np.eye(2))
        K += mu * np.einsum("c,cnj,cmi->cnimj", w, G, G)
        B += np.einsum("c,p,cni->cpni", w, pressure, G)
        M += np.einsum("c,p,r->cpr", w, pressure, pressure)
    freedoms = (quadratic[:, :, None] * 2 + np.arange(2)).reshape(len(quadratic), 18)
    n, m = 2 * len(P), (counts[0] + 1) * (counts[1] + 1)
    coupling = assemble(bilinear, freedoms, B, (m, n))
    system = sparse.bmat([[assemble(freedoms, freedoms, K, (n, n)), -coupling.T],
                          [-coupling, -assemble(bilinear, bilinear, M, (m, m)) / lame]]).tocsr()
    load = np.zeros(n + m)
    if traction is not None:
        load[:n] = traction(P, X).ravel()
    held, value = prescribed(P)
    free = np.ones(n + m, bool)
    free[:n] = ~held.ravel()
    u = np.zeros(n + m)
    u[:n][held.ravel()] = value.ravel()[held.ravel()]
    u[free] = linear.splu(system[free][:, free].tocsc()).solve((load - system @ u)[free])
    return P, X, u[:n].reshape(-1, 2), (system @ u - load)[:n].reshape(-1, 2)


def cook(n, poisson):
    """Rise of the middle of the right side under 100 Pa."""
    grids = [np.linspace(0, 1, n + 1) ** 1.3, (1 - np.cos(np.pi * np.linspace(0, 1, n + 1))) / 2]

    def traction(P, X):
        f = np.zeros_like(X)
        edge = np.flatnonzero(P[:, 0] == 1)
        for first in range(0, len(edge) - 1, 2):
            height = X[edge[first + 2], 1] - X[edge[first], 1]
            f[edge[first:first + 3], 1] += 100.0 * height * np.array([1, 4, 1]) / 6
        return f

    _, X, u, _ = solve(grids, lambda P: np.stack([0.048 * P[:, 0], 0.044 * P[:, 0] + P[:, 1] *
                                                  (0.044 - 0.028 * P[:, 0])], 1), poisson,
                       lambda P: (np.repeat(P[:, :1] == 0, 2, 1), np.zeros_like(P)), traction)
    return u[np.argmin(np.hypot(X[:, 0] - 0.048, X[:, 1] - 0.052)), 1]


def punch(n, poisson):
    """Rise of the corner of the block of [V], and the force on the punch, for 1 mm; half of the block is computed."""
    towards = 1 - (1 - np.linspace(0, 1, 2 * n + 1)) ** 1.6
    away = np.linspace(0, 1, n + 1) ** 1.6
    grids = [np.concatenate([towards / 3, 1 / 3 + away[1:] / 6]), 0.5 * towards]

    def pressed(P):
        return (P[:, 1] > 0.5 - 1e-12) & (P[:, 0] > 1 / 3 - 1e-12)

    def prescribed(P):
        held = np.stack([(P[:, 0] == 0) | (P[:, 0] == 0.5) | pressed(P), (P[:, 1] == 0) | pressed(P)], 1)
        return held, np.stack([np.zeros(len(P)), np.where(pressed(P), -1e-3, 0.0)], 1)

    P, X, u, reaction = solve(grids, lambda P: P, poisson, prescribed)
    return u[np.argmin(np.hypot(X[:, 0], X[:, 1] - 0.5)), 1], 2 * reaction[pressed(P), 1].sum()


if __name__ == "__main__":
    for ratio in RATIOS:
        print(f"nu = {ratio}: membrane", *(f"{cook(n, ratio):.4e}" for n in (16, 32, 64)))
        print(f"nu = {ratio}: punch", *("{:.4e} {:.1f}".format(*punch(n, ratio)) for n in (4, 8, 16)))
