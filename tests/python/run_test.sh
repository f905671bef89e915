#!/usr/bin/env bash
# The tests of the Python module, by pytest; skipped by name where the module was not built, or pytest or numpy is missing.
# Usage: run_test.sh PYTHON BUILD_FOLDER CHECKOUT
set -euo pipefail

python="$1" build="$2" checkout="$3"
skip() { echo "SKIPPED: $*"; exit 77; }
[[ "$python" != none ]] || skip "python3-dev and pybind11-dev (./dev setup all installs them)"
for package in pytest numpy; do
  "$python" -c "import $package" 2>/dev/null || skip "python3-$package (./dev setup all installs it)"
done
export PYTHONPATH="$build/python" PYTHONDONTWRITEBYTECODE=1 TRACE_CHECKOUT="$checkout"
exec "$python" -m pytest -q -p no:cacheprovider "$checkout/tests/python"
