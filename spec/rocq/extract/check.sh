#!/usr/bin/env bash
# The extracted machines against the suite and against the Rust traversals: `check.sh STACKLESS VISITS [CASES [SEED [RECORD]]]`,
# with the command, the program crates/suite/examples/visits.rs, how many cases are drawn, and where the record is left.
# A case is some 88 searches: 1,150,000 cases are 10^8.
set -euo pipefail
stackless=$(realpath "$1") visits=$(realpath "$2") cases=${3:-15000} seed=${4:-1} record=${5:-}
[[ -z $record ]] || record=$(realpath -m "$record")
cd "$(dirname "${BASH_SOURCE[0]}")"
began=$SECONDS

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
./build.sh "$work"
echo "machines: built in $((SECONDS - began)) s"

"$stackless" conform --suite ../../suite -- "$work/answer"

# In parts, so that all cores have one; their sum is the record of the whole.
parts=$(nproc) running=() records=()
for ((part = 1; part <= parts; part++)); do
    ("$visits" "$cases" "$seed" "$part/$parts" | "$work/differ" "$work/$part.json" > "$work/$part.txt" 2>&1) &
    running+=($!) records+=("$work/$part.json")
done
for ((part = 1; part <= parts; part++)); do
    wait "${running[part - 1]}" || { cat "$work/$part.txt" >&2; exit 1; }
done
"$stackless" merge "${records[@]}" --json "$work/sum.json"
[[ -z $record ]] || cp "$work/sum.json" "$record"
echo "machines: compared after $((SECONDS - began)) s"

# The comparison bites: one character of what Rust has seen, a line too few, and nothing at all are noticed.
refused() {
    if "$work/differ" > "$work/said"; then
        echo "machines: $1 is not noticed" >&2
        exit 1
    fi
}
"$visits" 100 1 > "$work/seen"
head -c 100000 "$work/seen" | sed '0,/^hashed u64 1:1:0/s//hashed u64 1:1:1/' | sed '$d' > "$work/planted"
echo "end $(grep -c ^case "$work/planted")" >> "$work/planted"
refused "a planted bit" < "$work/planted"
grep -q '^DIFFERS: hashed u64' "$work/said" || { echo "machines: a planted bit is not named" >&2; exit 1; }
sed '$d' "$work/seen" | refused "an end that is missing"
refused "an empty input" < /dev/null
echo "machines: a planted bit, a missing end and an empty input are noticed; $((SECONDS - began)) s"
