# Every target installs what it needs into .venv, again only when the lock has changed. Layers: base runs benchmarks,
# report adds the book, cluster Dask; dev has them all, with tests, lint and types. Start with: make
# More words for the command behind a target: make bench ARGS="--workers 4". The revision that regress and judge compare
# with: make regress BASE=v0.1.0. A target that fails ends with 2.

.DEFAULT_GOAL := help
.NOTPARALLEL:
.PHONY: help setup setup-cluster bench bench-quick time prove libraries report test check lint gate regress reference lock
.PHONY: clean arrays audit judge history edition wheels

SHELL := /bin/sh
# Where it is set, each process of the tests and the report would compile every module of ours again.
unexport PYTHONDONTWRITEBYTECODE
VENV := .venv
PY := $(VENV)/bin/python
READY := $(VENV)/.base
DEV := $(VENV)/.dev
# Libraries that contradict the others; each has an environment of its own, .venv-NAME.
APART := placo robosuite
# Test processes: one more than cores, because some tests wait. Tests of one file share one: a law is compiled once.
JOBS ?= $(shell $(PY) -c 'import os; print((os.cpu_count() or 1) + 1)')

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

# The first Python on the path that the lock covers; PYTHON=... overrides.
SUPPORTED := import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))
PYTHON ?= $(shell for python in python3 python3.13 python3.12 python3.11; do \
	$$python -c '$(SUPPORTED)' 2>/dev/null && { echo $$python; break; }; done)

##@ Start here
bench: $(READY) ## run the default suite, free body and arms, and print the summary (minutes, set-up included)
	@$(PY) -m bench run --suite default --replace $(ARGS)
	@$(PY) -m bench show
report: $(VENV)/.report ## build the report: report/_build/html/index.html (ARGS=--pdf: the chapters as one PDF, too)
	@$(PY) report/build.py $(ARGS)

##@ Benchmark
bench-quick: $(READY) ## run the quick suite into results/quick (minutes)
	@$(PY) -m bench run --suite quick --replace --out results/quick $(ARGS)
	@$(PY) -m bench show results/quick
time: $(READY) ## time every law, engine and arm a tick (tests/benchmarks) on this machine: results/timings
	@$(PY) -m bench time $(ARGS)
prove: $(DEV) ## prove what the laws' files call global, from their source (minutes): results/proofs
	@$(PY) -m bench prove --out results/proofs/proofs.json $(ARGS)
libraries: .venv-libraries/.made $(APART:%=.venv-%/.made) ## compare other robot libraries (5 GB): results/libraries
	@.venv-libraries/bin/python -m bench.studies.libraries $(ARGS)
	@for name in $(APART); do .venv-$$name/bin/python -m bench.studies.libraries $$name || exit; done
judge: $(READY) ## your law against an older one: make judge LAW=my_law.py BASE=main (alone: bench judge FILE)
	@test -n "$$LAW" || { echo "Name your law's file: make judge LAW=my_law.py BASE=main" >&2; exit 2; }
	@rm -rf judge.md judge
	@$(PY) -m bench compare $(BASE) --law "$$LAW" --summary judge.md --benchmarks judge $(ARGS)
history: $(READY) ## measure this commit, add a file of pytest-benchmark to results/history, and show it (minutes)
	@$(PY) -m bench history add $(ARGS)
setup: $(READY) ## install what the benchmark needs, and nothing else
	@echo "Ready. Run the benchmark: make bench. Look around: $(VENV)/bin/bench --help"
setup-cluster: $(VENV)/.cluster ## install Dask too, for bench run --scheduler: on every machine of a cluster
	@echo "Ready. Two processes of this machine: $(VENV)/bin/bench run --scheduler local:2"

##@ Develop
test: $(DEV) ## run the tests (ARGS="-k so3" for some, -m 'not slow' for the fast ones)
	@$(PY) -m pytest -q -n $(JOBS) --maxprocesses 8 --dist loadfile --no-loadscope-reorder $(ARGS)
check: lint ## all that must hold before a merge: lint, gate, report, test
	@trap 'kill $$report' INT TERM; \
		$(MAKE) --no-print-directory report >$(VENV)/report.log 2>&1 & report=$$!; \
		$(MAKE) --no-print-directory gate; gate=$$?; \
		wait $$report; report=$$?; cat $(VENV)/report.log; test $$gate -eq 0 && test $$report -eq 0
	@$(MAKE) --no-print-directory test
	@echo "check: all green"
