# Every target does its own set-up in .venv, and only when the lock has changed since. Start with: make
#
# The set-up has layers: base (run benchmarks); on it report (build the book) and cluster (Dask); dev, which holds them
# all (tests, lint, types). A stamp in .venv says which are installed.

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help setup setup-cluster bench bench-quick time libraries report test check lint gate regress regress-study gains
.PHONY: scale-study contact-study settings-study verdicts-study robustness-study kill-study reference media lock clean audit judge history
.PHONY: arrays-check edition

SHELL := /bin/sh
VENV := .venv
PY := $(VENV)/bin/python
READY := $(VENV)/.base
REPORT := $(VENV)/.report
CLUSTER := $(VENV)/.cluster
DEV := $(VENV)/.dev
LIBRARIES := .venv-libraries
# Libraries that contradict the others, each with an environment of its own.
APART := placo robosuite
AUDIT := .venv-audit
ARRAYS := .venv-arrays

# Without a network, from the wheels of an edition: make bench WHEELS=../wheels
ifdef WHEELS
export PIP_NO_INDEX := 1
export PIP_FIND_LINKS := $(abspath $(WHEELS))
export UV_FIND_LINKS := $(PIP_FIND_LINKS)
NO_INDEX := --no-index
endif

# Where HOME cannot be written, as in a container under another user's number, tools keep here what they keep at home.
ifneq ($(shell test -d "$$HOME" && test -w "$$HOME" && echo ok),ok)
export HOME := $(CURDIR)/.home
endif

# A target that fails ends with 2, which is make's own exit code, whatever its command said; those of commands:
# python -m bench --help
#
# More words for the command behind a target: make bench ARGS="--workers 4", make test ARGS="-k so3"
ARGS ?=
# The revision that `make regress` compares with: make regress BASE=v0.1.0
BASE ?=
# Test processes, one more than cores, for some tests wait; tests of one file share one, so each law is compiled once.
# Which files begin: tests/conftest.py.
JOBS ?= $(shell $(PY) -c 'import os; print((os.cpu_count() or 1) + 1)')

# The first Python on the path that the lock covers; PYTHON=... overrides.
SUPPORTED := import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))
PYTHON ?= $(shell for python in python3 python3.13 python3.12 python3.11; do \
	$$python -c '$(SUPPORTED)' 2>/dev/null && { echo $$python; break; }; done)

##@ Start here
bench:  ## run the default suite, free body and arms, and print the summary (minutes, set-up included)
bench: $(READY)
	@$(PY) -m bench run --suite default --replace $(ARGS)
	@$(PY) -m bench show

report: ## build the report: report/_build/html/index.html (from your run if there is one)
report: $(REPORT)
	@$(PY) report/build.py $(ARGS)

##@ Benchmark
bench-quick: ## run the quick suite into results/quick (minutes)
bench-quick: $(READY)
	@$(PY) -m bench run --suite quick --replace --out results/quick $(ARGS)

time:   ## time every law per control tick on this machine: results/timings
time: $(READY)
	@$(PY) -m bench time $(ARGS)

libraries: ## ask other robot libraries for orientation errors (5 GB of their own): results/libraries
libraries: $(LIBRARIES)/.made $(APART:%=$(LIBRARIES)-%/.made)
	@$(LIBRARIES)/bin/python -m bench.studies.libraries $(ARGS)
	@for name in $(APART); do $(LIBRARIES)-$$name/bin/python -m bench.studies.libraries $$name || exit; done

judge:  ## your law against an older one of it: make judge LAW=my_law.py BASE=main (alone: python -m bench judge FILE)
judge: $(READY)
	@test -n "$$LAW" || { echo "Name your law's file: make judge LAW=my_law.py BASE=main" >&2; exit 2; }
	@rm -rf judge.md judge
	@$(PY) -m bench compare $(BASE) --law "$$LAW" --summary judge.md --benchmarks judge $(ARGS)

