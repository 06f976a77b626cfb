# Everything a person types to build, test and install cgaft. `make help` lists it.

CARGO ?= cargo
TARGET = $(if $(CARGO_TARGET_DIR),$(CARGO_TARGET_DIR),target)
# What a solver of several ranks is built and started with.
MPI_PACKAGES = libopenmpi-dev openmpi-bin $(shell .ci/libclang)
# The studies of chapter 5 of Deng (2011).
CHAPTER_5 = models-A-E models-A-E-fine models-A-E-mixed models-A-E-refined models-A-E-atoms case-1 case-2 branching-control convergence-D
# Those of chapter 6, in elements; the cases with atoms take far longer and are run by name.
CHAPTER_6 = film-3d mixed-mode impact crack-surface
# Where `make install` puts the programs: PREFIX/bin, or where cargo installs, if PREFIX is empty.
PREFIX ?=

.PHONY: help quickstart build test verify stability wrong-formulas bench speed-against-error chapter-5 $(CHAPTER_5) chapter-6 $(CHAPTER_6) scaling check lint schema setup test-setup install
.NOTPARALLEL:

help:
	@echo 'make quickstart   build, then run studies/quickstart.yaml and build its report'
	@echo 'make test         build, then run all fast tests'
	@echo 'make verify       the long verification: closed forms, the same specimens in LAMMPS, and a real Slurm, which it installs; writes docs/verification.md'
	@echo 'make wrong-formulas   makes formulas wrong, one at a time, and looks whether a test fails; a part of verify; ONLY="NAME" for one'
	@echo 'make stability    all hard cases of studies/hard-cases, each with what is expected of it; writes docs/stability.md'
	@echo 'make bench        what a step, a run and a command cost on this machine, beside LAMMPS; writes docs/performance.md'
	@echo 'make speed-against-error   what each economy costs and saves, beside LAMMPS; writes reports/speed-against-error'
	@echo 'make models-A-E   models A to E of Deng (2011) at full size; writes reports/models-A-E'
	@echo 'make chapter-5    the same, then in small elements, mixed, in atoms (D alone), cases 1 and 2, branching-control and convergence-D, each also by its name'
	@echo 'make chapter-6    the film, the film under mixed load, the plate under a ball and the block of chapter 6 in elements, each also by its name; ONLY= for all cases, also those with atoms'
	@echo 'make scaling      what ranks gain here, and what more of them would; writes reports/scaling-*'
	@echo 'make check        everything to be checked before a commit: format, lints, tests, schema'
	@echo 'make install      put cgaft and cgaft-solve on the PATH (PREFIX=DIR: into DIR/bin), with their man pages'
	@echo 'make schema       write schemas/study.schema.json again from the types'
	@echo 'make setup        install the Debian packages that are missing'

quickstart: build
	$(TARGET)/release/cgaft study run studies/quickstart.yaml

# The solver is the only program that needs an MPI library; without one it computes with threads alone.
build: setup
	$(CARGO) build --release --locked --bin cgaft
	@CARGO=$(CARGO) .ci/solver $(TARGET)

# The tests look at both solvers, with and without MPI, and leave behind what `make build` makes.
test: test-setup
	$(CARGO) test --release --locked
	@CARGO=$(CARGO) .ci/solver $(TARGET)

# The programs are built first, so that the verification has them whatever was built before.
# Where Slurm cannot be installed its test says so and passes.
verify: build test-setup
	@.ci/packages lammps
	@.ci/packages slurm-wlm || echo 'going on without Slurm: its test is skipped'
	CGAFT_WRITE_DOCS=1 $(CARGO) test --release --locked --test verify
	@CARGO=$(CARGO) .ci/solver $(TARGET)

stability: build
	CGAFT_WRITE_DOCS=1 $(CARGO) test --release --locked --test stability

# In a copy of the sources; a part of `make verify`.
wrong-formulas: test-setup
	target/python/bin/python tests/wrong_formulas.py $(if $(ONLY),'$(ONLY)')

# Takes some minutes. The numbers are worth most on a machine that does nothing else.
bench: build
	@.ci/packages lammps
	@mkdir -p target/mpi && cp $(TARGET)/release/cgaft-solve target/mpi/
	$(CARGO) bench --locked --bench performance
	@CARGO=$(CARGO) .ci/solver $(TARGET)

