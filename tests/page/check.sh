#!/usr/bin/env bash
# The pages of `stackless explain` in Chromium: every visit of every traversal, forwards and backwards, on a wide window and on one
# of 360 pixels (test.js). Pages with a mistake each must fail. `lab` is beside it.
# usage: check.sh [STACKLESS]
#
# 77 where there is no Chromium and none can be installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
stackless=${1:-${CARGO_TARGET_DIR:-target}/debug/stackless}
lab=$(dirname "$stackless")/lab

browser=$(.ci/chromium)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Frames may be narrower than a window can be.
frames=$folder/frames.html
printf '<!doctype html><pre id="results"></pre><script>addEventListener("message", (e) => results.append(e.data + "\\n"))</script>\n' > "$frames"
names=()

# frame NAME WIDTH PAGE: the page with the test in it.
frame() {
    local faults='<script>window.faults = []; console.error = (...all) => faults.push(all.join(" ")); addEventListener("error", (e) => faults.push(e.message), true); addEventListener("securitypolicyviolation", (e) => faults.push(e.blockedURI))<\/script>'
    sed -e "s|^<head>\$|&$faults|" -e "s|^</body>\$|<script>TEST</script>\n&|" "$3" |
        sed -e '/^<script>TEST<\/script>$/{s/.*/<script type="module">/;r tests/page/test.js
a </script>
}' > "$folder/$1.html"
    echo "<iframe name=\"$1\" width=\"$2\" height=\"800\" src=\"$1.html\"></iframe>" >> "$frames"
    names+=("$1")
}

page() {
    "$lab" explain "${@:2}" -o "$folder/page-$1.html" > /dev/null
}

page example
page leaf --tape 7
page tape --tape 34
page pruned --tape 2 --method hashed-disjoint,uncle-disjoint,sparse-disjoint,afra-disjoint,stack-disjoint,stack-t0
page others --method left-first,implicit-a1,implicit-b,implicit-b1,laine-0,laine-2,laine-4,laine-8,skip,skip-octant,glassner
page deep --suite-case trace/script/chain-turns-64-two-1 --method hashed,sparse
page ray stadium --pixel 256,220
all_wide=wide-record,wide-stack,wide-trail,wide-hashed,wide-restart-0,wide-restart-1,wide-restart-2,wide-restart-4,wide-restart-8
page wide --method "$all_wide"
page wide2 --wide 2 --tape 8 --method "$all_wide"
page wide4 --wide 4 --tape 3
page leaves-first --wide 8 --tape 5
page wide-ray stadium --pixel 256,220 --method wide-record,wide-hashed,wide-trail
# Trees that are too large to be read as a whole. Even: the children of i are 2i + 1 and 2i + 2. Leaning: every eighth
# node leads on to the next eighth one, and to a bush of seven nodes.
tree() {
    awk -v n="$2" -v shape="$1" '
        function pair(left, right) { return left < n && right < n ? "[" left ", " right "]" : "null" }
        function children(i, k) {
            if (shape == "even") return pair(2 * i + 1, 2 * i + 2)
            k = i % 8
            return k == 0 ? pair(i + 8, i + 1) : k < 4 ? pair(i + k, i + k + 1) : "null"
        }
        BEGIN {
            for (i = 0; i < n; i++) {
                all = all (i ? ", " : "") children(i)
                cells = cells (i ? ", " : "") "{\"right_first\": " (i % 3 == 1 ? "true" : "false") ", \"miss\": " (i % 7 == 5 ? "true" : "false") "}"
            }
            print "{\"children\": [" all "], \"cells\": [" cells "]}"
        }' > "$folder/tree-$1.json"
    page "$1" --case "$folder/tree-$1.json" --method hashed
}
tree even 255
tree leaning 161
for width in 1200 400 360; do
    for name in example leaf tape pruned others deep ray wide wide2 wide4 leaves-first wide-ray even leaning; do
        # At 400 only what has to fit; the rest is the same as at 360.
        [[ $width != 400 || $name == even || $name == leaning ]] || continue
        frame "$name-$width" "$width" "$folder/page-$name.html"
    done
done

