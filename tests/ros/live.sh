#!/bin/bash
# Usage: live.sh PYTHON. The bridge in front of peers on DDS; takes two minutes.
#
# Cyclone's Python binding holds the interpreter's lock in its calls, and a peer of these tests has once stayed in one
# for good. What does not end is therefore told where it hangs, all of it, and begun anew once. A test that fails is not.
export PYTHONFAULTHANDLER=1
for attempt in 1 2; do
    timeout --signal=ABRT 420 "$1" -m unittest -v bridge_test turning_test
    status=$?
    [ $status = 124 ] || break
    echo "bridge: attempt $attempt hung" >&2
done
exit $status
