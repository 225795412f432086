#!/usr/bin/env bash
# The page that traces in the browser, in Chromium and from a file: what it shows is what the native library answers, bit for
# bit, on a wide window and on one of 400 pixels (test.js). Pages with a mistake each must fail. usage: check.sh PAGE ANSWERS
#
# 77 where there is no Chromium and none can be installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
page=$1 answers=$2

browser=$(.ci/chromium)

folder=$(mktemp -d)
chromium=
trap '[[ -z $chromium ]] || { kill "$chromium" || true; wait "$chromium" || true; } 2> /dev/null; rm -rf "$folder"' EXIT
"$answers" corners torus examples/data/room.obj > "$folder/answers.json"

# What a page has before it begins: where faults are kept, the answers, and a mesh as text.
{
    echo '<script>window.faults = []; console.error = (...all) => faults.push(all.join(" ")); addEventListener("error", (e) => faults.push(e.message), true); addEventListener("unhandledrejection", (e) => faults.push(String(e.reason))); addEventListener("securitypolicyviolation", (e) => faults.push(e.blockedURI))'
    echo "window.answers = $(< "$folder/answers.json")"
    echo 'window.room = [String.raw`'
    cat examples/data/room.obj
    echo '`]</script>'
} > "$folder/before"
{ echo '<script type="module">'; cat tests/web/test.js; echo '</script>'; } > "$folder/after"

# One after the other, since they all compute. Frames may be narrower than a window can be.
cat > "$folder/frames.html" <<'END'
<!doctype html><script>
const pages = PAGES;
function next() {
  document.querySelector("iframe")?.remove();
  const [name, width] = pages.shift() ?? [];
  if (!name) return console.log("result of all pages");
  const frame = Object.assign(document.createElement("iframe"), { name, src: `${name}.html`, width, height: 800 });
  document.documentElement.append(frame);
}
addEventListener("message", (event) => { console.log(`result of ${event.data}`); next(); });
next();
</script>
END
names=() pages=

# frame NAME WIDTH [SED]: the page with the test in it, and perhaps a mistake.
frame() {
    sed -e "${3-}" "$page" > "$folder/changed.html"
    if [[ -n ${3-} ]] && cmp -s "$folder/changed.html" "$page"; then
        echo "$1: there is nothing to be mistaken" >&2
        exit 1
    fi
    sed -e "/^<head>\$/r $folder/before" -e "/^<\/body>\$/{
r $folder/after
N
}" "$folder/changed.html" > "$folder/$1.html"
    names+=("$1")
    pages+="[\"$1\", $2],"
}
frame wide 1200
frame narrow 400
frame bad-pictures-swapped 1200 's/const pictures = \[\$("exact"), \$("inexact")\]/const pictures = [$("inexact"), $("exact")]/'
frame bad-upside-down 1200 's/new ImageData(colours, side), 0, first)/new ImageData(colours, side), 0, side - count - first)/'
frame bad-a-mark-is-missing 1200 's/difference \&\& wrong.push(/difference > 1 \&\& wrong.push(/'
frame bad-ghosts-for-lost 1200 's/"hits", "lost", "ghosts", "other"\]) \$(id).textContent = number/"hits", "ghosts", "lost", "other"]) $(id).textContent = number/;s/= number(totals\[id\])/= number(totals[{ lost: "ghosts", ghosts: "lost" }[id] ?? id])/'
frame bad-columns-for-rows 1200 's/worker.postMessage(\["pixel", x, y\])/worker.postMessage(["pixel", y, x])/'
frame bad-no-steps 1200 's/\$("steps").srcdoc = html;/$("steps").srcdoc = "";/'
frame bad-silent 1200 's/if (data.error) fail(data.error);/if (data.error) rest("");/'
frame bad-file-is-not-read 1200 's/document.addEventListener("drop", .*$/document.addEventListener("drop", (event) => event.preventDefault());/'
frame bad-without-limit 1200 's/if (file.size > about.most_bytes) {/if (file.size > Infinity) {/'
frame bad-another-answer 1200 's/library.rows(first, count);/library.rows(first \&\& first - 1, count);/'
frame bad-image-from-elsewhere 400 's|^<main>|<img src="http://localhost/a.png" alt=""><main>|'
frame bad-too-wide 400 's/grid-template-columns: minmax(0, 1fr) } }/grid-template-columns: 300px 300px } }/'
sed -i "s/PAGES/[$pages]/" "$folder/frames.html"

: > "$folder/log"
"$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$folder/profile" --window-size=1280,900 --enable-logging=stderr \
    "file://$folder/frames.html" > "$folder/log" 2>&1 &
chromium=$!
for ((left = 300; left; left--)); do
    ! grep -aq 'result of all pages' "$folder/log" || break
    kill -0 "$chromium" 2> /dev/null || break
    sleep 1
done

failed=0
for name in "${names[@]}"; do
    line=$(sed -n "s/.*\(result of $name: .*\)\", source: .*/\1/p" "$folder/log")
    line=${line:-result of $name: no answer}
    wanted=passed
    [[ $name == bad-* ]] && wanted=failed
    [[ $line == "result of $name: $wanted"* ]] || { failed=1; echo -n "NOT $wanted: "; }
    echo "${line#result of }"
done
exit $failed
