#!/usr/bin/env bash
# Checks all proofs of both libraries from clean, and what they rest on: those of traversal on nothing, those of
# arithmetic (exact/) on the axioms of the real numbers of Coq's library, no others. No theorem rests on more than
# assumptions.txt says. That the theorems of arithmetic are about the code is Operations.v, printed from the source, and
# Agreement*.v. With UPDATE=1 it writes what is printed, and assumptions.txt from one theorem after the other, which
# takes minutes. With --bites it also sees that missing proofs, axioms, smaller constants and changed operations are refused,
# which takes as long again. It needs Rocq (Coq 8.16 or later) with Flocq 4; where one is missing, it installs Debian's packages.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

has_flocq() {
    coqtop -q -batch -rfrom Flocq Core > /dev/null 2>&1 < /dev/null
}
if ! command -v coqc > /dev/null || ! has_flocq; then
    ../../.ci/apt coq libcoq-flocq
fi
began=$SECONDS
bites=
[[ ${1:-} != --bites ]] || bites=yes

# A library: its folder, its name in Rocq, and the axioms that its theorems may rest on. The reals of Coq's library are Dedekind
# cuts, made with these; Flocq adds none. A library sees those that are compiled before it.
folders=(. exact)
declare -A names=([.]=Stackless [exact]=StacklessExact)
declare -A allowed=([.]='' [exact]='
    ClassicalDedekindReals.sig_forall_dec
    ClassicalDedekindReals.sig_not_dec
    Classical_Prop.classic
    FunctionalExtensionality.functional_extensionality_dep')

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

# loads NAME: what tells the compiler where a library is that is in the folder it is called in, and where the first one is.
loads() {
    printf -- '-R . %s' "$1"
    [[ $1 == "${names[.]}" ]] || printf -- ' -R ../%s %s' "${names[.]}" "${names[.]}"
}

# compile FOLDER NAME FILE...: in order, with the time that each takes.
compile() {
    local folder=$1 name=$2 file
    shift 2
    for file in "$@"; do
        local begin=${EPOCHREALTIME/./}
        # shellcheck disable=SC2046 # a list of words
        (cd "$folder" && coqc -q -w -variable-collision $(loads "$name") "$file") || fail "$file is not proved"
        echo "$file $(((${EPOCHREALTIME/./} - begin) / 1000)) ms"
    done
}

# assumptions FOLDER NAME FILE... < LINES: after each line, which has one theorem of the files or more, what they rest on together.
assumptions() {
    local folder=$1 library=$2
    shift 2
    (
        cd "$folder"
        local line count=0
        {
            echo "From $library Require $(sed 's/\.v$//' <(printf '%s\n' "$@") | tr '\n' ' ')."
            while read -r line; do
                count=$((count + 1))
                echo "Goal True. idtac \"= $line:\". Abort. Definition all$count : True :="
                grep -oE '\b[A-Z][A-Za-z0-9.]*\.[a-z][A-Za-z0-9_]*' <<< "$line" | sed 's/.*/let _ := @& in/'
                echo "I. Print Assumptions all$count."
            done
        } > All.v
        # The theorems and the answer on one line; of an axiom only the name, not the type.
        # shellcheck disable=SC2046 # a list of words
        coqc -q $(loads "$library") All.v | awk '
            /^= / { if (line) print line; line = substr($0, 3); next }
            /^Axioms:$|^Closed / { line = line " " $0; next }
            /^[^ ]/ { line = line " " $1 }
            END { print line }
        '
    )
}

# together LIST: a list of assumptions, with all theorems on one line that rest on the same.
together() {
    awk '
        { what = substr($0, index($0, ": ")); names[what] = names[what] " " $1 }
        END { for (what in names) print substr(names[what], 2) what }
    ' "$1" | sort
}

# rechecked FOLDER NAME FILE...: checks the compiled files again with Rocq's independent checker, and trusts the files that they load.
rechecked() {
    local folder=$1 name=$2 begin=$SECONDS
    shift 2
    # shellcheck disable=SC2046 # lists of words
    (cd "$folder" && coqchk -silent $(loads "$name") $(printf -- "-norec $name.%s " "${@%.v}")) || fail "coqchk refuses $name"
    echo "coqchk: $name in $((SECONDS - begin)) s"
}

# confirmed FOLDER NAME LIST: whether the theorems of a list rest on what it says. What is found is in found.txt. Rocq goes through
# all that a theorem is made of, each time, so all that are said to rest on the same are looked at together: seconds for minutes.
confirmed() {
    local folder=$1 library=$2
    together "$3" > "$folder/said.txt"
    # shellcheck disable=SC2046 # a list of words
    sed 's/: .*//' "$folder/said.txt" | assumptions "$folder" "$library" $(sed 's/\..*//' "$3" | uniq) > "$folder/found.txt"
    diff "$folder/said.txt" "$folder/found.txt"
}

# unwanted FOLDER FILE: the lines of a list of assumptions with an axiom that the library may not rest on.
unwanted() {
    awk -v list="${allowed[$1]}" '
        BEGIN { split(list, names); for (i in names) allowed[names[i]] }
        /: Closed under the global context$/ { next }
        {
            at = index($0, ": Axioms: ")
            count = split(substr($0, at + 10), found)
            bad = at == 0 || count == 0
            for (i = 1; i <= count; i++) if (!(found[i] in allowed)) bad = 1
            if (bad) print
        }
    ' "$2"
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check FOLDER: everything about one library.
check() {
    local here=$1 name=${names[$1]} there=$work/${names[$1]}
    local -a files
    mapfile -t files < <(grep '\.v$' "$here/_CoqProject")
    (
        cd "$here"
        [[ $(printf './%s\n' "${files[@]}" | sort) == "$(printf '%s\n' ./*.v | sort)" ]] \
            || fail "_CoqProject does not name the files that are here"
        ! without_proof "${files[@]}" || fail "something is left without a proof"
    )
    mkdir "$there"
    cp "${files[@]/#/$here/}" "$there"
    compile "$there" "$name" "${files[@]}"
    # Of the other library no time is known yet.
    [[ $here != . ]] || rechecked "$there" "$name" "${files[@]}"
    statements "${files[@]/#/$here/}" > "$there/theorems.txt"
    if [[ -n ${UPDATE:-} ]]; then
        assumptions "$there" "$name" "${files[@]}" < "$there/theorems.txt" > "$there/alone.txt"
        cp "$there/alone.txt" "$here/assumptions.txt"
    fi
    cat "$here/assumptions.txt"
    diff <(sed 's/: .*//' "$here/assumptions.txt") "$there/theorems.txt" || fail "$here/assumptions.txt is about other theorems"
    confirmed "$there" "$name" "$here/assumptions.txt" || fail "$here/assumptions.txt says otherwise"
    [[ -z $(unwanted "$here" "$there/found.txt") ]] || fail "these rest on what they may not: $(unwanted "$here" "$there/found.txt")"
    local theorem
    while read -r theorem _; do
        grep -qF "\`$theorem\`" "$here/README.md" || fail "$here/README.md does not name $theorem"
    done < "$here/assumptions.txt"
    report+=("$name: $(cat "${files[@]/#/$here/}" | grep -cE '^ *(Theorem|Lemma|Corollary|Example) ') statements," \
        "$(wc -l < "$here/assumptions.txt") name clauses; axioms: $(wc -w <<< "${allowed[$here]}")"$'\n')
}

# The operations of the proofs are those of the code: Operations.v is printed from the library's source. So that the
# reader's meanings are tested where it is used, its tests run here.
operations() {
    local manifest=../../proofs/operations/Cargo.toml target=${CARGO_TARGET_DIR:-$PWD/../../target}/operations
    local reader=$target/debug/operations
    cargo test --quiet --locked --manifest-path "$manifest" --target-dir "$target"
    cargo build --quiet --locked --manifest-path "$manifest" --target-dir "$target"
    "$reader" ../.. > "$work/Operations.v"
    if [[ -n ${UPDATE:-} ]]; then cp "$work/Operations.v" exact/Operations.v; fi
    diff exact/Operations.v "$work/Operations.v" || fail "the code has other operations than exact/Operations.v"
    if [[ $bites ]]; then ./planted.sh "$reader"; fi
    echo "operations: $(grep -c '^Definition' exact/Operations.v) definitions are printed; $((SECONDS - began)) s"
}
operations

report=()
for folder in "${folders[@]}"; do
    check "$folder"
done

printf ' %s' "${report[@]}" | sed 's/^ */rocq: /; s/ *$//' | grep .
[[ $bites ]] || exit 0

# seen FOLDER THEOREM FILE AXIOM: in the copy, the theorem of that file rests on what it may not.
seen() {
    local name=${names[$1]} theorem=$2 file=$3 axiom=$4
    grep "^${file%.v}\." "$1/assumptions.txt" > "$work/$name/planted.txt"
    ! confirmed "$work/$name" "$name" "$work/$name/planted.txt" > /dev/null || fail "that $theorem rests on $axiom is not seen"
    unwanted "$1" "$work/$name/found.txt" | grep -q "\.$theorem\b.*: Axioms: .*\b$axiom" || fail "$axiom is not named below $theorem"
}

# The check bites: without the proof of one theorem both the words and the assumptions give it away.
# without FOLDER THEOREM FILE: a copy of the compiled library, in which the file has "Admitted." for the proof.
without() {
    local name=${names[$1]} theorem=$2 file=$3
    awk -v theorem="$theorem" '
        $1 == "Theorem" && $2 == theorem { skip = 1 }
        skip && /^Proof/ { print "Proof. Admitted."; over = /Qed\.$/; inside = 1; if (over) skip = inside = 0; next }
        skip && inside { if (/Qed\.$/) skip = inside = 0; next }
        { print }
    ' "$1/$file" > "$work/$name/$file"
    ! cmp -s "$1/$file" "$work/$name/$file" || fail "nothing was planted"
    without_proof "$work/$name/$file" > /dev/null || fail "a missing proof is not seen in the text"
    compile "$work/$name" "$name" "$file" > /dev/null
    seen "$1" "$theorem" "$file" "$theorem"
    cp "$1/$file" "$work/$name/$file"
}
without . fcomp_is_xor Bits.v
without exact nested Planes.v

# Nor does an axiom pass that goes by another name: what is supposed outside of a section.
planted=$work/StacklessExact
awk '
    $0 == "Section Planes." { print "Hypothesis handy : forall x y : R, x <= y." }
    $1 == "Theorem" && $2 == "nested" { skip = 1 }
    skip && /^Proof/ { print "Proof. intros. apply handy. Qed."; inside = 1; next }
    skip && inside { if (/Qed\.$/) skip = inside = 0; next }
    { print }
' exact/Planes.v > "$planted/Planes.v"
! without_proof "$planted/Planes.v" > /dev/null || fail "the planted axiom has a word that is looked for"
(compile "$planted" StacklessExact Planes.v) > /dev/null 2>&1 || fail "the planted axiom proves nothing"
seen exact nested Planes.v handy
cp exact/Planes.v "$planted"

compile "$planted" StacklessExact Planes.v > /dev/null
./refuted.sh "$planted"
echo "rocq: missing proofs, a planted axiom, smaller constants and weaker conditions are refused; $((SECONDS - began)) s"
