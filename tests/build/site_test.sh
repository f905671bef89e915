#!/usr/bin/env bash
# The scripts of the site: pages are staged so that MkDocs reads them as GitHub does, and the check finds what is broken.
# Needs no MkDocs. Usage: site_test.sh CHECKOUT
set -euo pipefail

python3 -c '' 2>/dev/null || { echo "SKIPPED: python3 (./dev setup all installs it)"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$1/site"
exec python3 "$(dirname -- "${BASH_SOURCE[0]}")/site_test.py"