# mistake NAME WIDTH SED: the example or, where the name begins so, another page.
mistakes=()
mistake() {
    local from=$folder/page-example.html
    [[ $1 == deep-* ]] && from=$folder/page-deep.html
    [[ $1 == wide-* ]] && from=$folder/page-wide.html
    [[ $1 == big-* ]] && from=$folder/page-even.html
    sed -e "$3" "$from" > "$folder/bad.html"
    ! cmp -s "$folder/bad.html" "$from" || { echo "$1: there is nothing to be mistaken" >&2; exit 1; }
    frame "bad-$1" "$2" "$folder/bad.html"
    mistakes+=("bad-$1")
}
mistake trail-to-the-left 1200 's/bits.padStart(depth/bits.padEnd(depth/'
mistake left-is-right 1200 's/ArrowLeft: () => go(at - 1)/ArrowLeft: () => go(at + 1)/'
mistake stack-upside-down 1200 's/name(node))).reverse()/name(node)))/'
mistake one-level-more 1200 's/up < back ? "gone"/up <= back ? "gone"/'
mistake node-for-sibling 1200 's/child !== node/child === node/'
mistake bucket-for-cell 1200 's/lookup?.cell)/lookup?.bucket)/'
mistake link-off-by-one 1200 's/, 10) - 1 ||/, 10) ||/'
mistake done-too-late 1200 's/seen\[node\] < at/seen[node] < at - 1/'
mistake other-trail 1200 's/"trail":"1001"/"trail":"1011"/'
mistake image-from-elsewhere 1200 's|^<main>|<img src="http://localhost/a.png" alt=""><main>|'
mistake link-of-another-step 1200 's/&step=${at + 1}`), 250/\&step=${at}`), 250/'
mistake error-on-the-way 1200 's/^function showTree(step, way) {/&if (at === 3) console.error("oh");/'
mistake wide-slots-reversed 1200 's/group\[length - 1 - slot\]/group[slot]/'
mistake wide-bits-for-slots 1200 's/"trailBits":8/"trailBits":4/'
mistake wide-key-by-the-bit 1200 's/cut(step.key, data.keyBits)/cut(step.key, 1)/'
mistake wide-depth-in-bits 1200 's/(key.length - 1) \/ data.keyBits \* HIGH/(key.length - 1) * HIGH/'
mistake wide-beyond-is-pending 1200 's/ \&\& !step.beyond?.includes(node) ? "wait"/ ? "wait"/'
mistake wide-beyond-comes-next 1200 's/step.stack.findLast((node) => !isBeyond(node))/step.stack.at(-1)/'
mistake wide-row-of-another-level 1200 's/\["", ...cells\]/[...cells, ""]/'
mistake wide-other-set 1200 's/"sets":"00011011"/"sets":"00011010"/'
mistake wide-one-level-more 1200 's/up < back ? "gone"/up <= back ? "gone"/'
mistake big-does-not-fit 1200 's/Math.min(wide, 1), Math.min(high, 1)\]/Math.min(2 * wide, 1), Math.min(high, 1)]/'
mistake big-does-not-fit-a-phone 400 's/^  const \[wide, high\] = \[(room()\[0\]/  const [wide, high] = [(600/'
mistake big-node-out-of-view 1200 's/if (low - EDGE < view/if (false) if (low - EDGE < view/'
mistake big-next-out-of-view 400 's/, \.\.\.waits.slice(-1), /, /;s/back ? \[next\] : \[\]/[]/'
mistake big-cannot-be-read 1200 's/shown.has(node) ? "" : " mute"/false ? "" : " mute"/'
mistake big-never-large-again 1200 's/Math.max(1, Math.min(wanted, \.\.\.most))/wanted = Math.max(1, Math.min(wanted, ...most))/'
mistake zoom-without-keys 1200 's/"+": () => enlarge(1.5)/"+": () => 0/'
mistake zoom-without-wheel 1200 's/if (!event.ctrlKey) return;/return;/'
mistake zoom-button-the-other-way 1200 's/\["smaller", () => enlarge(1 \/ 1.5)\]/["smaller", () => enlarge(1.5)]/'
mistake clause-of-another 1200 's/`${id}: ${clause.title}`/`${id}: x`/'
mistake clause-is-dead 1200 's/^    showClause(id);//'
mistake clause-without-address 1200 's/link.has("clause")/false/'
mistake deep-too-wide 360 's/^\.scroll { overflow: auto }//'

timeout 900 "$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$folder/profile" --window-size=1280,900 \
    --virtual-time-budget=120000 --dump-dom "file://$frames" > "$folder/dom.html" 2> "$folder/log"

failed=0
for name in "${names[@]}"; do
    line=$(grep -o "^\(.*>\)\?$name: .*" "$folder/dom.html" | sed 's/.*>//' || echo "$name: no answer")
    wanted=passed
    [[ $name == bad-* ]] && wanted=failed
    [[ $line == "$name: $wanted"* ]] || { failed=1; echo -n "NOT $wanted: "; }
    echo "$line"
done
exit $failed
