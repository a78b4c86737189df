#!/bin/sh
# The Python module on the library that was just built, by pytest. RAMIFY names the binary.
cd "$(dirname "$0")/../.." || exit 1
RAMIFY=${RAMIFY:-build/ramify}
out=$(dirname "$RAMIFY")
case $out in */sanitize) exit 0 ;; esac # its library needs the sanitizers' own
python=${RAMIFY_PEERS:-build/peers}/python/bin/python
if ! "$python" -c 'import numpy, pytest' 2>/dev/null; then
    echo "skipped python: NumPy and pytest are not installed"
    exit 0
fi
log=$(mktemp) && trap 'rm -f "$log"' EXIT
RAMIFY_LIBRARY="$(cd "$out" && pwd)/libramify.so" PYTHONPATH=src/python PYTHONDONTWRITEBYTECODE=1 \
    "$python" -m pytest -v --tb=short -p no:cacheprovider tests/python >"$log" 2>&1
status=$?
sed -n -E 's/^tests\/python\/[a-z_]*\.py::([^ ]*) PASSED.*/ok \1/p; s/^tests\/python\/[a-z_]*\.py::([^ ]*) (FAILED|ERROR).*/not ok \1/p' "$log"
[ $status -eq 0 ] || cat "$log"
exit $status