# The costs in the report are those of this machine, so LAMMPS is measured on it too.
speed-against-error: build
	@.ci/packages lammps
	benches/lammps.sh $(TARGET)/release/cgaft > $(TARGET)/lammps.csv
	cp $(TARGET)/lammps.csv studies/speed-against-error/lammps.csv
	$(TARGET)/release/cgaft study run studies/speed-against-error.yaml --fresh --jobs 2 --results $(TARGET)/results
	reports/keep $(TARGET)/results/speed-against-error

# A study at a time; of models A to E in atoms only D, which takes minutes.
chapter-5: $(CHAPTER_5)
models-A-E-atoms: ONLY = --only D
$(CHAPTER_5): build
	$(TARGET)/release/cgaft study run studies/$@.yaml $(ONLY) --results $(TARGET)/results
	reports/keep $(TARGET)/results/$@

chapter-6: $(CHAPTER_6)
film-3d: ONLY = --only 'elements*,mixed'
mixed-mode: ONLY = --only elements,counted,opened
impact: ONLY = --only 'heavy,free-heavy,copper,free,tenth,tenth-slow'
$(CHAPTER_6): build
	$(TARGET)/release/cgaft study run studies/$@.yaml $(ONLY) --results $(TARGET)/results
	reports/keep $(TARGET)/results/$@

# These runs are there for their times, so nothing else should run meanwhile.
scaling: build
	$(TARGET)/release/cgaft study run studies/scaling-fixed.yaml --fresh --results $(TARGET)/results
	$(TARGET)/release/cgaft study run studies/scaling-scaled.yaml --fresh --results $(TARGET)/results
	$(TARGET)/release/cgaft study run studies/scaling-fixed-3d.yaml --fresh --results $(TARGET)/results
	$(TARGET)/release/cgaft study run studies/scaling-scaled-3d.yaml --fresh --results $(TARGET)/results
	for study in scaling-fixed scaling-scaled scaling-fixed-3d scaling-scaled-3d; do reports/keep $(TARGET)/results/$$study; done

check: lint test
	$(TARGET)/release/cgaft schema | diff schemas/study.schema.json - \
		|| { echo 'schemas/study.schema.json is stale: make schema'; exit 1; }

# The last line: building and testing must agree on the features of every crate, or each compiles the heavy ones again.
lint: setup
	$(CARGO) fmt --check
	$(CARGO) clippy --release --locked --all-targets -- -D warnings
	$(CARGO) clippy --release --locked --test verify --test stability -- -D warnings
	@! command -v mpicc >/dev/null || $(CARGO) clippy --release --locked --bin cgaft-solve --features mpi -- -D warnings
	.ci/shared-crates

schema: build
	mkdir -p schemas
	$(TARGET)/release/cgaft schema > schemas/study.schema.json

install: build
	@if [ -n '$(PREFIX)' ]; then bin='$(PREFIX)/bin'; else bin="$${CARGO_HOME:-$$HOME/.cargo}/bin"; fi; \
	if [ -z '$(PREFIX)' ] && ! { [ -d "$$bin" ] && [ -w "$$bin" ]; }; then bin="$$HOME/.local/bin"; fi; \
	mkdir -p "$$bin" && install -m 755 $(TARGET)/release/cgaft $(TARGET)/release/cgaft-solve "$$bin" || exit 1; \
	$(TARGET)/release/cgaft man "$$(dirname "$$bin")/share/man/man1" >/dev/null || exit 1; \
	echo "installed cgaft and cgaft-solve in $$bin, their man pages beside it in share/man"; \
	case ":$$PATH:" in *":$$bin:"*) ;; *) echo "put it on the PATH: export PATH=\"$$bin:\$$PATH\"" ;; esac

setup:
	@command -v $(CARGO) >/dev/null || { echo 'cargo is not on the PATH: install Rust 1.89 or later (https://rustup.rs), open a new shell, and call make again'; exit 1; }
	@.ci/packages libhdf5-dev pkg-config
	@.ci/packages $(MPI_PACKAGES) || echo 'going on without MPI: cases use threads, on one machine each'

test-setup: setup
	@.ci/node target/node yaml-language-server@1
	@.ci/python target/python h5py numpy vtk pandas pyvista ovito ase
	@CARGO=$(CARGO) .ci/solver $(TARGET) --example one_rank_panics
	@mkdir -p target/mpi && cp $(TARGET)/release/cgaft-solve $(TARGET)/release/examples/one_rank_panics target/mpi/
