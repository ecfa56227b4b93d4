"""Runs the program and checks exit status, messages and files."""

import csv
import json
import os
import pathlib
import re
import unittest
import unittest.mock

from cli_case import DONE, USAGE, INPUT, GEOMETRY, CASE, SECOND_BODY, CliTest


class Usage(CliTest):
    def test_no_command(self):
        self.check_fails(USAGE, "no command", arguments=[])

    def test_unknown_command(self):
        self.check_fails(USAGE, 'unknown command "rnu" (did you mean "run"?)', arguments=["rnu", "case.toml"])

    def test_unknown_option(self):
        self.check_fails(USAGE, "--bogus", "tessera help run", arguments=["run", "case.toml", "--bogus"])

    def test_missing_case(self):
        self.check_fails(USAGE, "CASE is required", arguments=["run"])

    def test_too_many_cases(self):
        self.check_fails(USAGE, "b.toml", arguments=["run", "a.toml", "b.toml"])

    def test_threads(self):
        for threads in ("0", "-1", "many"):
            self.check_fails(USAGE, "--threads", arguments=["run", "case.toml", "-j", threads])

    def test_bench_of_accuracy_has_its_own_sizes(self):
        self.check_fails(USAGE, "--accuracy", "--particles", arguments=["bench", "--accuracy", "--particles", "1000"])

    def test_bench_of_more_than_memory_holds(self):
        available = re.search(r"MemAvailable:\s+(\d+) kB", pathlib.Path("/proc/meminfo").read_text())
        if int(available[1]) > 200e6:
            self.skipTest("this machine has room for the largest size")
        self.check_fails(USAGE, "100000000 particles need about", "are available", "fewer with --particles",
                         arguments=["bench", "--particles", "100000000"])

    def test_threads_of_the_environment(self):
        self.write(CASE)
        with unittest.mock.patch.dict(os.environ, {"OMP_NUM_THREADS": "many"}):
            result = self.call("run", "case.toml")
        # A library that knows the variable too may complain on a line of its own.
        self.assertEqual(result.returncode, USAGE, result.stderr)
        self.assertIn('OMP_NUM_THREADS is "many"; expected a number', result.stderr)

    def test_force_or_resume(self):
        self.check_fails(USAGE, "--resume", "--force", arguments=["run", "case.toml", "--force", "--resume"])

    def test_result_folder_exists(self):
        self.write(CASE)
        self.write("precious", "case.out/history.csv")
        self.check_fails(USAGE, '"case.out" exists', "--force", "--resume", arguments=["run", "case.toml"])
        self.write("precious", "other/summary.json")
        self.check_fails(USAGE, '"other" exists', arguments=["run", "case.toml", "-o", "other"])
        self.assertEqual((self.folder / "case.out/history.csv").read_text(), "precious")

    def test_result_folder_is_a_file(self):
        self.write(CASE)
        self.write("precious", "case.out")
        self.check_fails(USAGE, '"case.out" is a file', arguments=["run", "case.toml", "--force"])
        self.assertEqual((self.folder / "case.out").read_text(), "precious")

    def test_result_folder_cannot_be_made(self):
        self.write(CASE)
        self.write("precious", "notes")
        self.check_fails(USAGE, "notes/out: cannot be made", "-o", arguments=["run", "case.toml", "-q", "-o", "notes/out"])

    def test_nothing_to_resume(self):
        self.write(CASE)
        self.check_fails(USAGE, "no result folder", arguments=["run", "case.toml", "--resume"])

    def test_resumed_with_another_case(self):
        self.write(CASE.replace("[[probe]]", 'checkpoint = { every = "5 ms" }\n[[probe]]', 1))
        self.assertEqual(self.call("run", "case.toml").returncode, DONE)
        resumed = self.call("run", "case.toml", "--resume", "--set", "time.end=0.012", "material.0.young=2e6")
        self.assertEqual(resumed.returncode, DONE)
        for line in ("material.0.young was 1000000, is 2000000", "time.end was 0.01, is 0.012"):
            self.assertIn("note: goes on with another case than before: " + line, resumed.stderr)
        self.assertNotIn("note: goes on", self.call("run", "case.toml", "--resume", "--set", "time.end=0.012",
                                                           "material.0.young=2e6").stderr)

    def test_resumed_with_an_end_that_is_past(self):
        self.write(CASE.replace("[[probe]]", 'checkpoint = { every = "5 ms" }\n[[probe]]', 1))
        self.assertEqual(self.call("run", "case.toml").returncode, DONE)
        before = (self.folder / "case.out/summary.json").read_bytes()
        self.check_fails(USAGE, "have come to t = 0.01 s, beyond time.end = 0.002 s",
                         arguments=["run", "case.toml", "--resume", "-q", "--set", "time.end=0.002"])
        self.assertEqual((self.folder / "case.out/summary.json").read_bytes(), before)
        self.assertEqual(self.call("run", "case.toml", "--resume", "-q").returncode, DONE)

    def test_unknown_key_to_describe(self):
        self.check_fails(USAGE, 'did you mean "time.safety"?', arguments=["describe", "time.safty"])

    def test_unknown_help(self):
        self.check_fails(USAGE, 'did you mean "check"?', arguments=["help", "chek"])