history: ## measure this commit, add a file of pytest-benchmark to results/history, and show it (minutes)
history: $(READY)
	@$(PY) -m bench history add $(ARGS)

scale-study: ## what 10^3 to 10^6 episodes cost, on one thread and on processes (ten minutes): results/scale
scale-study: $(CLUSTER)
	@$(PY) -m bench.studies.scale $(ARGS)

setup:  ## install what the benchmark needs, and nothing else
setup: $(READY)
	@echo "Ready. Run the benchmark: make bench. Look around: $(PY) -m bench --help"

setup-cluster: ## install Dask too, for bench run --scheduler: on every machine of a cluster
setup-cluster: $(CLUSTER)
	@echo "Ready. Two processes of this machine: $(PY) -m bench run --scheduler local:2"

##@ Develop
test:   ## run the tests (ARGS="-k so3" for some, -m 'not slow' for the fast ones)
test: $(DEV)
	@$(PY) -m pytest -q -n $(JOBS) --maxprocesses 8 --dist loadfile --no-loadscope-reorder $(ARGS)

check:  ## all that must hold before a merge: lint, gate, report, test
check: lint
	@trap 'kill $$report' INT TERM; \
		$(MAKE) --no-print-directory report >$(VENV)/report.log 2>&1 & report=$$!; \
		$(MAKE) --no-print-directory gate; gate=$$?; \
		wait $$report; report=$$?; cat $(VENV)/report.log; test $$gate -eq 0 && test $$report -eq 0
	@$(MAKE) --no-print-directory test
	@echo "check: all green"

