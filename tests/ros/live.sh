#!/bin/bash
# Usage: live.sh PYTHON. Tests the bridge with peers on DDS; takes two minutes.
#
# Cyclone's Python binding holds the interpreter's lock (GIL) during its calls, and a peer of these tests once hung in
# one. Tests that hang therefore print the stacks of all threads (ABRT), and are repeated once. Failing tests are not.
export PYTHONFAULTHANDLER=1
for attempt in 1 2; do
    timeout --signal=ABRT 420 "$1" -m unittest -v bridge_test turning_test
    status=$?
    [ $status = 124 ] || break
    echo "bridge: attempt $attempt hung" >&2
done
exit $status
