#!/usr/bin/env bash
# Writes spec/suite/peers.html anew: the dashboard of this library, the adapters, and ray tracers by others.
# usage: EMBREE_LIBRARY=FILE peers.sh STACKLESS PYTHON LIBSTACKLESS, as of spec/suite/peers.py
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
stackless=$1 python=$2 libstackless=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
reports=()

# ask NAME COMMAND...: that something fails is what the page says.
ask() {
    local report=$folder/$1.json
    "$stackless" conform --show 0 --json "$report" -- "${@:2}" > /dev/null || [[ -s $report ]]
    reports+=("$report")
}

cc -std=c11 -O2 -o "$folder/traverse" spec/suite/adapters/traverse.c
ask library "$stackless" suite serve
for accuracy in precise watertight fast; do
    ask "$accuracy" "$stackless" suite serve --accuracy "$accuracy"
done
ask libstackless "$libstackless"
ask c "$folder/traverse"
ask python python3 spec/suite/adapters/traverse.py
for peer in embree-robust embree bvh parry3d obvhs-bvh2 obvhs-cwbvh; do
    ask "$peer" "$stackless" suite serve --peer "$peer"
done
for tracer in embreex-robust embreex open3d; do
    ask "pypi-$tracer" "$python" spec/suite/adapters/tracers.py "$tracer"
done
python3 spec/suite/dashboard.py "${reports[@]}" > spec/suite/peers.html
