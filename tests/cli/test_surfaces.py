"""Runs the program on surface files and checks exit status, messages and files."""

import json
import math
import re
import subprocess
import unittest

from cli_case import PROGRAM, DONE, INPUT, GEOMETRY, CASE, CliTest


class Surfaces(CliTest):
    """Bodies from surface files."""

    TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"
    SHAPE = 'shape = { box = { min = [0, 0, 0], max = [1, 1, 1] } }'

    def write_case(self, shape, more=""):
        (self.folder / "part.off").write_text(self.TETRAHEDRON)
        text = CASE.replace(self.SHAPE, f"shape = {shape}").replace("[3, 3, 3]", "[6, 6, 6]")
        text = text.replace('"-x"', '"X < 0.1"').replace('"+x"', '"X > 0.5"')
        (self.folder / "case.toml").write_text(text + more)

    def check(self, *arguments):
        return subprocess.run([PROGRAM, "check", "case.toml", *arguments], cwd=self.folder, capture_output=True,
                              text=True)

    def test_sides(self):
        self.write_case('{ file = "part.off", units = "m" }')
        found = json.loads(self.check("--json").stdout)
        self.assertAlmostEqual(found["volume"], 1 / 6, delta=1e-15)
        self.assertIn("4 triangles, 4 vertices", found["notes"][0])
        self.assertIn("part.off: 4 triangles, 4 vertices, 1 shell", found["notes"][1])
        [side] = found["sides"]
        self.assertEqual((side["body"], side["names"], side["triangles"]), ("block", ["surface"], 4))
        self.assertAlmostEqual(side["area"], 1.5 + 3 ** 0.5 / 2, delta=1e-14)
        self.assertEqual((side["min"], side["max"]), ([0, 0, 0], [1, 1, 1]))
        self.assertRegex(self.check().stdout, r"block: surface +2.36603 +\d+ +4  \(0, 0, 0\), \(1, 1, 1\)\n")

    def test_files_that_are_not_there(self):
        self.write_case('{ file = "nowhere.stl", units = "m" }')
        result = self.check()
        self.assertEqual(result.returncode, GEOMETRY, result.stderr)
        self.assertRegex(result.stderr, r"case\.toml:\d+:\d+: body\.0\.shape.*: .*nowhere\.stl: no such file")
        text = CASE.replace(self.SHAPE + "\n", "").split("[[boundary]]")[0]
        text = re.sub(r"particles = .*", 'particles = { mesh = "nowhere.msh" }', text)
        (self.folder / "case.toml").write_text(text + '[method]\nformulation = "delaunay"\n[time]\nend = 1\n')
        result = self.check()
        self.assertEqual(result.returncode, GEOMETRY, result.stderr)
        self.assertRegex(result.stderr, r"case\.toml:\d+:\d+: body\.0\.particles.*: .*nowhere\.msh: no such file")

    def test_split_angle(self):
        self.write_case('{ file = "part.off", units = "m", split_angle = 30 }')
        sides = json.loads(self.check("--json").stdout)["sides"]
        self.assertEqual([side["names"] for side in sides], [["side1"], ["side2", "-x"], ["side3", "-y"], ["side4", "-z"]])
        self.assertAlmostEqual(sides[0]["normal"][2], 3 ** -0.5, delta=1e-14)

    def test_sides_of_boxes(self):
        self.write_case('{ name = "brick", box = { min = [0, 0, 0], max = [1, 2, 3] } }')
        sides = json.loads(self.check("--json").stdout)["sides"]
        self.assertEqual({side["names"][0]: side["area"] for side in sides},
                         {"-x": 6, "+x": 6, "-y": 3, "+y": 3, "-z": 2, "+z": 2})
        self.assertEqual(sides[1]["names"], ["+x", "brick.+x"])
        self.assertGreaterEqual(sides[1]["faces"], 36)

    def test_bodies_of_any_shape_overlap(self):
        self.write_case('{ torus = { radius = 2, tube_radius = 0.5, tolerance = 0.05 } }')
        case = self.folder / "case.toml"
        pin = '[[body]]\nname = "pin"\nshape = { sphere = { radius = 1.2, tolerance = 0.05 } }\n' \
              'particles = { spacing = 0.4 }\nmaterial = "rubber"\n[[material]]'
        case.write_text(case.read_text().split("[[boundary]]")[0].replace("[[material]]", pin) + "[time]\nend = 1\n")
        self.assertEqual(self.check().returncode, DONE, self.check().stderr)
        process = subprocess.run([PROGRAM, "check", "case.toml", "--set", "body.1.shape.sphere.radius=1.6"],
                                 cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(process.returncode, INPUT)
        place = re.search(r'"pin" overlaps body "block" at \((.*), (.*), (.*)\) m', process.stderr)
        self.assertIsNotNone(place, process.stderr)
        x, y, z = (float(number) for number in place.groups())
        self.assertLess(math.hypot(x, y, z), 1.6)
        self.assertLess(math.hypot(math.hypot(x, y) - 2, z), 0.5)

    def test_sizes_that_look_wrong(self):
        self.write_case('{ file = "part.off", units = "m", scale = 1 }')
        (self.folder / "part.off").write_text(self.TETRAHEDRON.replace("1 0 0\n", "50 0 0\n").replace("0 1 0\n", "0 50 0\n")
                                              .replace("0 0 1\n", "0 0 50\n"))
        notes = json.loads(self.check("--json").stdout)["notes"]
        self.assertTrue(any("70.7 m large" in note or "86.6 m large" in note for note in notes), notes)
        self.refused('{ file = "part.off", units = "m", translate = [1e9, 0, 0] }', "", "case.toml:4", "1e+09 m away",
                     "translate")

    def test_pictures_of_cells(self):
        self.write_case('{ file = "part.off", units = "m" }')
        case = self.folder / "case.toml"
        text = case.read_text()
        case.write_text(text + "\n" if "[output]" not in text else text)
        process = subprocess.run([PROGRAM, "run", "case.toml", "-o", "out", "--set", "time.end=0", "--set",
                                  "output.fields.cells=true", "--set", "output.fields.every=1"], cwd=self.folder,
                                 capture_output=True, text=True)
        self.assertEqual(process.returncode, DONE, process.stderr)
        self.assertTrue((self.folder / "out" / "cells_000000.vtu").exists())

    def test_units(self):
        self.write_case('{ file = "part.off", units = "cm" }')
        case = self.folder / "case.toml"
        case.write_text(case.read_text().replace('"X < 0.1"', '"X < 0.001"').replace('"X > 0.5"', '"X > 0.005"'))
        self.assertAlmostEqual(json.loads(self.check("--json").stdout)["volume"], 1e-6 / 6, delta=1e-20)

    def refused(self, shape, more, *parts, status=INPUT):
        self.write_case(shape, more)
        process = self.check()
        self.assertEqual(process.returncode, status, process.stderr)
        for part in parts:
            self.assertIn(part, process.stderr)

    def test_what_is_refused(self):
        plain = '{ file = "part.off", units = "m" }'
        self.refused('{ file = "part.off" }', "", "units", "missing")
        self.refused('{ file = "part.off", units = "mile" }', "", "mile", "mm")
        self.refused('{ file = "part.off", units = "m", box = { min = [0, 0, 0], max = [1, 1, 1] } }', "", "exactly one")
        self.refused(plain, '[method]\nformulation = "delaunay"\n', "case.toml:5", "a spacing or a count alone")
        self.refused(plain, '[method]\nboundary = "variational"\n', "case.toml:4", "consistent")
        self.refused('{ sphere = { radius = 1 } }', '[method]\nboundary = "quasi-static"\n', "case.toml:4", "bisect")
        self.refused('{ file = "other.off", units = "m" }', "", "other.off", status=GEOMETRY)

    def test_open_surface(self):
        self.write_case('{ file = "part.off", units = "m" }')
        (self.folder / "part.off").write_text(self.TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 1 2 3\n", ""))
        process = self.check()
        self.assertEqual(process.returncode, GEOMETRY)
        self.assertIn("part.off", process.stderr)

    def test_points_outside(self):
        self.write_case('{ file = "part.off", units = "m" }')
        (self.folder / "points.csv").write_text("x,y,z\n0.1,0.1,0.1\n0.2,0.3,0.2\n0.4,0.4,0.4\n")
        case = self.folder / "case.toml"
        case.write_text(case.read_text().replace("counts = [6, 6, 6], jitter = 0.2, seed = 3", 'file = "points.csv"'))
        process = self.check()
        self.assertEqual(process.returncode, GEOMETRY)
        self.assertIn("points.csv:4: particle 2 at (0.4, 0.4, 0.4) m does not lie inside the surface", process.stderr)


if __name__ == "__main__":
    unittest.main()
