# Tessera in two commands: `make demo` and `make test`. A thin layer over the CMake presets.
#   make build [PRESET=release]   configure and build (minimal: without CGAL's GPL triangulation)
#   make demo                     set up, build, run the punch example, say what to open
#   make test                     set up, build, run all tests, then the same for the preset minimal
#   make results                  write docs/results.md, the papers' numbers beside ours, from what the last `make test` measured
#   make accuracy                 write the tables and plots of docs/accuracy.md; 40 minutes of one core (ACCURACY_RUNS keeps the runs)
#   make incompressible           print the errors of examples/nearly-incompressible; about three quarters of an hour
#   make check                    warnings as errors, unit tests with assertions, lint
#   make format                   clang-format in place
#   make clean                    remove everything that was built, and the demo's result
PRESET ?= release
JOBS ?= $(shell nproc)
export JOBS

.PHONY: build setup demo test results accuracy incompressible check format clean
.DEFAULT_GOAL := build

build:
	cmake --preset $(PRESET)
	cmake --build --preset $(PRESET) --parallel $(JOBS)

setup:
	scripts/setup.sh

demo: setup
	$(MAKE) --no-print-directory build PRESET=release
	scripts/demo.sh build/release/bin/tessera

test:
	scripts/setup.sh --test
	scripts/test.sh release minimal

results:
	/usr/bin/python3 scripts/results_table.py build/release/verification docs/results.md

ACCURACY_RUNS ?= build/accuracy
accuracy:
	/usr/bin/python3 scripts/accuracy/study.py $(ACCURACY_RUNS)

INCOMPRESSIBLE_RUNS ?= build/incompressible
incompressible:
	TESSERA=build/release/bin/tessera /usr/bin/python3 scripts/incompressible.py $(INCOMPRESSIBLE_RUNS)

check:
	@echo "== dev: build"
	$(MAKE) --no-print-directory build PRESET=dev
	@echo "== dev: unit and house tests"
	ctest --preset dev -L 'unit|house'
	scripts/lint.sh build/dev

format:
	scripts/format.sh

clean:
	rm -rf build demo.out
