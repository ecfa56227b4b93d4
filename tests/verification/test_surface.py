"""Patch tests A, B, C on solids that triangulated surfaces enclose: cells cut by their facets, tetrahedra inside.

As in test_patch.py; the tractions of test C are those of the nominal stress P of the motion on facets of any direction.
"""

import functools
import json
import math
import os
import pathlib
import tempfile
import unittest

import runs

YOUNG, POISSON = 1e6, 0.3
LAME = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
SHEAR = YOUNG / (2 * (1 + POISSON))
FIELD = ["1e-4*(1*X + 2*Y + 3*Z)", "1e-4*(4*X + 5*Y + 6*Z)", "1e-4*(7*X + 8*Y + 9*Z)"]
RAMP = "min(t/5, 1)^2*(3 - 2*min(t/5, 1))"
ROUND_OFF = 1e-13  # of the size of the body


def ball(rings=10):
    """Vertices and triangles of a ball of radius 1."""
    around = 2 * rings
    vertices = [(0.0, 0.0, 1.0)]
    for i in range(1, rings):
        theta = math.pi * i / rings
        vertices += [(math.sin(theta) * math.cos(math.pi * j / rings), math.sin(theta) * math.sin(math.pi * j / rings),
                      math.cos(theta)) for j in range(around)]
    vertices.append((0.0, 0.0, -1.0))
    at = lambda i, j: 1 + (i - 1) * around + j % around
    triangles = []
    for j in range(around):
        triangles += [(0, at(1, j), at(1, j + 1)), (at(rings - 1, j), len(vertices) - 1, at(rings - 1, j + 1))]
        for i in range(1, rings - 1):
            triangles += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    return vertices, triangles


def torus(around=20, across=10, large=0.7, small=0.3):
    vertices, triangles = [], []
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = large + small * math.cos(v)
            vertices.append((r * math.cos(u), r * math.sin(u), small * math.sin(v)))
            a, b = i * across, (i + 1) % around * across
            k = (j + 1) % across
            triangles += [(a + j, b + j, b + k), (a + j, b + k, a + k)]
    return vertices, triangles


def cubes(where, size):
    """The surface of cubes of one size at integer places."""
    number, triangles = {}, []
    at = lambda *p: number.setdefault(p, len(number))
    for p in where:
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for step in (0, 1):
                beside = list(p)
                beside[axis] += 2 * step - 1
                if tuple(beside) in where:
                    continue
                ring = []
                for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)) if step else ((0, 0), (0, 1), (1, 1), (1, 0)):
                    q = list(p)
                    q[axis] += step
                    q[u] += i
                    q[v] += j
                    ring.append(at(*q))
                triangles += [(ring[0], ring[1], ring[2]), (ring[0], ring[2], ring[3])]
    vertices = [tuple(size * x for x in q) for q in number]
    # Away from the axes, so that no facet is parallel to a lattice plane.
    c, s = math.cos(0.5), math.sin(0.5)
    turned = [(c * x - s * y, s * x + c * y, z) for x, y, z in vertices]
    return [(x, c * y - s * z, s * y + c * z) for x, y, z in turned], triangles


def l_with_hole():
    """An L of 5 by 5 cubes, two thick, with a square hole through its knee."""
    block = {(i, j, k) for i in range(5) for j in range(5) for k in range(2) if i < 3 or j < 3}
    return cubes({p for p in block if p[:2] != (1, 1)}, 0.2)


def plate():
    return cubes({(i, j, 0) for i in range(6) for j in range(5)}, 0.1)


def gear():
    """The part of examples/stl-part, in metres for its millimetres, a twentieth of them."""
    number, triangles, corners = {}, [], []
    for line in (runs.EXAMPLES / "stl-part/gear.stl").read_text().splitlines():
        if line.split()[:1] == ["vertex"]:
            corners.append(number.setdefault(tuple(float(x) / 20 for x in line.split()[1:]), len(number)))
            if len(corners) == 3:
                triangles.append(tuple(corners))
                corners = []
    return list(number), triangles


# How to make it, the spacing, what test C holds.
BODIES = {
    "ball": (ball, 0.3, "Z < -0.5"),
    "torus": (torus, 0.2, "X < -0.5"),
    "L with hole": (l_with_hole, 0.12, "X < 0"),
    "thin plate": (plate, 0.045, "X < 0"),
    "imported part": (gear, 0.15, "X < 0"),
}


