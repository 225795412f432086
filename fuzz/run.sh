#!/usr/bin/env bash
# Fuzzing, by recipe: `fuzz/run.sh COMMAND`. Needs nightly, and `cargo install cargo-fuzz`.
#
# smoke, rates and long write a record of each run under records, for `stackless merge`: executions, seconds, corpus, findings.
#
#   smoke [SECONDS]         every target for 1,000 executions or 120 s, two at a time; CI runs this weekly. Fewer than 200 executions
#                           are a failure: such a target would find nothing
#   rates [SECONDS]         every target for 60 s (or so many), one at a time: executions per second
#   long TARGET SECONDS     two processes that share a corpus, and go on after a finding
#   minimise TARGET [FILE]  with a file: the smallest input that fails the same way; else the fewest inputs that cover as much
#   coverage [FOLDER...]    lines of the core that seeds, regressions and corpora (or these) reach; needs llvm-22
#   seeds                   writes the seeds anew
#
# Without a sanitizer, as nothing of the library is unsafe; SANITIZER=address asks for one, for the unsafe code of dependencies.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

sanitizer=${SANITIZER:-none}
triple=$(rustc -vV | sed -n 's/^host: //p')
binaries=${CARGO_TARGET_DIR:-target}/$triple/release
# One thread is enough for inputs so small.
export RAYON_NUM_THREADS=1

targets() {
    ls seeds
}

build() {
    cargo +nightly fuzz build --sanitizer "$sanitizer" "$@"
}

# What a target does in a smoke run, beyond the inputs that it starts with, and what it must have done by the end of the time.
export wanted=1000 least=200

# What a target starts with: also the small files of the readers' tests.
folders() {
    echo {corpus,seeds,regressions}/"$1"
    case $1 in ply | obj | stl | gltf) echo ../crates/scene/tests/files ;; esac
}

# Inputs are cut in the target, so longer ones are of no use.
fuzz() {
    local target=$1 seconds=$2
    shift 2
    mkdir -p "corpus/$target" "artifacts/$target" "regressions/$target"
    touch "artifacts/$target.began"
    local dictionary=()
    [[ ! -e dictionaries/$target ]] || dictionary=("-dict=dictionaries/$target")
    local began=$SECONDS cpu status=0 TIMEFORMAT='%U %S'
    # shellcheck disable=SC2046
    cpu=$({ time "$binaries/$target" "-max_total_time=$seconds" -timeout=30 -rss_limit_mb=2048 -max_len=4096 \
        "-artifact_prefix=artifacts/$target/" -print_final_stats=1 "${dictionary[@]}" "$@" \
        $(folders "$target") > "artifacts/$target.log" 2>&1; } 2>&1) || status=$?
    record "$target" "$((SECONDS - began))" "$cpu" "$status"
    ((status == 0)) || {
        echo "$target: failed"
        grep -a -A 20 -m 1 -e 'panicked at' -e 'ERROR:' "artifacts/$target.log" | cut -c 1-2000
        return 1
    }
    local rate
    rate=$(sed -n 's/^stat::average_exec_per_sec: *//p; s/^#.* exec\/s: \([0-9]*\) oom.*/\1/p' "artifacts/$target.log" | tail -n 1)
    echo "$target: clean, $(executions "$target") executions, ${rate:-?}/s"
}

# What the log says: processes that share a corpus say it in their last line.
executions() {
    local count
    count=$(sed -n 's/^stat::number_of_executed_units: *//p; s/^#\([0-9]*\): cov: .*/\1/p' "artifacts/$1.log" | tail -n 1)
    echo "${count:-0}"
}

# record TARGET SECONDS CPU STATUS: writes what a run has done. CPU is `user system`, in seconds. The commit is left out unless
# STACKLESS_COMMIT has it, as in the records of `stackless`.
record() {
    local target=$1 seconds=$2 cpu=$3 findings commit=null version corpus now
    mkdir -p records
    version=$(sed -n 's/^version = "\(.*\)"$/\1/p' ../Cargo.toml | head -n 1)
    [[ -z ${STACKLESS_COMMIT:-} ]] || commit="\"$STACKLESS_COMMIT\""
    corpus=$(find "corpus/$target" -type f | wc -l)
    findings=$(find "artifacts/$target" -type f -newer "artifacts/$target.began" | wc -l)
    (($4 == 0 || findings > 0)) || findings=1
    printf -v now '%(%s)T' -1
    cat > "records/$target-$now.json" <<- EOF
	{
	  "run": {
	    "command": "fuzz",
	    "version": "$version",
	    "commit": $commit,
	    "asked": {},
	    "parts": {},
	    "machines": {"$(uname -s | tr '[:upper:]' '[:lower:]') $(uname -m), $(nproc) threads": $(awk '{ print $1 + $2 }' <<< "$cpu")}
	  },
	  "runs": [
	    {"target": "$target", "finished": $now, "sanitizer": "$sanitizer", "executions": $(executions "$target"),
	     "seconds": $seconds, "corpus": $corpus, "findings": $findings}
	  ]
	}
	EOF
}

