#!/usr/bin/env bash
# Proves the harnesses of `proofs` by CBMC, on the library compiled to WebAssembly and from there to C. This is not Kani.
#
# `check.sh` proves those for every day, `check.sh --long` those too that take long, and `check.sh HARNESS...` the named
# ones. Each is proved within its bound, its covers must be reached, and its twin must be refuted at the claim that it
# breaks; anything else fails. What is missing is installed (packages of Debian 12).
#
# `check.sh --loops` and `check.sh --loops HARNESS...` prove only that the bound is enough for loops as the source has
# them, and so as Kani meets them: otherwise the compiler has unrolled those over few items. Without names these are the
# steps, and the harnesses with a bound below 9.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export loops=
if [[ ${1:-} == --loops ]]; then loops=yes && shift; fi
base=${CARGO_TARGET_DIR:-$here/../../target}/cbmc
mkdir -p "$base${loops:+/loops}"
base=$(cd "$base" && pwd)
export tools=$base/tools work=$base${loops:+/loops}
export shim=$here/shim.c
# Seconds of the processor for one run of CBMC: a loaded machine does not change what is proved.
export limit=${CBMC_LIMIT:-300}

install_tools() {
    local missing=()
    [[ -x /usr/bin/rustc ]] || missing+=(rustc-web rust-web-src libstd-rust-web-dev)
    [[ -n $(compgen -c wasm-ld) ]] || missing+=(lld-22)
    [[ -n $(command -v wasm2c) ]] || missing+=(wabt)
    [[ -n $(command -v gcc) ]] || missing+=(gcc libc6-dev)
    ((${#missing[@]} == 0)) || "$here/../../.ci/apt" "${missing[@]}"
    "$tools/goto-cc" --version > /dev/null 2>&1 || "$here/get-cbmc.sh" "$tools"
}

# One line a harness: name, twin, unwind, that of loops within a loop, how often, covers, claim.
list() {
    # In a folder of its own: a build beside this one would hold the lock of the other.
    CARGO_TARGET_DIR="$base/list" CARGO_PROFILE_DEV_OPT_LEVEL=0 cargo run -q -p proofs --bin list > "$work/list.tsv"
}

build() {
    local linker=$(compgen -c wasm-ld | sort | tail -1)
    # All in registers: what is inlined is not in memory, where every access is a case distinction.
    local flags="--cfg kani -C linker-flavor=wasm-ld -C linker=$linker -C strip=debuginfo
        -C llvm-args=-inline-threshold=20000 -C panic=immediate-abort -Z unstable-options
        -C link-arg=-zstack-size=2048 -C link-arg=--initial-memory=65536 -C link-arg=--max-memory=65536"
    # Loops are not unrolled, and keep their condition at the head.
    local kept=(-- -C llvm-args="-unroll-full-max-count=0 -unroll-max-upperbound=0 -unroll-allow-peeling=0 -rotation-max-header-size=0")
    (cd "$here" && RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 RUSTFLAGS=$(echo $flags) CARGO_TARGET_DIR="$base/wasm" \
        cargo rustc -q --release --target wasm32-unknown-unknown -Z build-std=core,alloc ${loops:+"${kept[@]}"})
    cd "$work"
    wasm2c "$base"/wasm/wasm32-unknown-unknown/release/harnesses.wasm -n harnesses -o harnesses.c
    # Typed accesses in place of copies of bytes, and no barriers for compilers.
    sed -i -e 's/wasm_rt_memcpy(&result, &mem->data\[addr\], sizeof(t1));/result = *(t1*)(\&mem->data[addr]);/' \
        -e 's/wasm_rt_memcpy(&mem->data\[addr\], &wrapped, sizeof(t1));/*(t1*)(\&mem->data[addr]) = wrapped;/' \
        -e 's/#define wasm_asm __asm__/#define wasm_asm(...)/' harnesses.c
    cut -f6 list.tsv | tr ';' '\n' | sort -u | sed -n 's/^\([0-9]*\):\(.*\)/COVER(\1u, "\2")/p' > covers.inc
}

# Of the C text, to NAME.c, what one harness and its twin call. CBMC reads all of a program for each run, and with what is never
# called there, that is most of the time. What is called and left out has no body, which fails.
slice() {
    awk -F'\t' '
        NR == FNR {
            line[++lines] = $0
            if (/^[a-z].*\) \{$/ && match($0, /(w2c|Z_harnessesZ)_[A-Za-z_0-9]+\(/)) {
                name = substr($0, RSTART, RLENGTH)
                first[name] = lines
            } else if (name != "" && $0 == "}") {
                last[name] = lines
                name = ""
            } else if (name != "") {
                for (rest = $0; match(rest, /w2c_[A-Za-z_0-9]+\(/); rest = substr(rest, RSTART + RLENGTH))
                    calls[name] = calls[name] " " substr(rest, RSTART, RLENGTH)
            }
            next
        }
        {
            delete called
            delete over
            call("Z_harnessesZ_" $1 "(")
            call("Z_harnessesZ_" $2 "(")
            for (name in first) if (!(name in called)) over[first[name]] = last[name]
            text = $1 ".c"
            for (i = 1; i <= lines; i++) if (i in over) i = over[i]; else print line[i] > text
            close(text)
        }
        function call(name,    list, count, j) {
            if (name in called || !(name in first)) return
            called[name]
            count = split(calls[name], list, " ")
            for (j = 1; j <= count; j++) call(list[j])
        }
    ' harnesses.c picked.tsv
}

# The loops that are within another, as CBMC names them: by the function, and the number of the jump back in it.
nested() {
    awk '
        function tell(    i, j) {
            for (i = 0; i < count; i++)
                for (j = 0; j < count; j++)
                    if (head[j] < head[i] && back[j] > back[i]) { print name "." i; break }
            count = 0
            delete at
        }
        /^[a-z].*\) \{$/ { tell(); name = $0; sub(/\(.*/, "", name); sub(/.* /, "", name) }
        match($0, /w2c_L[0-9]+:/) { at[substr($0, RSTART, RLENGTH - 1)] = NR }
        match($0, /goto w2c_L[0-9]+;/) {
            label = substr($0, RSTART + 5, RLENGTH - 6)
            if (label in at) { head[count] = at[label]; back[count++] = NR }
        }
        END { tell() }
    ' harnesses.c
}

# The program of one harness and its twin.
compile() {
    local name=$1 twin=$2
    # So that none of an earlier run is proved where this one fails.
    rm -f "$name.gb"
    "$tools/goto-cc" --function "prove_$name" -I. -DWASM_RT_MEMCHECK_SIGNAL_HANDLER=0 -DWASM_RT_USE_STACK_DEPTH_COUNT=0 \
        -DWASM_RT_SKIP_SIGNAL_RECOVERY=1 -D"PROVED=HARNESS($name) HARNESS($twin)" "$name.c" "$shim" -o "$name.gb"
}

# One run; what CBMC says goes to NAME.log, the seconds of its processor to NAME.seconds.
solve() {
    local program=$1 name=$2 unwind=$3 nested=$4 TIMEFORMAT=%U sets
    shift 4
    # That these bounds are enough is claimed too, as for all loops.
    sets=$(sed -n "/^w2c_$name\./s/\$/:$nested/p" nested.txt | paste -sd,)
    [[ -z $sets || $nested == "$unwind" ]] || set -- --unwindset "$sets" "$@"
    {
        time {
            (ulimit -t "$limit" && exec "$tools/cbmc" "$work/$program.gb" --function "prove_$name" --unwind "$unwind" \
                --unwinding-assertions --no-standard-checks --drop-unused-functions --slice-formula ${loops:+--no-assertions} "$@") \
                > "$work/$name.log" 2>&1 || true
        }
    } 2> "$work/$name.seconds"
}

# Proof, covers and twin of one harness: a row of the table, and whether all is as it must be.
check_one() {
    local name twin unwind nested often covers claim
    IFS=$'\t' read -r name twin unwind nested often covers claim <<< "$1"
    local claimed=Z_vfZ_claim.assertion.1 property
    local proof="$work/$name.log" verdict=proved refuted=no reached=0 wanted=0 outcome=ok cover failures
    compile "$name" "$twin"
    solve "$name" "$name" "$unwind" "$nested"
    if [[ $loops ]]; then
        grep -q '^VERIFICATION SUCCESSFUL' "$proof" || { verdict="too low, or no answer" && outcome=FAILED; }
        printf '| %s | %s | %s | %s | %s |\n' "$name" "$unwind" "$verdict" "$(tail -1 "$work/$name.seconds")" "$outcome"
        return
    fi
    failures=$(grep ': FAILURE$' "$proof" | grep -vc '\] line [0-9]* cover: ' || true)
    for property in wasm_rt_trap.assertion.1 "$claimed"; do
        grep -q "^\[$property\] .*: SUCCESS\$" "$proof" || verdict="no answer"
    done
    grep -q '^VERIFICATION ' "$proof" || verdict="no answer"
    ((failures == 0)) || verdict=refuted
    while IFS= read -r cover; do
        wanted=$((wanted + 1))
        if grep -q "\] line [0-9]* cover: ${cover#*:}: FAILURE\$" "$proof"; then reached=$((reached + 1)); fi
    done < <(tr ';' '\n' <<< "$covers")
    # The claim that the twin breaks: a panic before it ends the path, and refutes nothing.
    solve "$name" "$twin" "$unwind" "$nested" --property "$claimed"
    grep -q "^\[$claimed\] .*: FAILURE\$" "$work/$twin.log" && refuted=yes
    # A function of which CBMC has no body returns anything: what is proved then is about another program.
    if grep -q 'no body for' "$proof" "$work/$twin.log"; then verdict="no body"; fi
    [[ $verdict == proved && $reached == "$wanted" && $wanted != 0 && $refuted == yes ]] || outcome=FAILED
    printf '| %s | %s | %s | %s of %s | %s | %s | %s | %s |\n' "$name" "$unwind" "$verdict" "$reached" "$wanted" \
        "$refuted" "$(tail -1 "$work/$name.seconds")" "$(tail -1 "$work/$twin.seconds")" "$outcome"
}
export -f compile solve check_one

pick() {
    case ${1:-$loops} in
        yes) awk -F'\t' '$5 != "kani" && ($1 ~ /^step_/ || $3 < 9)' "$work/list.tsv" ;;
        '') awk -F'\t' '$5 == "daily"' "$work/list.tsv" ;;
        --long) awk -F'\t' '$5 != "kani"' "$work/list.tsv" ;;
        *) for name in "$@"; do
            awk -F'\t' -v name="$name" '$1 == name { print; found = 1 } END { exit !found }' "$work/list.tsv" ||
                { echo "no harness is called $name" >&2; return 1; }
        done ;;
    esac
}

install_tools
list
pick "$@" > "$work/picked.tsv"
build
nested > nested.txt
slice
if [[ $loops ]]; then
    echo "| harness | unwind | bound | CPU seconds | |"
    echo "|---|---|---|---|---|"
else
    echo "| harness | unwind | proof | covers reached | twin refuted | CPU seconds | twin's | |"
    echo "|---|---|---|---|---|---|---|---|"
fi
tr '\n' '\0' < picked.tsv | xargs -0 -n1 -P"$(nproc)" bash -c 'check_one "$1"' check_one | tee "$work/table.md"
rows=$(grep -c '| ok |$' "$work/table.md" || true)
picked=$(wc -l < "$work/picked.tsv")
echo "$rows of $picked harnesses as they must be, in $SECONDS s"
[[ $rows == "$picked" && $picked != 0 ]]