class BadCases(CliTest):
    def check_bad(self, old, new, *parts):
        self.assertIn(old, CASE)
        self.write(CASE.replace(old, new, 1))
        for command in ("run", "check"):
            with self.subTest(command=command, new=new):
                self.check_fails(INPUT, *parts, arguments=[command, "case.toml"])
        self.assertFalse((self.folder / "case.out/summary.json").exists())

    def test_no_file(self):
        self.check_fails(INPUT, "nowhere.toml: cannot be read", arguments=["run", "nowhere.toml"])

    def test_folder_instead_of_file(self):
        self.check_fails(INPUT, "is a folder", arguments=["run", "."])

    def test_more_particles_than_memory_holds(self):
        for particles in ("spacing = 1e-5", 'spacing = 1e-5, arrangement = "random"'):
            self.write(re.sub(r"particles = \{.*\}", "particles = { %s }" % particles, CASE))
            self.check_fails(INPUT, "case.toml:", "at the least", "larger spacing", arguments=["check", "case.toml"])

    def test_no_toml(self):
        self.check_bad("[time]", "[time", "case.toml:18:", "not valid TOML")

    def test_truncated(self):
        self.write(CASE[: CASE.index("poisson") + 4])
        self.check_fails(INPUT, "case.toml:10:", "not valid TOML", arguments=["run", "case.toml"])

    def test_binary(self):
        (self.folder / "case.toml").write_bytes(bytes(range(256)) * 8)
        self.check_fails(INPUT, "case.toml:1:", arguments=["run", "case.toml"])

    def test_unknown_key(self):
        self.check_bad("poisson", "poison", 'case.toml:10:1: material.0.poison: unknown key (did you mean "poisson"?)')

    def test_wrong_type(self):
        self.check_bad("[3, 3, 3]", '"many"', "case.toml:5:24: body.0.particles.counts: ", "three integers")

    def test_wrong_unit(self):
        self.check_bad('"1 MPa"', '"1 mm"', "case.toml:9:9: material.0.young: ", "a length in m", "a pressure in Pa")

    def test_negative_density(self):
        self.check_bad('"1000 kg/m3"', "-1000", "case.toml:11:11: material.0.density: ", "-1000", "> 0")

    def test_incompressible(self):
        self.check_bad("0.3", "0.5", "case.toml:10:11: material.0.poisson: ", "0.5", "> -1 and < 0.5")

    def test_missing_key(self):
        self.check_bad('end = "10 ms"\n', "", "case.toml:18:1: time.end: missing")

    def test_unknown_material(self):
        self.check_bad('material = "rubber"', 'material = "ruber"', "body.0.material", 'did you mean "rubber"?')

    def test_formula(self):
        self.check_bad('"0.01*t"', '"0.01*u"', "case.toml:17:23: boundary.1.displacement.0: ", 'unknown name "u"')

    def test_unit_in_a_formula(self):
        self.check_bad('"0.01*t"', '"0.01 m*t"', "case.toml:17:17: boundary.1.displacement.0: ", "numbers in formulas")

    def test_formula_without_a_value_at_the_start(self):
        self.check_bad('"0.01*t"', '"log(t)"', "case.toml:17:17: boundary.1.displacement.0: ", "is -inf at t = 0 s")

    def test_point_probe_far_outside(self):
        point = '[[probe]]\nname = "tip"\ntype = "point"\nat = [100, 0, 0]\n[[probe]]'
        self.check_bad("[[probe]]", point, "case.toml:23:1: probe.0: ", "away from the nearest particle")

    def test_reaction_of_nothing(self):
        self.check_bad('type = "reaction"\nwhere = "+x"', 'type = "reaction"\nwhere = "+y"',
                       "case.toml:23:1: probe.0: ", "takes nothing of body")

    def test_bad_choice(self):
        self.check_bad('"fixed"', '"fixd"', "case.toml:14:13: boundary.0.condition: ", 'did you mean "fixed"?')

    def test_unknown_side(self):
        self.check_bad('where = "-x"', 'where = "left"', "case.toml:13:", "left")

    def test_empty_selection(self):
        self.check_bad('where = "-x"', 'where = "X < -1"', "case.toml:1", "boundary.0")

    def test_two_conditions_on_one_component(self):
        self.check_bad('where = "+x"', 'where = ["+x", "-x"]', "case.toml:15:1: boundary.1: ", "line 12")

    def test_override(self):
        self.write(CASE)
        self.check_fails(
            INPUT, "command line: time.ends: unknown key", arguments=["run", "case.toml", "--set", "time.ends=1"]
        )

    def test_bodies_overlap(self):
        named = CASE.replace("[[boundary]]", '[[boundary]]\nbody = "block"').replace(
            "[[probe]]", '[[probe]]\nbody = "block"'
        )
        self.write(named + SECOND_BODY)
        self.check_fails(INPUT, "body.1: ", '"other" overlaps', '"block"', arguments=["run", "case.toml"])

    def test_points_file(self):
        self.check_bad("{ counts = [3, 3, 3], jitter = 0.2, seed = 3 }", '{ file = "points.csv" }', "points.csv")