# Executions are counted, not seconds: a busy machine takes long.
smoke() {
    local target=$1 seconds=$2 inputs more
    mkdir -p "corpus/$target" "regressions/$target"
    # shellcheck disable=SC2046
    inputs=$(find $(folders "$target") -type f | wc -l)
    fuzz "$target" "$seconds" "-runs=$((inputs + wanted))"
    more=$(($(executions "$target") - inputs))
    if ((more < least)); then
        echo "$target: failed: only $more executions in $seconds s"
        return 1
    fi
}

# each DO PROCESSES SECONDS: smoke or fuzz for every target.
each() {
    export binaries sanitizer
    export -f folders fuzz smoke record executions
    targets | xargs -P "$2" -I{} bash -c 'set -euo pipefail; "$@"' - "$1" {} "$3"
}

case ${1:-} in
    smoke)
        build
        each smoke 2 "${2:-120}"
        ;;
    rates)
        build
        each fuzz 1 "${2:-60}"
        ;;
    long)
        build "$2"
        fuzz "$2" "$3" -fork=2 -ignore_crashes=1
        # Those of a fork are kept, and the run goes on: a finding is a failure all the same.
        findings=$(find "artifacts/$2" -type f)
        [[ -z $findings ]] || { echo "found: $findings"; exit 1; }
        ;;
    minimise)
        if [[ -n ${3:-} ]]; then
            cargo +nightly fuzz tmin --sanitizer "$sanitizer" "$2" "$3"
        else
            cargo +nightly fuzz cmin --sanitizer "$sanitizer" "$2"
        fi
        ;;
    coverage)
        llvm=${LLVM:-/usr/lib/llvm-22/bin}
        folder=${CARGO_TARGET_DIR:-target}/coverage
        folders=("${@:2}")
        [[ -n ${folders[*]} ]] || folders=(seeds regressions corpus)
        rm -rf "$folder"/*.profraw
        export RUSTFLAGS="-C instrument-coverage" CARGO_TARGET_DIR=$folder
        LLVM_PROFILE_FILE=/dev/null cargo +nightly build --example replay
        LLVM_PROFILE_FILE=$folder/%p.profraw "$folder/debug/examples/replay" "${folders[@]}" > /dev/null
        "$llvm/llvm-profdata" merge -sparse "$folder"/*.profraw -o "$folder/all.profdata"
        # What is compiled only for tests is not here; the rest of the core counts, whoever calls it.
        files=$(cd .. && find src/{key,tree,hash,traverse} src/{trail,swap,order,event,oracle}.rs -name '*.rs' \
            ! -name 'tests.rs' ! -path '*/tests/*' | sort)
        "$llvm/llvm-cov" export --format=lcov --instr-profile="$folder/all.profdata" \
            "$folder/debug/examples/replay" > "$folder/all.lcov"
        awk -v files="$files" '
            BEGIN { n = split(files, list, "\n"); for (i = 1; i <= n; i++) wanted[list[i]] = 1 }
            /^SF:/ { file = substr($0, 4); sub(/^.*\/src\//, "src/", file); on = file in wanted }
            on && /^DA:/ { split(substr($0, 4), a, ","); key = file ":" a[1]
                if (!(key in seen)) { seen[key] = 0; lines[file]++; all++ }
                if (a[2] > 0 && !seen[key]) { seen[key] = 1; hit[file]++; hits++ } }
            END { for (i = 1; i <= n; i++) if (lines[list[i]]) { f = list[i]
                      printf "%6.2f %%  %4d of %4d  %s\n", 100 * hit[f] / lines[f], hit[f], lines[f], f }
                  printf "%6.2f %%  %4d of %4d  in all\n", 100 * hits / all, hits, all }' "$folder/all.lcov"
        ;;
    seeds)
        cargo +nightly run --example seeds -- seeds
        ;;
    *)
        sed -n 's/^# \{0,1\}//; 2,14p' "${BASH_SOURCE[0]##*/}" >&2
        exit 2
        ;;
esac
