#!/usr/bin/python3
"""References for nearly incompressible solids: linear elasticity, in plane strain or in space, by Taylor-Hood elements
(quadratic displacements, linear pressure), which neither lock nor alternate, on meshes graded to the singular corners and edges.

    scripts/mixed_elements.py

prints, for several Poisson's ratios and several meshes each, what examples/nearly-incompressible compares with: the rise of the
middle of the right side of Cook's membrane [m]; the rise of the corner of the block of [V] [m] and the force on its punch [N]; the
bulge of the block of [D] [m] and the force on the quarter of its punch [N]. Needs python3-scipy. Some minutes.
"""

import itertools

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linear

RATIOS = (0.45, 0.49, 0.499, 0.4999)


def shapes(order, x):
    """Values and derivatives of the shape functions on [0, 1]."""
    if order == 1:
        return np.array([1 - x, x]), np.array([-1.0, 1.0])
    return (np.array([(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)]),
            np.array([4 * x - 3, 4 - 8 * x, 4 * x - 1]))


def element_shapes(order, place):
    """Values and gradients of all shape functions of an element: products of those of its directions."""
    values, slopes = zip(*(shapes(order, x) for x in place))
    gradients = [product(slopes[k] if k == j else values[k] for k in range(len(place))) for j in range(len(place))]
    return product(values), np.stack(gradients, 1)


def product(factors):
    result = np.ones(1)
    for factor in factors:
        result = np.outer(result, factor).ravel()
    return result


def numbers(counts, order):
    """Numbers of the nodes of every element, row by row."""
    cells = list(itertools.product(*map(range, counts)))
    sizes = [order * n + 1 for n in counts]
    local = list(itertools.product(range(order + 1), repeat=len(counts)))
    return np.array([[np.ravel_multi_index([order * i + j for i, j in zip(c, l)], sizes) for l in local] for c in cells])


def assemble(rows, columns, blocks, shape):
    """A sparse matrix from one block for every element."""
    i = np.repeat(rows, columns.shape[1], 1).ravel()
    j = np.tile(columns, (1, rows.shape[1])).ravel()
    return sparse.coo_matrix((blocks.ravel(), (i, j)), shape).tocsr()


def solve(grids, mapping, young, poisson, prescribed, traction=None):
    """Displacements u and reactions at the nodes P (on the grid) and X, in as many dimensions as there are grids."""
    counts, d = [len(g) - 1 for g in grids], len(grids)
    halved = [np.interp(np.arange(2 * n + 1) / 2, np.arange(n + 1), g) for g, n in zip(grids, counts)]
    P = np.array(list(itertools.product(*halved)))
    X = mapping(P)
    mu, lame = young / 2 / (1 + poisson), young * poisson / (1 + poisson) / (1 - 2 * poisson)
    quadratic, linear_nodes = numbers(counts, 2), numbers(counts, 1)
    K, B, M = (np.zeros((len(quadratic), *s)) for s in ((3**d, d, 3**d, d), (2**d, 3**d, d), (2**d, 2**d)))
    points, weights = np.polynomial.legendre.leggauss(3)
    for place in itertools.product(range(3), repeat=d):
        at = [(points[i] + 1) / 2 for i in place]
        (_, derivative), (pressure, _) = element_shapes(2, at), element_shapes(1, at)
        jacobian = np.einsum("cni,nj->cij", X[quadratic], derivative)
        G = np.einsum("nj,cji->cni", derivative, np.linalg.inv(jacobian))
        w = np.prod([weights[i] / 2 for i in place]) * np.linalg.det(jacobian)
        K += mu * np.einsum("c,cnk,cmk,ij->cnimj", w, G, G, np.eye(d), optimize=True)
        K += mu * np.einsum("c,cnj,cmi->cnimj", w, G, G, optimize=True)
        B += np.einsum("c,p,cni->cpni", w, pressure, G)
        M += np.einsum("c,p,r->cpr", w, pressure, pressure)
    freedoms = (quadratic[:, :, None] * d + np.arange(d)).reshape(len(quadratic), d * 3**d)
    n, m = d * len(P), int(np.prod([c + 1 for c in counts]))
    coupling = assemble(linear_nodes, freedoms, B, (m, n))
    system = sparse.bmat([[assemble(freedoms, freedoms, K, (n, n)), -coupling.T],
                          [-coupling, -assemble(linear_nodes, linear_nodes, M, (m, m)) / lame]]).tocsr()
    load = np.zeros(n + m)
    if traction is not None:
        load[:n] = traction(P, X).ravel()
    held, value = prescribed(P)
    free = np.ones(n + m, bool)
    free[:n] = ~held.ravel()
    u = np.zeros(n + m)
    u[:n][held.ravel()] = value.ravel()[held.ravel()]
    u[free] = linear.splu(system[free][:, free].tocsc()).solve((load - system @ u)[free])
    return P, X, u[:n].reshape(-1, d), (system @ u - load)[:n].reshape(-1, d)


def at(X, u, place):
    """The displacement of the node at a place."""
    return u[np.argmin(np.linalg.norm(X - place, axis=1))]


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
                                                  (0.044 - 0.028 * P[:, 0])], 1), 1e6, poisson,
                       lambda P: (np.repeat(P[:, :1] == 0, 2, 1), np.zeros_like(P)), traction)
    return at(X, u, [0.048, 0.052])[1]


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

    _, X, u, reaction = solve(grids, lambda P: P, 1e6, poisson, prescribed)
    return at(X, u, [0, 0.5])[1], 2 * reaction[X[:, 1] > 0.5 - 1e-12, 1].sum()


def punch_in_space(counts, poisson):
    """Bulge of the free side of the quarter block of [D] at half its height, and the force on the quarter punch, for 1 um.
    `counts`: elements under the punch, beside it, and over the height. Lengths in mm, so that numbers are of one size."""
    under, beside, height = counts
    towards = 1 - (1 - np.linspace(0, 1, under + 1)) ** 1.6
    side = np.concatenate([towards / 3, 1 / 3 + 2 / 3 * np.linspace(0, 1, beside + 1)[1:] ** 1.6])
    grids = [side, side, (1 - np.cos(np.pi * np.linspace(0, 1, height + 1))) / 2]

    def prescribed(P):
        pressed = (P[:, 2] > 1 - 1e-12) & (P[:, 0] < 1 / 3 + 1e-12) & (P[:, 1] < 1 / 3 + 1e-12)
        ground = P[:, 2] == 0
        held = np.stack([(P[:, 0] == 0) | pressed | ground, (P[:, 1] == 0) | pressed | ground, pressed | ground], 1)
        value = np.zeros_like(P)
        value[pressed, 2] = -1e-3
        return held, value

    _, X, u, reaction = solve(grids, lambda P: P, 240.0, poisson, prescribed)  # MPa, so forces are in N
    return 1e-3 * at(X, u, [1, 0, 0.5])[0], reaction[X[:, 2] > 1 - 1e-12, 2].sum()


if __name__ == "__main__":
    for ratio in RATIOS:
        print(f"nu = {ratio}: membrane", *(f"{cook(n, ratio):.4e}" for n in (16, 32, 64)))
        print(f"nu = {ratio}: punch of [V]", *("{:.4e} {:.1f}".format(*punch(n, ratio)) for n in (4, 8, 16)))
        print(f"nu = {ratio}: punch of [D]",
              *("{:.4e} {:.5f}".format(*punch_in_space(c, ratio)) for c in ((2, 3, 6), (3, 4, 6), (3, 4, 8))), flush=True)