class Geometry(CliTest):
    def check_geometry(self, text, *parts):
        self.write(text)
        for command in ("run", "check"):
            with self.subTest(command=command):
                self.check_fails(GEOMETRY, *parts, arguments=[command, "case.toml"])

    def test_point_outside(self):
        self.write("x,y,z\n0.25,0.5,0.5\n0.75,0.5,0.5\n1.5,0.5,0.5\n", "points.csv")
        lattice = "{ counts = [3, 3, 3], jitter = 0.2, seed = 3 }"
        self.check_geometry(CASE.replace(lattice, '{ file = "points.csv" }'), "1.5")

    def test_mesh_that_is_none(self):
        self.write("nonsense\n", "part.msh")
        text = CASE.replace("{ counts = [3, 3, 3], jitter = 0.2, seed = 3 }", '{ mesh = "part.msh" }')
        self.check_geometry(text + '[method]\nformulation = "delaunay"\n', "part.msh")


class Information(CliTest):
    def output_of(self, *arguments):
        result = self.call(*arguments)
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertEqual(result.stderr, "")
        return result.stdout

    def test_version(self):
        text = self.output_of("--version")
        for part in ("tessera ", "compiler:", "build type:", "CGAL", "10.1007/s40571-021-00452-8", "Voronoi"):
            self.assertIn(part, text)

    def test_help(self):
        text = self.output_of("--help")
        for part in ("run", "check", "describe", "new", "help", "--version"):
            self.assertIn(part, text)
        self.assertEqual(self.output_of("help"), text)

    def test_help_of_commands(self):
        self.assertEqual(self.output_of("help", "run"), self.output_of("run", "--help"))
        for option in ("--output", "--threads", "--set", "--resume", "--force", "--quiet"):
            self.assertIn(option, self.output_of("help", "run"))

    def test_describe(self):
        everything = self.output_of("describe")
        self.assertIn("material.poisson", everything)
        one = self.output_of("describe", "material.poisson")
        self.assertIn("> -1 and < 0.5", one)
        self.assertNotIn("density", one)

    def test_reference_in_the_documentation_is_current(self):
        reference = pathlib.Path(__file__).parents[2] / "docs" / "reference" / "input.md"
        self.assertEqual(
            reference.read_text(),
            self.output_of("describe", "--markdown"),
            "write it anew: tessera describe --markdown > docs/reference/input.md",
        )


class Examples(CliTest):
    def names(self):
        result = self.call("new", "--list")
        self.assertEqual(result.returncode, DONE, result.stderr)
        return [line.split()[0] for line in result.stdout.splitlines()]

    def test_new(self):
        names = self.names()
        self.assertTrue(names)
        for name in names:
            result = self.call("new", name)
            self.assertEqual(result.returncode, DONE, result.stderr)
            commands = [line for line in result.stdout.splitlines() if line.startswith("tessera run ")]
            self.assertTrue(commands)
            for command in commands:
                self.assertTrue((self.folder / command.split(" ", 2)[2]).is_file(), command)

    def test_new_overwrites_nothing(self):
        name = self.names()[0]
        self.write("precious", "mine/notes.txt")
        self.check_fails(USAGE, '"mine" exists', arguments=["new", name, "mine"])
        self.assertEqual(sorted(p.name for p in (self.folder / "mine").iterdir()), ["notes.txt"])

    def test_unknown_example(self):
        name = self.names()[0]
        self.check_fails(USAGE, f'did you mean "{name}"?', arguments=["new", name + "x"])

    def test_new_without_a_name(self):
        self.check_fails(USAGE, "--list", arguments=["new"])


