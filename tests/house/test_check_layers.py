"""Proves that scripts/check_layers.py fails when it should: every rule is broken once in a temporary tree."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
sys.dont_write_bytecode = True
import check_layers  # noqa: E402

GOOD = {
    "base/CMakeLists.txt": "tessera_layer(base LINKS fmt::fmt)\n",
    "base/vec3.hpp": "#pragma once\n#include <cmath>\n",
    "parallel/CMakeLists.txt": "tessera_layer(parallel USES base LINKS Threads::Threads)\n",
    "parallel/parallel.cpp": '#include <omp.h>\n#include "tessera/base/vec3.hpp"\n#pragma omp parallel for\n',
    "mechanics/CMakeLists.txt": "tessera_layer(mechanics USES parallel)\n",
    "mechanics/sweep.hpp": '#include "tessera/base/vec3.hpp"\n#pragma omp simd\n// std::thread is for others\n',
    "app/CMakeLists.txt": "target_link_libraries(tessera PRIVATE tessera_options tessera_mechanics CLI11::CLI11)\n",
    "app/main.cpp": '#include "tessera/mechanics/sweep.hpp"\n',
}


class CheckLayers(unittest.TestCase):
    def faults(self, **changes):
        """The faults of the good tree with some files replaced; keys: / as __, . as _dot_."""
        files = dict(GOOD)
        for key, text in changes.items():
            files[key.replace("__", "/").replace("_dot_", ".")] = text
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder, "src", "tessera", name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return check_layers.check_tree(pathlib.Path(folder))[0]

    def assert_fault(self, fragment, **changes):
        faults = self.faults(**changes)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(fragment, faults[0])

    def test_good_tree_has_no_faults(self):
        self.assertEqual(self.faults(), [])

    def test_include_upwards(self):
        self.assert_fault(
            "base/vec3.hpp:1: layer base may not include tessera/parallel/parallel.hpp",
            base__vec3_dot_hpp='#include "tessera/parallel/parallel.hpp"\n',
        )

    def test_include_sideways(self):
        self.assert_fault(
            "main.cpp:2: layer app may not include tessera/laws/law.hpp",
            laws__CMakeLists_dot_txt="tessera_layer(laws USES base)\n",
            app__main_dot_cpp='\n#include "tessera/laws/law.hpp"\n',
        )

    def test_words_after_links_are_no_layers(self):
        self.assert_fault(
            "may not include tessera/base/vec3.hpp",
            parallel__CMakeLists_dot_txt="tessera_layer(parallel LINKS base)\n",
            mechanics__sweep_dot_hpp="\n",
        )

    def test_include_that_names_no_layer(self):
        self.assert_fault("not of the form", base__vec3_dot_hpp='#include "index.hpp"\n')
        self.assert_fault("not of the form", base__vec3_dot_hpp='#include "tessera/unknown/index.hpp"\n')

    def test_cycle(self):
        self.assert_fault(
            "cycle: mechanics -> parallel -> base -> mechanics",
            base__CMakeLists_dot_txt="tessera_layer(base USES mechanics)\n",
        )

    def test_unknown_layer_in_uses(self):
        self.assert_fault(
            "USES names geometri, which is no layer",
            mechanics__CMakeLists_dot_txt="tessera_layer(mechanics USES base geometri)\n",
        )

    def test_folder_that_is_no_layer(self):
        self.assert_fault("extra/a.hpp:1: is in no layer", extra__a_dot_hpp="\n")

    def test_parallel_words_elsewhere(self):
        for line in ("#include <omp.h>", "#include <mpi.h>", "  #pragma omp parallel for", "std::thread t;",
                     "std::jthread t;", "#pragma omp parallel for simd", "#include <thread>", "MPI_Init(0, 0);",
                     "int n = omp_get_max_threads();"):
            with self.subTest(line=line):
                self.assert_fault("belong to the layer parallel", mechanics__sweep_dot_hpp=line + "\n")

    def test_length(self):
        self.assertEqual(self.faults(base__vec3_dot_hpp="\n" * 500), [])
        self.assert_fault("501 lines, at most 500", base__vec3_dot_hpp="\n" * 501)

    def test_exit_status(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(check_layers.main([folder]), 2)
            self.assertIn("no folder src/tessera", said.getvalue())
            layer = pathlib.Path(folder, "src", "tessera", "base")
            layer.mkdir(parents=True)
            (layer / "CMakeLists.txt").write_text("tessera_layer(base)\n")
            (layer / "a.hpp").write_text("#include <omp.h>\n")
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(check_layers.main([folder]), 1)
                (layer / "a.hpp").write_text("\n")
                self.assertEqual(check_layers.main([folder]), 0)


if __name__ == "__main__":
    unittest.main()
