#!/usr/bin/env bash
# The extracted machines against the suite and against the Rust traversals: `check.sh STACKLESS VISITS [CASES [SEED]]`, with the
# command, the program crates/suite/examples/visits.rs, and how many cases are drawn.
set -euo pipefail
stackless=$(realpath "$1") visits=$(realpath "$2") cases=${3:-20000} seed=${4:-1}
cd "$(dirname "${BASH_SOURCE[0]}")"
began=$SECONDS

programs=$(mktemp -d)
trap 'rm -rf "$programs"' EXIT
./build.sh "$programs"
echo "machines: built in $((SECONDS - began)) s"

"$stackless" conform --suite ../../suite -- "$programs/answer"
"$visits" "$cases" "$seed" > "$programs/seen"
"$programs/differ" < "$programs/seen"

# The comparison bites: one character of what Rust has seen, a line too few, and nothing at all are noticed.
refused() {
    if "$programs/differ" > "$programs/said"; then
        echo "machines: $1 is not noticed" >&2
        exit 1
    fi
}
head -c 100000 "$programs/seen" | sed '0,/^hashed u64 1:1:0/s//hashed u64 1:1:1/' | sed '$d' > "$programs/planted"
echo "end $(grep -c ^case "$programs/planted")" >> "$programs/planted"
refused "a planted bit" < "$programs/planted"
grep -q '^DIFFERS: hashed u64' "$programs/said" || { echo "machines: a planted bit is not named" >&2; exit 1; }
sed '$d' "$programs/seen" | refused "an end that is missing"
refused "an empty input" < /dev/null
echo "machines: a planted bit, a missing end and an empty input are noticed; $((SECONDS - began)) s"