class Runs(CliTest):
    def test_bodies_that_come_to_each_other(self):
        other = SECOND_BODY.replace("0.5, 0, 0", "1.1, 0, 0").replace("9, 1, 1", "2, 1, 1").replace("2, 2", "3, 3")
        other = other.replace("counts = [3, 3, 2]", "counts = [3, 3, 3]")
        text = CASE.replace("[[probe]]", other + "[[probe]]")
        for line in ('where = "-x"', 'where = "+x"'):
            text = text.replace(line, 'body = "block"\n' + line)
        for way, warned in (("0.01", False), ("60", True)):
            self.write(text.replace("0.01*t", way + "*t"))
            result = self.call("run", "case.toml", "--force", "-q")
            self.assertEqual(result.returncode, DONE, result.stderr)
            warnings = json.loads((self.folder / "case.out/summary.json").read_text())["warnings"]
            said = 'bodies "block" and "other" came to each other at'
            self.assertEqual(any(said in warning for warning in warnings), warned, warnings)
            self.assertEqual("tessera: warning: " + said in result.stderr, warned)

    def run_case(self, *arguments):
        self.write(CASE)
        result = self.call("run", "case.toml", "--quiet", *arguments)
        self.assertEqual(result.returncode, DONE, result.stderr)
        return self.folder / "case.out"

    def test_run_writes_its_results(self):
        folder = self.run_case()
        summary = json.loads((folder / "summary.json").read_text())
        self.assertEqual(summary["particles"], 27)
        self.assertAlmostEqual(summary["time"], 0.01, places=12)
        with open(folder / "history.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertAlmostEqual(float(rows[-1]["t[s]"]), 0.01, places=12)
        for column in ("kinetic[J]", "internal[J]", "external_work[J]", "grip.fx[N]"):
            self.assertIn(column, rows[0])
        self.assertGreater(float(rows[-1]["external_work[J]"]), 0)
        self.assertTrue((folder / "fields_000000.csv").is_file())

    def test_effective_case_gives_the_same_result(self):
        folder = self.run_case()
        result = self.call("run", "case.out/case.toml", "--quiet", "-o", "again")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertEqual((folder / "history.csv").read_text(), (self.folder / "again/history.csv").read_text())
        self.assertEqual((folder / "case.toml").read_text(), (self.folder / "again/case.toml").read_text())

    def test_force_replaces(self):
        folder = self.run_case()
        first = (folder / "history.csv").read_text()
        result = self.call("run", "case.toml", "--quiet", "--force", "--set", "time.end=0.005", "time.damping=1")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertNotEqual((folder / "history.csv").read_text(), first)
        self.assertAlmostEqual(json.loads((folder / "summary.json").read_text())["time"], 0.005, places=12)

    def test_result_in_an_empty_folder(self):
        (self.folder / "empty").mkdir()
        self.run_case("-o", "empty")
        self.assertTrue((self.folder / "empty/summary.json").is_file())

    def test_note_on_a_key_without_effect(self):
        self.write(CASE)
        result = self.call("run", "case.toml", "--set", "time.step=1e-4", "time.safety=0.5")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn("tessera: note: command line: time.safety: only has an effect with", result.stderr)

    def test_step_above_the_limit(self):
        self.write(CASE)
        self.check_fails(INPUT, "time.step", arguments=["run", "case.toml", "-q", "--set", "time.step=1", "time.end=2"])
        warning = "warning: a run refuses time.step = 1 s, which is above the spectral limit of "
        self.assertIn(warning, self.call("check", "case.toml", "--set", "time.step=1", "time.end=2").stdout)
        self.assertNotIn(warning, self.call("check", "case.toml", "--set", "time.step=1e-5").stdout)

    def test_check(self):
        self.write(CASE)
        result = self.call("check", "case.toml")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn("27", result.stdout)
        self.assertFalse((self.folder / "case.out").exists())
        report = self.call("check", "case.toml", "--json")
        self.assertEqual(report.returncode, DONE, report.stderr)
        self.assertIsInstance(json.loads(report.stdout), dict)


if __name__ == "__main__":
    unittest.main()