arrays: .venv-arrays/.made ## install JAX and PyTorch, in which a weekly test runs the short forms of the laws (6 GB)
lint: $(DEV) ## style (ruff), types (mypy), layers (import-linter) and workflow files (check-jsonschema)
	@$(VENV)/bin/ruff check
	@$(PY) -m mypy
	@$(VENV)/bin/lint-imports --no-logo
	@$(VENV)/bin/check-jsonschema --quiet --builtin-schema vendor.github-workflows .github/workflows/*.yml
	@$(VENV)/bin/check-jsonschema --quiet --builtin-schema vendor.dependabot .github/dependabot.yml
audit: ## known vulnerabilities of what the locks name (pip-audit); fails too where nobody could be asked
	@if $(MAKE) --no-print-directory .venv-audit/.made; then .venv-audit/bin/python .ci/audit.py requirements/*.txt; \
		else echo "not audited: pip-audit cannot be installed here (no network?)" >&2; exit 2; fi
gate: $(READY) ## rerun the quick suite and compare it with results/reference
	@rm -rf results/quick  # a finished run would be resumed, not rerun
	@$(PY) -m bench run --suite quick --out results/quick
	@$(PY) -m bench compare results/reference results/quick
regress: $(READY) ## your files against BASE (where you left main): outcomes, operations, time (five CPU minutes)
	@$(PY) -m bench compare $(BASE) $(ARGS)
reference: $(READY) ## run the quick suite and make it the new reference (in a commit of its own)
	@rm -rf results/quick
	@$(PY) -m bench run --suite quick --out results/quick
	@rm -rf results/reference && mkdir -p results/reference
	@cp results/quick/*.parquet results/quick/plan.json results/quick/provenance.json results/reference/
	@$(PY) -c 'from bench.experiments.tables.schema import readme; print(readme(), end="")' > results/README.md
	@kilobytes=$$(du -sk results/reference | cut -f1); test $$kilobytes -lt 5000 || \
		{ echo "results/reference is $$kilobytes kB; at most 5000 are committed" >&2; exit 1; }
	@echo "Promoted. Now: git add results && git commit"
edition: $(DEV) report ## an archive of site, data, source and wheels that rebuilds all without a network: dist
	@$(PY) -m report.edition $(ARGS)
wheels: $(READY) .venv-wheels/.made ## the audit and all laws as a wheel on NumPy alone: dist/orientation_audit-*.whl
	@rm -f dist/orientation_audit-*.whl
	@$(PY) -m bench.export.wheel dist
	@.venv-wheels/bin/twine check --strict dist/orientation_audit-*.whl
lock: $(DEV) ## write requirements/*.txt from pyproject.toml (after changing a dependency; look at git diff --stat)
	@$(call compile,dev,--extra report --extra dev --extra cluster pyproject.toml)
	@$(call compile,report,--extra report --constraint requirements/dev.txt pyproject.toml)
	@$(call compile,base,--constraint requirements/dev.txt pyproject.toml)
	@for name in cluster libraries; do \
		$(call compile,$$name,--extra $$name --constraint requirements/dev.txt pyproject.toml) || exit; done
	@for name in arrays audit wheels $(APART) install; do $(call compile,$$name,--group $$name) || exit; done
clean: ## remove environments, the built report, caches and results/quick; other results stay
	@rm -rf $(VENV) .venv-* build dist report/_build report/.jupyter_cache results/quick
	@rm -rf .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .benchmarks .home *.egg-info
	@find bench tasks report tests -name __pycache__ -prune -exec rm -rf {} + 2>/dev/null || true
help:
	@awk 'BEGIN { FS = ":[^#]*## " } /^##@/ { printf "\n%s\n", substr($$0, 5) } \
		/^[a-z-]+:.*## / { printf "  make %-13s %s\n", $$1, $$2 }' Makefile

# ------------------------------------------------------------------------------------------- set-up
# install PYTHON, LOCK: by hash, by uv, which pip brings in. The lock is complete (--no-deps: a resolver would ask for
# labmaze, see pyproject.toml), and all are wheels. A lock that has setuptools takes this package too. HELD_LAYER: the
# layers that a layer contains, besides base.
AS_LOCKED = --require-hashes --no-deps --only-binary :all: -r requirements
UV = UV_PYTHON_DOWNLOADS=never $(1) -m uv pip install --quiet --python $(1)
install = $(1) -m pip --disable-pip-version-check --quiet --no-input install $(AS_LOCKED)/install.txt \
	&& $(UV) $(NO_INDEX) --compile-bytecode $(AS_LOCKED)/$(2).txt \
	&& { ! grep -q '^setuptools==' requirements/$(2).txt || $(UV) --no-deps --no-build-isolation -e .; }
# Names, versions and hashes only. Pins already in the files are kept; to move one, pin it in pyproject.toml.
compile = env -u UV_FIND_LINKS UV_PYTHON_DOWNLOADS=never $(PY) -m uv pip compile --quiet --universal \
	--python-version 3.11 --generate-hashes --no-header --no-annotate --no-emit-index-url --no-emit-find-links \
	$(2) --output-file requirements/$(1).txt

HELD_dev := report cluster
$(VENV)/.%: $(PY) requirements/%.txt pyproject.toml
	@echo "Installing requirements/$*.txt into $(VENV) ..."
	@$(call install,$(PY),$*) && touch $(READY) $@ $(HELD_$*:%=$(VENV)/.%)

.venv-%/.made: requirements/%.txt
	@echo "Installing requirements/$*.txt into .venv-$* ..."
	@$(PYTHON) -m venv --clear .venv-$*
	@$(call install,.venv-$*/bin/python,$*) && touch $@

# An environment whose Python has gone, or that the lock does not cover, is made again.
ifneq ($(shell $(PY) -c '$(SUPPORTED)' 2>/dev/null && echo ok),ok)
$(shell rm -f $(PY))
endif
$(PY):
	@test -n "$(PYTHON)" && $(PYTHON) -c '$(SUPPORTED)' || { echo "No Python 3.11, 3.12 or 3.13: '$(PYTHON)'." \
		"Install one, or name one: make setup PYTHON=/path/to/python3.12" >&2; exit 1; }
	@test -w . || { echo "$(CURDIR) cannot be written, and $(VENV) goes into it." \
		"Give yourself the right to, or clone it where you have it" >&2; exit 1; }
	@$(PYTHON) -m venv --clear $(VENV)
