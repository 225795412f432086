#!/usr/bin/env bash
# Smaller constants and weaker conditions are not proved. Usage: refuted.sh FOLDER, where the library of arithmetic is compiled, with that of
# traversal beside it. A change is planted in a copy of a file, and the statement that is named with it must fail, in its proof. One
# process does all, so that the real numbers and Flocq are loaded once, and the statements before the named one are taken for
# granted. So what is refused is that statement's proof; without the change it is proved in the same way.
set -euo pipefail
compiled=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/exact"
copies=$(mktemp -d)
trap 'rm -rf "$copies"' EXIT

fail() {
    echo "refuted: $*" >&2
    exit 1
}

# up_to FILE THEOREM...: the file up to the end of the last of these proofs. Other proofs before are left out, but in sections that are
# over: on these depends what a statement is outside of its section. Where a theorem is missing it is the whole file.
up_to() {
    awk -v targets="${*:2}" '
        BEGIN { missing = split(targets, list, " "); for (i in list) is_target[list[i]] }
        NR == FNR {
            if ($1 == "Section") open[++depth] = FNR
            if ($1 == "End" && depth) over[open[depth--]] = FNR
            if (named($0) in is_target) { wanted = FNR; missing-- }
            last = FNR
            next
        }
        FNR == 1 && missing { wanted = last + 1 }
        FNR in over && over[FNR] < wanted && over[FNR] > whole { whole = over[FNR] }
        /^(Theorem|Lemma|Corollary) / { name = named($0) }
        /^(Let|Example|Local|Instance|Definition|Fixpoint|Program) / { name = "" }
        /^Proof/ && name != "" && !(name in is_target) && FNR > whole { print "Proof. Admitted."; inside = 1 }
        inside { if (/Qed\.$/) inside = 0; next }
        name in is_target && sub(/^Proof\./, "Proof. idtac \"begun\".") { name = "" }
        { print }
        FNR >= wanted && /Qed\.$/ { exit }
        function named(line,    word) { split(line, word, " "); return line ~ /^(Theorem|Lemma|Corollary) / ? word[2] : "" }
    ' "$1" "$1"
}

# planted PATTERN THEOREMS FILE...: what is loaded. The theorems are in the last file; those before it are changed too, and are modules.
planted() {
    local pattern=$1 theorems=$2 file module modules=()
    shift 2
    for file in "$@"; do
        # What is changed stands for what is compiled.
        sed "$pattern" "$file" > "$copies/$file"
        for module in "${modules[@]}"; do
            sed -i "/^Require Import/s/ StacklessExact\.$module\b//; /^Require Import\.\$/d; s/^Open Scope R_scope\.\$/Import $module.\n&/" "$copies/$file"
        done
        module=${file%.v}
        modules+=("$module")
        if [[ $file == "${!#}" ]]; then
            # shellcheck disable=SC2086 # a list of words
            up_to "$copies/$file" $theorems
        else
            printf 'Module %s.\n' "$module"
            cat "$copies/$file"
            printf 'End %s.\n' "$module"
        fi
    done
    # What fails leaves nothing behind.
    echo 'Goal True. idtac "proved". fail.'
}

changes=() wheres=() wanted=()
declare -A theorems
try() {
    planted "$@" > "$copies/change${#changes[@]}.v"
    changes+=("$1") wheres+=("${!#}, $2")
}
refuted() {
    ! cmp -s <(sed "$1" "$3") "$3" || fail "nothing was planted by $1"
    wanted+=('in the proof')
    try "$@"
    theorems[${*:3}]+=" $2"
}