lint:   ## style (ruff), types (mypy), layers (import-linter) and workflow files (check-jsonschema)
lint: $(DEV)
	@$(VENV)/bin/ruff check
	@$(PY) -m mypy
	@$(VENV)/bin/lint-imports --no-logo
	@$(VENV)/bin/check-jsonschema --quiet --builtin-schema vendor.github-workflows .github/workflows/*.yml
	@$(VENV)/bin/check-jsonschema --quiet --builtin-schema vendor.dependabot .github/dependabot.yml

audit:  ## known vulnerabilities of what the locks name (pip-audit); without a network it says so
audit:
	@if $(MAKE) --no-print-directory $(AUDIT)/.made; then $(AUDIT)/bin/python .ci/audit.py requirements/*.txt; \
		else echo "audit skipped: pip-audit cannot be installed here (no network?)"; fi

arrays-check: ## exported laws on the arrays of JAX, in an environment of its own (0.6 GB)
arrays-check: $(DEV) $(ARRAYS)/.made
	@$(PY) -m pytest tests/export/test_python_arrays.py $(ARGS)

gate:   ## rerun the quick suite and compare it with results/reference
gate: $(READY)
	@rm -rf results/quick  # a finished run would be resumed, not rerun
	@$(PY) -m bench run --suite quick --out results/quick
	@$(PY) -m bench compare results/reference results/quick

regress: ## your files against BASE (where you left main): outcomes, operations, time (five CPU minutes)
regress: $(READY)
	@$(PY) -m bench compare $(BASE) $(ARGS)

regress-study: ## false alarms and planted faults of that gate (20 CPU minutes, can be resumed): results/regress
regress-study: $(READY)
	@$(PY) -m bench.studies.gates $(ARGS)

contact-study: ## in contact: stiffness, delay, noise, admittance, fits of pegs, springs (five minutes): results/contact
contact-study: $(READY)
	@$(PY) -m bench.studies.contact $(ARGS)

settings-study: ## is a run the same on every processor? quick suites under other settings (15 minutes): results/settings
settings-study: $(READY)
	@$(PY) -m bench.studies.settings $(ARGS)

robustness-study: ## shares lost under every perturbation, 400 starts a level (6 CPU minutes): results/robustness
robustness-study: $(READY)
	@$(PY) -m bench.studies.robustness $(ARGS)

verdicts-study: ## does a verdict hang on the draw or the step? 20 seeds, half the step (half an hour): results/verdicts
verdicts-study: $(READY)
	@$(PY) -m bench.studies.verdicts $(ARGS)

kill-study: ## kill 100 runs, fill disks, break laws: does each end the same? (minutes): results/survival
kill-study: $(CLUSTER)
	@PYTHONPATH=tests $(PY) -W ignore tests/studies/kill_study.py $(ARGS)

reference: ## run the quick suite and make it the new reference (commit it by itself)
reference: $(READY)
	@rm -rf results/quick
	@$(PY) -m bench run --suite quick --out results/quick
	@rm -rf results/reference && mkdir -p results/reference
	@cp results/quick/*.parquet results/quick/plan.json results/quick/provenance.json results/reference/
	@$(PY) -c 'from bench.tables.schema import readme; print(readme(), end="")' > results/README.md
	@kilobytes=$$(du -sk results/reference | cut -f1); test $$kilobytes -lt 5000 || \
		{ echo "results/reference is $$kilobytes kB; at most 5000 are committed" >&2; exit 1; }
	@echo "Promoted. Now: git add results && git commit"

gains: ## the quick suite at three more damping ratios, narrowed to what the advice reads: results/gains
gains: $(READY)
	@for kv in 10 14 30; do $(PY) -m bench run --suite quick --kv $$kv --replace --out results/quick-kv-$$kv && \
		$(PY) -m bench.findings.selection.gains results/quick-kv-$$kv results/gains/kv-$$kv || exit; done

edition: ## the site, its print, data, paper, source and wheels to rebuild it without a network: dist
edition: $(DEV) report
	@$(PY) -m report.edition $(ARGS)

media:  ## render the arms anew for the report (needs GL; without it the committed files stay)
media: $(DEV)
	@$(PY) report/media.py

lock:   ## write requirements/*.txt anew from pyproject.toml (after changing a dependency)
lock: $(DEV)
	@$(call compile,dev,--extra report --extra dev --extra cluster)
	@$(call compile,report,--extra report --constraint requirements/dev.txt)
	@$(call compile,base,--constraint requirements/dev.txt)
	@$(call compile,cluster,--extra cluster --constraint requirements/dev.txt)
	@$(call compile,libraries,--extra libraries --constraint requirements/dev.txt)
	@$(locked) --group audit --output-file requirements/audit.txt
	@for name in $(APART); do $(locked) --group $$name --output-file requirements/$$name.txt || exit; done
	@$(locked) --group install --output-file requirements/install.txt
	@$(locked) --group arrays --constraint requirements/base.txt --output-file requirements/arrays.txt
	@echo "Locked. Look at the change: git diff --stat requirements"

clean:  ## remove .venv, the built report, caches and results/quick; other results stay
	@rm -rf $(VENV) $(LIBRARIES) $(APART:%=$(LIBRARIES)-%) $(AUDIT) $(ARRAYS) build dist report/_build report/.jupyter_cache results/quick
	@rm -rf .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .benchmarks .home *.egg-info
	@find bench tasks report tests -name __pycache__ -prune -exec rm -rf {} + 2>/dev/null || true

help:
	@awk 'BEGIN { FS = ":[^#]*## " } \
		/^##@/ { printf "\n%s\n", substr($$0, 5) } \
		/^[a-z-]+:.*## / { printf "  make %-13s %s\n", $$1, $$2 }' Makefile
	@printf '\nNew here? Type: make bench\n'

# ------------------------------------------------------------------------------------------- set-up
# Installed as locked and checked by hash, by uv, which pip brings in. The lock is complete, so nothing need be resolved
# (--no-deps: it would ask for labmaze, see pyproject.toml); wheels only, so that nothing is ever compiled here.
PIP = $(PY) -m pip --disable-pip-version-check --quiet --no-input
UV = UV_PYTHON_DOWNLOADS=never $(PY) -m uv
AS_LOCKED = --require-hashes --no-deps --only-binary :all: -r requirements
install = $(PIP) install $(AS_LOCKED)/install.txt \
	&& $(UV) pip install --quiet $(NO_INDEX) --python $(PY) --compile-bytecode $(AS_LOCKED)/$(1).txt \
	&& $(UV) pip install --quiet --python $(PY) --no-deps --no-build-isolation -e .

$(READY): $(PY) requirements/base.txt pyproject.toml
	@echo "Installing the benchmark into $(VENV) ..."
	@$(call install,base) && touch $@

$(REPORT): $(PY) requirements/report.txt pyproject.toml
	@echo "Installing the benchmark and the report tools into $(VENV) ..."
	@$(call install,report) && touch $(READY) $@

$(CLUSTER): $(PY) requirements/cluster.txt pyproject.toml
	@echo "Installing the benchmark and Dask into $(VENV) ..."
	@$(call install,cluster) && touch $(READY) $@

$(DEV): $(PY) requirements/dev.txt pyproject.toml
	@echo "Installing the benchmark, the report tools and the developer tools into $(VENV) ..."
	@$(call install,dev) && touch $(READY) $(REPORT) $(CLUSTER) $@

$(LIBRARIES)/.made: PY = $(LIBRARIES)/bin/python
$(LIBRARIES)/.made: requirements/libraries.txt pyproject.toml
	@echo "Installing robot libraries into $(LIBRARIES) ..."
	@$(PYTHON) -m venv --clear $(LIBRARIES)
	@$(call install,libraries) && touch $@

$(ARRAYS)/.made: PY = $(ARRAYS)/bin/python
$(ARRAYS)/.made: requirements/arrays.txt
	@$(PYTHON) -m venv --clear $(ARRAYS)
	@$(PIP) install $(AS_LOCKED)/arrays.txt && touch $@

$(LIBRARIES)-%/.made: PY = $(LIBRARIES)-$*/bin/python
$(LIBRARIES)-%/.made: requirements/%.txt
	@echo "Installing $* into $(LIBRARIES)-$* ..."
	@$(PYTHON) -m venv --clear $(LIBRARIES)-$*
	@$(call install,$*) && touch $@