def write_off(path, vertices, triangles):
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    lines += [" ".join(repr(1000 * x) for x in v) for v in vertices]
    lines += ["3 " + " ".join(map(str, t)) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


def boundary(test, held, formulation):
    """The boundary conditions of a test."""
    if test != "c":
        field = FIELD if test == "a" else [f"{u}*{RAMP}" for u in FIELD]
        return f'[[boundary]]\nwhere = "surface"\ndisplacement = {json.dumps(field)}\n'
    stress = [[f"{p!r}*{RAMP}" for p in row] for row in first_piola_kirchhoff()]
    field = [f"{u}*{RAMP}" for u in FIELD]
    # Delaunay holds particles, so that a triangle may be held at a part of its corners.
    loaded = held.replace("<", ">=") if formulation == "voronoi" else "surface"
    return (f'[[boundary]]\nwhere = "{held}"\ndisplacement = {json.dumps(field)}\n'
            f'[[boundary]]\nwhere = "{loaded}"\nstress = {json.dumps(stress)}\n')


def first_piola_kirchhoff():
    """P = (lambda ln J - mu) F^-T + mu F of the field, [D 54]."""
    F = [[1e-4 * (3 * i + j + 1) + (i == j) for j in range(3)] for i in range(3)]
    minor = lambda i, j: (F[(i + 1) % 3][(j + 1) % 3] * F[(i + 2) % 3][(j + 2) % 3]
                          - F[(i + 1) % 3][(j + 2) % 3] * F[(i + 2) % 3][(j + 1) % 3])
    J = sum(F[0][j] * minor(0, j) for j in range(3))
    return [[(LAME * math.log(J) - SHEAR) * minor(i, j) / J + SHEAR * F[i][j] for j in range(3)] for i in range(3)]


@functools.cache
def result(body, test, formulation="voronoi"):
    make, spacing, held = BODIES[body]
    jitter = ", jitter = 0.25, seed = 1" if formulation == "voronoi" else ""
    text = f"""
[method]
formulation = "{formulation}"
integration = "nodal"
[[body]]
shape = {{ file = "{body}.off", units = "mm" }}
particles = {{ spacing = {spacing}{jitter} }}
material = "rubber"
[[material]]
name = "rubber"
young = {YOUNG}
poisson = {POISSON}
density = 1000
{boundary(test, held, formulation)}
[time]
end = {0 if test == "a" else 15 if formulation == "voronoi" else 11}
damping = 15
[output]
fields = {{ format = "csv", quantities = ["displacement", "force", "first_piola_kirchhoff"] }}
[[reference]]
name = "exact"
displacement = {json.dumps(FIELD)}
"""
    if test == "a":
        text += f"[[initial]]\ndisplacement = {json.dumps(FIELD)}\n"
    with tempfile.TemporaryDirectory() as folder:
        write_off(pathlib.Path(folder, f"{body}.off"), *make())
        case = pathlib.Path(folder, "case.toml")
        case.write_text(text)
        return runs.run(os.fspath(case))


def error(r):
    """Largest error of the displacement of a particle (m)."""
    return r.summary["errors"]["exact"]["displacement_max"]


@functools.cache
def formulations():
    """Meshes of surfaces need a component that may be missing."""
    try:
        result("ball", "a", "delaunay")
    except AssertionError as missing:
        if "nothing here can mesh surfaces" not in str(missing):
            raise
        return ["voronoi"]
    return ["voronoi", "delaunay"]


CASES = functools.cache(lambda: [(body, formulation) for body in BODIES for formulation in formulations()])


class SurfacePatch(unittest.TestCase):
    def test_a(self):
        """The forces of the exact field vanish."""
        for case in CASES():
            r = result(case[0], "a", case[1])
            spacing = BODIES[case[0]][1]
            largest = max(abs(s) for i in "xyz" for j in "xyz" for s in r.frame()[f"first_piola_kirchhoff_{i}{j}"])
            self.assertGreater(r.summary["particles"], 50)
            self.assertLess(error(r), 1e-15, case)
            self.assertLess(r.summary["max_force_residual"], 1e-10 * largest * spacing**2, case)

    def test_b(self):
        """The particles follow the boundary."""
        for body, formulation in CASES():
            self.assertLess(error(result(body, "b", formulation)), ROUND_OFF, (body, formulation))

    def test_c(self):
        """The particles follow the tractions."""
        for body, formulation in CASES():
            self.assertLess(error(result(body, "c", formulation)), ROUND_OFF, (body, formulation))


class Part(unittest.TestCase):
    def test_numbers_of_the_readme(self):
        r = runs.run("stl-part/stl-part.toml")
        last = {name: column[-1] for name, column in r.history.items()}
        load = 5e5 * 2 * 28e-3 * math.sin(math.pi / 48) * 10e-3
        self.assertEqual(r.summary["particles"], 896)
        self.assertEqual(r.summary["boundary_faces"], 1263)
        self.assertAlmostEqual(last["bore.fy"], -load, delta=1e-4 * load)
        self.assertLess(max(abs(last["bore.fx"]), abs(last["bore.fz"])), 1e-4)
        self.assertAlmostEqual(last["tip.y"] - 1.8e-3, -0.1906e-3, delta=1e-6)
        self.assertLess(r.summary["identities"]["volume"], 1e-12)


class Booleans(unittest.TestCase):
    def test_numbers_of_the_readme(self):
        r = runs.run("odd-solid/odd-solid.toml")
        last = {name: column[-1] for name, column in r.history.items()}
        self.assertEqual(r.summary["particles"], 758)
        self.assertEqual(r.summary["boundary_faces"], 9559)
        self.assertAlmostEqual(last["hole.fy"], 21.461, delta=2e-3)
        self.assertLess(max(abs(last["hole.fx"]), abs(last["hole.fz"])), 1e-3)
        self.assertAlmostEqual(last["ball.y"], 5.242e-3, delta=1e-6)
        self.assertLess(r.summary["identities"]["volume"], 1e-12)


def tearDownModule():
    rows = []
    for body, formulation in CASES():
        a, b, c = (result(body, test, formulation) for test in "abc")
        name = f"{body}, {formulation}"
        rows += [(f"{name}, test A: largest force", "ours", None, f"{a.summary['max_force_residual']:.2g} N", None),
                 (f"{name}, test B: largest error", "ours", None, f"{1e3 * error(b):.2g} mm", f"{1e3 * ROUND_OFF:.2g} mm"),
                 (f"{name}, test C: largest error", "ours", None, f"{1e3 * error(c):.2g} mm", f"{1e3 * ROUND_OFF:.2g} mm")]
    runs.record("surfaces", rows)


if __name__ == "__main__":
    runs.main()