refuted 's/det_times := 40/det_times := 30/' not_beyond Lanes.v
refuted 's/ t_times := 44/ t_times := 34/' not_beyond Lanes.v
refuted 's/det_times := 40/det_times := 34/; s/ t_times := 44/ t_times := 38/' not_beyond Lanes.v
refuted 's/radix2 (-40)/radix2 (-60)/' twice Lanes.v
refuted 's/best) < R32/best) <= R32/' beyond_is_right Lanes.v
refuted 's/det_times := 32/det_times := 30/' bounds_are_enough Band.v
refuted 's/t_times := 36/t_times := 34/' bounds_are_enough Band.v
refuted 's/16 \* u/8 * u/g; s/15 \* u/7 * u/; s/17 \* u/9 * u/' end_is_below Band.v
refuted 's/certain : det_off < below/certain : 0 < below/' bottom_pos Band.v
refuted 's/if Rlt_bool (high i) best_low/if Rlt_bool (low i) best_low/' step_is_right BandOrder.v
refuted 's/nearest t <= value best -> met/nearest t < value best -> met/' not_skipped Answer.v
refuted 's/accept i best = best -> step/True -> step/' step_keeps Answer.v
refuted 's/match compare (snd a) (snd b) with .* end/(snd a <? snd b)%N/' is_less_is_exact Answer.v
refuted 's/Eq => (snd a <? snd b)%N/Eq => false/' is_less_is_exact Answer.v
refuted 's/compare i j = Rcompare (exact_t i) (exact_t j)\./compare i j = Rcompare (value f) (value g)./' is_less_is_exact Answer.v
refuted 's/(snd l <? least)%N/(snd l <=? least)%N/' settled_is Settled.v
refuted 's/Rlt_bool (fst l) near/Rle_bool (fst l) near/' settled_is Settled.v
refuted 's/(mul (exact p) (exact dy))/(mul (exact dy) (exact dy))/' less_stands FineNear.v
refuted 's/vz o + x \* vz d/vz o + x * vy d/' any_point_serves FineNear.v
refuted 's/- u \* vx e1/- u * vx e2/' residual_corrects Corrected.v
refuted 's/if wanted i then kernel i else None/kernel i/' meet_accepts Filters.v
refuted 's/ahead = \[\] \\\/ best <> None/True/' any_accepted Filters.v
refuted 's/edge a b = 0 ->/0 = 0 ->/' same_edge Order.v
refuted 's/is_through p ->/0 = 0 ->/' same_corner Order.v
refuted 's/then CompOpp c else c/then c else c/' crosswise Order.v
refuted 's/then Rcompare 0 apart/then Rcompare apart 0/' compare_quotient_is_right Order.v
refuted 's/succ (succ i)/succ i/' two_up Planes.v
refuted 's/steps = 2%nat/steps = 1%nat/' moved_reciprocal Slabs.v
refuted 's/78 \*/39 */g' sigma_is_enough Filter.v
refuted 's/(4 \* unit)/(2 * unit)/; s/(4 \* u)/(2 * u)/g' enclosure_positive Filter.v Quotient.v
refuted 's/31 \* unit/15 * unit/' error_det_is_enough Filter.v Quotient.v
refuted 's/35 \* unit/17 * unit/' error_t_is_enough Filter.v Quotient.v
refuted 's/39 \* u/38 * u/g; s/edge_times := 39/edge_times := 38/' delta_from_below Floor.v
refuted 's/2 ^ 24 - 3/2 ^ 24 - 2/; s/1 - 3 \* u/1 - 2 * u/g' factors TwoSided.v
refuted 's/2 ^ 24 + 4/2 ^ 24 + 2/; s/1 + 4 \* u/1 + 2 * u/g' factors TwoSided.v
refuted 's/134217729/67108865/g' dekker Expansion.v
refuted 's/(63 - shift)/(62 - shift)/' over_is_quotient Accumulator.v
refuted 's/(sum, first || second)/(sum, second)/' step_is_right Accumulator.v
refuted 's/radix2 (-200)/radix2 (-280)/' usual_multiple Usual.v
refuted 's/(fmax (fx v) (fx w))/(fx v)/' scene_has_bounds Scene.v
refuted 's/ + 5 <= 53/ + 4 <= 53/' nothing_is_rounded Coarse.v
refuted 's/off + 3 <= 53/off + 2 <= 53/' nothing_is_rounded Coarse.v
refuted 's/2 \* edges + 3 <= 53/2 * edges + 2 <= 53/' det_exact Coarse.v
refuted 's/Z.shiftl 1 51/Z.shiftl 1 50/' shift_is LastDigit.v
refuted 's/E - 50 + /E - 49 + /' units_divide LastDigit.v
refuted 's/then Bsucc (o_most a) else/then o_most a else/' narrow_keeps FramedSlabs.v
refuted 's/pred (pred (pred/pred (pred (/g; s/Nat.iter 3 Bpred/Nat.iter 2 Bpred/' near_plane FramedSlabs.v
refuted 's/- bpow radix2 (-149)) + start/- bpow radix2 (-151)) + start/' reported_near FramedEnds.v
refuted 's/1 + bpow radix2 (-52)/1 + bpow radix2 (-54)/g' end_is_not_before FramedEnds.v
refuted 's/(start + pred near)/(start + near)/' entrance_near FramedEnds.v
refuted 's/12 \*/7 */g' within_is_enough Off.v
refuted 's/(6 \*/(4 */g; s/6 \* v \*/4 * v */g; s/6 \* w \*/4 * w */g' within_det_is_enough Off.v
refuted 's/9 \/ 2/7 \/ 2/g; s/9 \* (E \* v \* C)/7 * (E * v * C)/; s/81 \/ (78/63 \/ (78/' within_covers LanesOff.v
refuted 's/9 \/ (39/7 \/ (39/g; s/9 \* (E \* w \* D)/7 * (E * w * D)/; s/81 \/ (78/63 \/ (78/' within_covers LanesOff.v
refuted 's/9 \/ 2/7 \/ 2/g' not_beyond_within LanesOff.v
refuted 's/then sum else pred sum/then sum else sum/' add_below_is Intervals.v
refuted 's/radix2 (-102)/radix2 (-105)/; s/(-102)%Z with (4 +/(-105)%Z with (1 +/; s/16 \* (u \* u)/2 * (u * u)/; s/(16 \* (u/(2 * (u/; s/16 \* (u \* (u/2 * (u * (u/g' add_off_rounded Fine.v FineSums.v
refuted 's/radix2 (-48)/radix2 (-52)/; s/(-48)%Z with (5 +/(-52)%Z with (1 +/; s/radix2 5) with 32/radix2 1) with 2/; s/32 \* u/2 * u/g' up_much Fine.v
refuted 's/radix2 (-1060)/radix2 (-1073)/; s/(-1060)%Z with (14 +/(-1073)%Z with (1 +/; s/16384 \* eta/2 * eta/' radius_enough Fine.v FineSums.v FineProducts.v
refuted 's/radix2 (-900)/radix2 (-1070)/; s/radix2 (-901)/radix2 (-1071)/' mul_stands Fine.v FineSums.v FineProducts.v
refuted 's/(R64 (R64 (Rabs (low x) + radius x) \* UP))/(R64 (Rabs (low x) + radius x))/' sign_is_right Fine.v FineSums.v
refuted 's/andb (Req_bool lost 0) (Req_bool least 0)/andb (Req_bool lost 0) (Req_bool lost 0)/' add_stands Fine.v FineSums.v
refuted 's/radix2 (-52)/radix2 (-54)/; s/(-52)%Z with (1 +/(-54)%Z with (-1 +/; s/EPSILON = 2 \* u/EPSILON = \/ 2 * u/' radius_of_quotient FineQuotients.v
refuted 's/ \/ least) + R64 (Rabs step \* EPSILON)) in/ \/ high y) + R64 (Rabs step * EPSILON)) in/' over_positive_stands FineQuotients.v
refuted 's/if Rlt_bool reach (radius x) then radius x else reach/if Rlt_bool reach (radius x) then reach else radius x/' hull_stands FineQuotients.v
refuted 's/R64 (high x \/ 8)/R64 (high x \/ 1)/g' root_stands FineRoots.v
refuted 's/R64 (4 \* r)/R64 (16 * r)/g; s/(4 \* r)/(16 * r)/g; s/radix2 2) with 4/radix2 4) with 16/; s/r \* bpow radix2 2/r * bpow radix2 4/; s/= 4 \* r/= 16 * r/' root_stands FineRoots.v
refuted 's/if Rlt_bool below 0 then Intervals.pred lo else lo/lo/g' between_single_is_right FineDeterminants.v
refuted 's/(1 - 8 \* u)/(1 - 5 * u)/g' near_is_below NearDistance.v
refuted 's/(1 + 8 \* u)/(1 + 4 * u)/g' placed_is_below_far NearDistance.v NearGuess.v
refuted 's/128 \* u/96 * u/g' margin_is PartNumbers.v
refuted 's/is_new l e -> 0 <= value/is_new l e -> -1 <= value/' cut_keeps Parts.v
refuted 's/corner_b : 0 <= d3 -> /corner_b : -1 <= d3 -> /' certified_is_nearest Nearest.v
refuted 's/0 < B2R (d_least a) .. B2R (d_most a) < 0/0 < B2R (d_most a) \\\/ B2R (d_least a) < 0/' narrow_keeps EnclosedBoxes.v
refuted 's/balanced m l -> (m | sum g l)/0 = 0 -> (m | sum g l)/' adds_up Chains.v
refuted 's/no_end x l -> (k |/0 = 0 -> (k |/' balanced_iff_covered Closed.v
refuted 's/Z.odd (faces s)) (shares l)/Z.even (faces s)) (shares l)/' is_closed_is_right Closed.v
refuted 's/(- net s, net s)%Z) (one_sided/(net s, net s)%Z) (one_sided/' is_oriented_is_right Closed.v
refuted 's/scale (-1) v/scale 1 v/' triangle_is_fan Fans.v
refuted 's/off_edges x a b c -> off_edges e/0 = 0 -> off_edges e/' triangle_is_fan Fans.v
refuted 's/(k \* sign (vol x f p) =? 1)/(k * sign (vol x f p) =? -1)/' fan_along Fans.v
refuted 's/~ (exists u v, 0 <= u/~ (exists u v, 1 <= u/' plane_is_no_fan Fans.v
refuted 's/ \\\/ touches o (Vec 0 0 1) t\././' is_on_is_right Inside.v
refuted 's/Rle_bool 0 (top_t x \/ det x)\./Rle_bool (top_t x \/ det x) 0./' crossing_is_cover Inside.v
refuted 's/~ contains t o -> small/0 = 0 -> small/' crossing_is_cover Inside.v
refuted 's/balanced k (edges l) -> (forall t/0 = 0 -> (forall t/' rays_agree InsideRays.v
refuted 's/dot3 w (less p o) < 0\./dot3 w (less p o) <= 0./' beyond_is_missed InsidePaths.v
refuted 's/negb (Rle_bool 1 (top_t/negb (Rle_bool 2 (top_t/' next_crossing InsidePaths.v
refuted 's/0 <= s <= 1 -> ~ contains/0 < s < 1 -> ~ contains/' path_keeps InsidePaths.v
refuted 's/net s \* fan o x e (line s)) (one_sided (edges l)))%Z\./fan o x e (line s)) (one_sided (edges l)))%Z./' covers_are_crossings_and_border Winding.v
refuted 's/sub (inside (lo a)) point/sub (inside (hi a)) point/' step_stands FineAfar.v
refuted 's/R64 (R64 (radius x \* bpow radix2 e) + UNDERFLOW)/R64 (radius x * bpow radix2 e)/' times_two_to_stands FineAfar.v
refuted 's/point a <= low_end a/low_end a <= point a/' way_is_least FineAfar.v
refuted 's/(fst x) (fst y) then x else/(fst x) (fst y) then y else/' lesser_is FineAfar.v
refuted 's/else CompOpp turn/else turn/' slope_is LineOrder.v
refuted 's/| a, b => compare_bool b a$/| a, b => compare_bool a b/' order_compares_places LineOrder.v
refuted 's/a <> zero -> b <> zero -> order_of_lines/0 = 0 -> 0 = 0 -> order_of_lines/' equal_is_parallel LineOrder.v
refuted 's/dot3 v w + dot3 w u/dot3 v w - dot3 w u/' real_part Angles.v
refuted 's/exists r, 0 < r \/\\/exists r, 0 <> r \/\\/' angles_add_up Angles.v

