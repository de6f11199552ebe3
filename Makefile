# Two commands do everything: `make reproduce` and `make test`. `make help` lists the rest.
PYTHON ?= python3
VENV ?= .venv
CORES ?= 2
BIN = $(VENV)/bin
LOCK_DATE ?=

.DEFAULT_GOAL := help
.PHONY: help reproduce test check lint unit build environment test-environment bench slurm speed faults matrix lock schemas book picture bundle clean distclean

help: ## this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed 's/:.*## /\t/' | expand -t 18

environment: ## the run-time environment from environment.lock
	@$(PYTHON) tools/environment.py $(VENV) environment.lock

test-environment: ## the same with the test tools
	@$(PYTHON) tools/environment.py $(VENV)-test environment-test.lock

reproduce: environment ## rebuild every paper: results/, figures/, results/report/index.html
	@$(BIN)/snakemake --cores $(CORES) all
	@echo "report: results/report/index.html"

check: environment ## show every difference from the reviewed verdicts and figures
	@$(BIN)/snakemake --cores $(CORES) check

test: test-environment ## linters, all tests, then a build of everything from nothing, and check
	@VENV=$(VENV)-test CORES=$(CORES) tools/test.sh all

lint: test-environment ## the linters alone
	@VENV=$(VENV)-test tools/test.sh lint

unit: test-environment ## the tests alone
	@VENV=$(VENV)-test tools/test.sh unit

faults: test-environment ## every fault test at full size, after `make reproduce`; writes docs/reliability.md (over an hour)
	@PYTHONPATH=src:. $(VENV)-test/bin/python tools/reliability.py --all

bench: environment ## speed of the ensembles against plain loops; writes docs/performance.md (a minute)
	@PYTHONPATH=src:. $(BIN)/python tools/bench.py --write

matrix: test-environment ## all papers under other kernels, threads, solvers and Pythons; writes docs/reproducibility.md (an hour)
	@PYTHONPATH=src:. $(VENV)-test/bin/python tools/matrix.py

speed: environment ## the chain from nothing and after single edits; writes docs/performance.md (ten minutes, on a quiet machine)
	@PYTHONPATH=src:. $(BIN)/python tools/speed.py

schemas: test-environment ## JSON Schemas of paper.yaml and claims.yaml for editors
	@$(VENV)-test/bin/python tools/schemas.py

book: reproduce ## VERDICTS.md, docs/errata and the counts of the README, from a finished run
	@PYTHONPATH=src $(BIN)/python -m recontrol.report book

picture: test-environment ## the README's picture of the report, from a finished run (needs chromium)
	@$(VENV)-test/bin/python tools/picture.py

bundle: reproduce ## what one would deposit in an archive: run/bundle/, with a manifest of digests
	@PYTHONPATH=src $(BIN)/python -m recontrol.report bundle

slurm: ## the campaign on a real SLURM on this machine: kill, resume, compare (root and Debian's slurm packages; 5 minutes)
	@$(PYTHON) tools/environment.py $(VENV)-slurm environment-slurm.lock
	@$(VENV)-slurm/bin/python tests/slurm/campaign.py $(PAPER)

lock: ## resolve pyproject.toml into the lock files (needs uv; LOCK_DATE=2026-11-01 repeats a resolution)
	uv pip compile --universal --python-version 3.11 --generate-hashes --no-header \
	  $(if $(LOCK_DATE),--exclude-newer $(LOCK_DATE)) pyproject.toml -o environment.lock
	uv pip compile --universal --python-version 3.11 --generate-hashes --no-header --extra test \
	  $(if $(LOCK_DATE),--exclude-newer $(LOCK_DATE)) -c environment.lock pyproject.toml -o environment-test.lock
	uv pip compile --universal --python-version 3.11 --generate-hashes --no-header --extra slurm \
	  $(if $(LOCK_DATE),--exclude-newer $(LOCK_DATE)) -c environment.lock pyproject.toml -o environment-slurm.lock

clean: ## remove what the chain made
	rm -rf results figures run .snakemake

distclean: clean ## and the environments
	rm -rf .venv .venv-test .venv-slurm .pytest_cache .mypy_cache .ruff_cache .hypothesis
