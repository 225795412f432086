#!/usr/bin/env bash
# Makes a folder that checks and measures on a machine without network or compiler: `carry.sh FOLDER SCENE...`, then there
# `FOLDER/run.sh [OPTIONS OF bench]`.
set -euo pipefail

[[ $# -gt 0 ]] || { echo "usage: carry.sh FOLDER [SCENE...]" >&2; exit 2; }
folder=$1
shift
mkdir -p "$folder/scenes"
cargo install --quiet --locked --no-track --force --path "$(dirname "${BASH_SOURCE[0]}")" --root "$folder"
[[ $# -eq 0 ]] || cp -- "$@" "$folder/scenes/"

cat > "$folder/run.sh" << 'RUN'
#!/usr/bin/env bash
# The kernels against the oracle, then their times: record/DATE-gpu.md, .csv and .svg.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
shopt -s nullglob
bin/gpu-check probe
bin/gpu-check tapes
bin/gpu-check rays
bin/gpu-check exact scenes/*
bin/gpu-check bench --record record "$@" scenes/*
RUN
chmod +x "$folder/run.sh"
echo "$folder: $(du -sh "$folder" | cut -f1)"
