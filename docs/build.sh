#!/usr/bin/env bash
# Makes the book of this folder's texts, with pages of `stackless explain` in it: target/book/site/index.html. Links are checked.
# usage: docs/build.sh [STACKLESS]. Needs Python, and installs MkDocs with pip.
#
# Where BOOK_SOURCE is an address at which the repository's files can be read, what leads out of the book is linked to it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
stackless=$(realpath "${1:-${CARGO_TARGET_DIR:-target}/debug/stackless}")
book=target/book

rm -rf "$book"
mkdir -p "$book/pages/pictures"
python3 -m venv "$book/venv"
"$book/venv/bin/pip" install --quiet --disable-pip-version-check --no-deps --only-binary :all: -r .ci/book.txt
cp docs/*.md docs/*.png docs/book.css "$book/pages/"
cp benches/records/*.svg "$book/pages/pictures/"
"$book/venv/bin/mkdocs" build --config-file docs/mkdocs.yml
mkdir "$book/site/explain"

page() {
    "$stackless" explain "${@:2}" -o "$book/site/explain/$1.html" > /dev/null
}
page example
page hash --method hash-only
page d-3 --case spec/departures/D-3.json
page wide --method wide-record,wide-hashed

# Each page that a chapter shows is there.
grep -oh 'src="explain/[^"]*"' docs/*.md | sort -u | while IFS='"' read -r _ path _; do
    test -s "$book/site/$path" || { echo "$path: no such page" >&2; exit 1; }
done
echo "$book/site/index.html"
