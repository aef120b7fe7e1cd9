# Two commands do everything on a fresh Debian 12:
#   make demo [VOLUME=file] [ARGS="--dims 256 256 128 --type u8"]   builds, analyses, writes objects and tree to demo/
#   make test                                                       builds and runs every check
# `make help` lists the rest.
SHELL := /bin/bash
.SHELLFLAGS := -euo pipefail -c
.DEFAULT_GOAL := help
# Where make was called: with -C that is not here, and relative paths are of there.
export CALLER := $(PWD)
export VOLUME ARGS PREFIX SECONDS_PER_TARGET FUZZ_TARGETS

.PHONY: help demo quick test check build install package format lint bench memory studies figures table131 fuzz asan tsan coverage clean shared_data

help: ## this list
	@awk -F ':.*## ' '/^[a-z0-9]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' Makefile

demo: ## build, analyse the demonstration volume (or VOLUME=file, ARGS=options of the reader), write demo/
	@scripts/demo.sh

quick: ## the tests of what you changed, or of ROOM=tree (a folder of src): builds nothing else
	@scripts/quick.sh $(ROOM)

test: ## build everything and run every check: tests, layering, installation, format, lint
	@scripts/test.sh

build: ## the command line and the library, optimised: build/release/bin/isoatlas
	@scripts/bootstrap.sh demo
	@scripts/build.sh release

install: ## build, install to PREFIX (default /usr/local; as a user: make install PREFIX=~/.local)
	@scripts/install.sh

package: ## Debian packages and tarballs of the command line and the library: build/release/packages
	@scripts/package.sh

format: ## format all sources in place
	@scripts/bootstrap.sh test
	@scripts/format.sh --fix

lint: ## clang-tidy over src and apps, with the warnings of clang
	@scripts/bootstrap.sh test
	@scripts/lint.py

bench: ## measure: analysis against a sort, surfaces and stores against Flying Edges, pictures against VTK's ray caster, pages, growth; writes build/bench/*.json and docs/performance.md (without ../shared/data: phantoms alone); parts: scripts/bench.sh
	@scripts/bench.sh

memory: build ## does --memory hold? volumes of all kinds, sizes and budgets; writes docs/memory.md
	@mkdir -p build/bench
	@/usr/bin/python3 bench/memory/matrix.py build/release/bin/isoatlas -o build/bench/memory.json --page docs/memory.md

studies: shared_data build ## run the commands of docs/studies and remake their pictures (needs ../shared/data)
	@for page in docs/studies/[a-z]*.md; do ISOATLAS_CLI=$$PWD/build/release/bin/isoatlas python3 -B tests/docs/blocks.py pictures $$page; done

figures: build ## the figures of docs/methods.md: what the dissertation's survey of methods shows, from data of our own
	@/usr/bin/python3 -B scripts/figures build/release/bin/isoatlas docs/images/methods

table131: shared_data build ## the dissertation's table 13.1 beside ours; writes docs/performance.md (needs ../shared/data)
	@python3 bench/table131.py build/release/bin/isoatlas ../shared/data

shared_data:
	@test -d ../shared/data || { echo "This needs the volumes of ../shared/data, a folder beside the checkout that is no part of the repository. Next: make bench and make test do without" >&2; exit 2; }

fuzz: ## every fuzz target (or FUZZ_TARGETS="tiff zarr") for SECONDS_PER_TARGET (60)
	@scripts/fuzz.sh

asan: ## all tests under the address and undefined behaviour sanitizers
	@scripts/bootstrap.sh test
	@cmake --workflow --preset asan

tsan: ## all tests under the thread sanitizer
	@scripts/bootstrap.sh test
	@cmake --workflow --preset tsan

coverage: ## line coverage of src by the tests (gcov)
	@scripts/coverage.sh

clean: ## remove build/ and demo/
	@rm -rf build demo
