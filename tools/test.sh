#!/usr/bin/env bash
# Linters, tests, and a build of everything in an empty working directory. Usage: tools/test.sh lint|unit|build|all
set -euo pipefail
cd "$(dirname "$0")/.."
bin="$(cd "${VENV:-.venv-test}" && pwd)/bin"
cores="${CORES:-2}"
export PATH="$bin:$PATH" PYTHONPATH="$PWD/src:$PWD"

lint() {
    echo "== locks"
    if grep -nE 'https?://|file:|--index-url|--find-links' environment*.lock; then
        echo "a lock file names a registry address; make it again by 'make lock'" >&2
        return 1
    fi
    echo "== ruff";          ruff check . && ruff format --check --quiet .
    echo "== mypy";          mypy
    echo "== snakefmt";      snakefmt --check Snakefile rules
    echo "== codespell";     codespell README.md docs src papers tests tools rules Snakefile
    echo "== snakemake --lint"
    python tools/lint_workflow.py
}

unit() {
    echo "== tests"
    python -m pytest --durations=15 "$@"
}

build() {
    echo "== build of everything from nothing"
    folder="$(mktemp -d)"
    trap 'rm -rf "$folder"' EXIT
    git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$folder"
    (
        cd "$folder"
        export PYTHONPATH="$PWD/src:$PWD"
        timeout 1500 snakemake --cores "$cores" all
        second="$(snakemake --cores "$cores" all 2>&1)" || { echo "$second" >&2; exit 1; }
        grep -q 'Nothing to be done' <<<"$second" || { echo "$second"; echo "a second run is not idle" >&2; exit 1; }
        snakemake --cores "$cores" check
    )
    export RECONTROL_BUILT="$folder"
}

case "${1:-all}" in
    lint) lint ;;
    unit) shift; unit "$@" ;;
    build) build ;;
    all) lint; build; unit ;;
    *) echo "usage: tools/test.sh lint|unit|build|all" >&2; exit 2 ;;
esac