# Without the changes all of them are proved, in the same way.
for files in "${!theorems[@]}"; do
    wanted+=(proved)
    # shellcheck disable=SC2086 # a list of words
    try '' "$(tr ' ' '\n' <<< "${theorems[$files]}" | sort -u | xargs)" $files
done

# What the files rest on is loaded once.
{
    printf '%s\n' "${wheres[@]}" | sort -u | sed 's/\.v, .*//; s/.*/Require StacklessExact.&./' | sort -u
    for number in "${!changes[@]}"; do
        printf 'Goal True. idtac "= %s". Abort.\nLoad "%s/change%s".\n' "$number" "$copies" "$number"
    done
    echo 'Goal True. idtac "= end". Abort.'
} > "$copies/all.v"
(cd "$copies" && coqtop -q -w none -R "$compiled" StacklessExact -R "$compiled/../Stackless" Stackless < all.v > said.txt 2>&1)

# Of each, how far it came.
awk '
    /(^|[^0-9a-z])= ([0-9]+|end)$/ { if (seen) print number, far; number = $NF; far = "before the proof"; seen = 1 }
    /(^|[^a-z])begun$/ { far = "in the proof" }
    /(^|[^a-z])proved$/ { far = "proved" }
' "$copies/said.txt" > "$copies/far.txt"
[[ $(wc -l < "$copies/far.txt") == "${#changes[@]}" ]] || fail "not all were tried: $(tail -5 "$copies/said.txt")"
while read -r number far; do
    what="${changes[number]:-no change}: ${wheres[number]}"
    [[ $far == "${wanted[number]}" ]] || fail "$far, and not ${wanted[number]}: $what
$(grep -A9 "= $number\$" "$copies/said.txt")"
    [[ $far == proved ]] || echo "refused with $what"
done < "$copies/far.txt"
echo "refuted: $((${#changes[@]} - ${#theorems[@]})) changes; without them, the statements of ${#theorems[@]} files are proved in the same way"
