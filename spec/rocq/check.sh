#!/usr/bin/env bash
# Checks all proofs from clean, and that what they rest on is what assumptions.txt says: nothing.
# With UPDATE=1 it writes assumptions.txt. It needs Rocq (Coq 8.16 or later); where it is missing, it installs Debian's package.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

if ! command -v coqc > /dev/null; then
    ../../.ci/apt coq
fi

fail() {
    echo "rocq: $*" >&2
    exit 1
}

# Nothing may be taken for granted, not even in a comment.
forbidden='Admitted|admit|Axioms?|Parameters?|Conjectures?|give_up|Unset Guard Checking|bypass_check'
without_proof() {
    grep -nwE "$forbidden" "$@"
}

# "Module.theorem CLAUSE..." of each statement whose comment names clauses.
statements() {
    awk '
        FNR == 1 { module = FILENAME; sub(/.*\//, "", module); sub(/\.v$/, "", module) }
        /^Module / { inner = $2; sub(/\.$/, "", inner); module = module "." inner }
        inner != "" && $0 == "End " inner "." { sub(/\.[^.]*$/, "", module); inner = "" }
        /^ *\(\*\*/ { clauses = ""; inside = 1 }
        inside {
            line = $0
            while (match(line, /\[[A-Z]+-[0-9]+(, [A-Z]+-[0-9]+)*\]/)) {
                clauses = clauses " " substr(line, RSTART, RLENGTH)
                line = substr(line, RSTART + RLENGTH)
            }
        }
        /\*\)/ { inside = 0; next }
        !inside && /^(Theorem|Lemma|Corollary|Example|Definition|Fixpoint|Record|Inductive|Section|End) / {
            name = $2
            sub(/:$/, "", name)
            if (clauses != "" && /^(Theorem|Lemma|Corollary|Example) /) print module "." name clauses
            clauses = ""
        }
    ' "$@"
}

# compile FOLDER FILE...: in order, with the time that each takes.
compile() {
    local folder=$1 file
    shift
    for file in "$@"; do
        local begin=${EPOCHREALTIME/./}
        (cd "$folder" && coqc -q -R . Stackless "$file") || fail "$file is not proved"
        echo "$file $(((${EPOCHREALTIME/./} - begin) / 1000)) ms"
    done
}

# assumptions FOLDER FILE...: "Module.theorem CLAUSE...: what it rests on".
assumptions() {
    local folder=$1
    shift
    (
        cd "$folder"
        local name clauses
        {
            echo "From Stackless Require $(sed 's/\.v$//' <(printf '%s\n' "$@") | tr '\n' ' ')."
            while read -r name clauses; do
                echo "Goal True. idtac \"$name $clauses:\". Abort. Print Assumptions $name."
            done < <(statements "$@")
        } > All.v
        # A theorem and the answer on one line.
        coqc -q -R . Stackless All.v | awk '
            /^[A-Z][A-Za-z0-9.]*\.[a-z].*:$/ { if (line) print line; line = $0; next }
            { line = line " " $0 }
            END { print line }
        '
    )
}

mapfile -t files < <(grep '\.v$' _CoqProject)
[[ $(printf './%s\n' "${files[@]}" | sort) == "$(printf '%s\n' ./*.v | sort)" ]] \
    || fail "_CoqProject does not name the files that are here"
! without_proof "${files[@]}" || fail "something is left without a proof"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "${files[@]}" "$work"
compile "$work" "${files[@]}"
assumptions "$work" "${files[@]}" > "$work/found.txt"
if [[ -n ${UPDATE:-} ]]; then cp "$work/found.txt" assumptions.txt; fi
cat "$work/found.txt"
diff assumptions.txt "$work/found.txt" || fail "assumptions.txt says otherwise"
! grep -v ': Closed under the global context$' assumptions.txt || fail "these rest on something"
while read -r name _; do
    grep -qF "\`$name\`" README.md || fail "README.md does not name $name"
done < assumptions.txt

# The check bites: without the proof of one theorem both the words and the assumptions give it away.
theorem=fcomp_is_xor
awk -v theorem="$theorem" '
    $1 == "Theorem" && $2 == theorem { print; skip = 1; next }
    skip { if (/Qed\.$/) { print "Admitted."; skip = 0 } next }
    { print }
' Bits.v > "$work/Bits.v"
! cmp -s Bits.v "$work/Bits.v" || fail "nothing was planted"
without_proof "$work/Bits.v" > /dev/null || fail "a missing proof is not seen in the text"
compile "$work" Bits.v > /dev/null
assumptions "$work" Bits.v > "$work/planted.txt"
grep -q "^Bits\.$theorem .*: Axioms: .*$theorem" "$work/planted.txt" || fail "a missing proof is not seen in the assumptions"
echo "rocq: $(wc -l < assumptions.txt) theorems name clauses, none rests on anything; one without its proof is refused"