$(AUDIT)/.made: PY = $(AUDIT)/bin/python
$(AUDIT)/.made: requirements/audit.txt
	@$(PYTHON) -m venv --clear $(AUDIT)
	@$(PIP) install $(AS_LOCKED)/audit.txt && touch $@

# An environment whose Python has gone, or that the lock does not cover, is made anew.
ifneq ($(shell $(PY) -c '$(SUPPORTED)' 2>/dev/null && echo ok),ok)
$(shell rm -f $(PY))
endif
$(PY):
	@test -n "$(PYTHON)" || { echo "No Python 3.11, 3.12 or 3.13 on the path. Install one, or name one:" \
		"make setup PYTHON=/path/to/python3.12" >&2; exit 1; }
	@$(PYTHON) -c '$(SUPPORTED)' || { echo "PYTHON=$(PYTHON) is not Python 3.11, 3.12 or 3.13." \
		"Name one that is: make setup PYTHON=/path/to/python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip' 2>/dev/null || { echo "$(PYTHON) cannot make virtual environments." \
		"On Debian or Ubuntu: apt install python3-venv" >&2; exit 1; }
	@test -w . || { echo "$(CURDIR) cannot be written, and $(VENV) goes into it." \
		"Give yourself the right to, or clone it where you have it" >&2; exit 1; }
	@$(PYTHON) -m venv --clear $(VENV)

# Names, versions and hashes only. Pins already in the files are kept; to move one, pin it in pyproject.toml.
locked = env -u UV_FIND_LINKS $(UV) pip compile --quiet \
	--universal --python-version 3.11 --generate-hashes --no-header --no-annotate --no-emit-index-url \
	--no-emit-find-links
compile = $(locked) $(2) pyproject.toml --output-file requirements/$(1).txt
