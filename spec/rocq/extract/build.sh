#!/usr/bin/env bash
# Compiles the machines to OCaml programs: `build.sh FOLDER` puts `answer` and `differ` there.
# It needs Rocq (Coq 8.16 or later), OCaml and Yojson; where one is missing, it installs Debian's packages.
set -euo pipefail
mkdir -p "$1"
out=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")"

if ! command -v coqc ocamlfind > /dev/null || ! ocamlfind query yojson > /dev/null 2>&1; then
    ../../../.ci/apt coq libcoq-flocq ocaml-nox ocaml-findlib libyojson-ocaml-dev
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/ocaml"
# All but the vectors, on which nothing is built. The proofs are compiled too: no theorem of a machine that is run is taken from
# elsewhere.
for file in $(grep '\.v$' ../_CoqProject | grep -vx -e Vectors.v -e Suite.v); do
    cp "../$file" "$work"
    (cd "$work" && coqc -q -w -variable-collision -R . Stackless "$file")
done
cp Extract.v "$work"
(cd "$work/ocaml" && coqc -q -R .. Stackless ../Extract.v)

cp ./*.ml "$work/ocaml"
cd "$work/ocaml"
programs=(answer differ)
mapfile -t modules < <(ocamldep -sort ./*.mli ./*.ml | tr ' ' '\n' | grep . | grep -vxE "\./($(IFS='|'; echo "${programs[*]}"))\.ml")
for program in "${programs[@]}"; do
    # The warnings are about what Rocq writes.
    ocamlfind ocamlopt -package yojson -linkpkg -w -a -inline 100 "${modules[@]}" "$program.ml" -o "$out/$program"
done
