#!/usr/bin/env python3
"""A page of who passes what, from reports of runs: dashboard.py REPORT.json... > page.html

REPORT.json is what `stackless conform --json` or `conform.py --json` writes. One row for each implementation, one
column for each profile that one of them names. A cell leads to the first case that failed.
"""

import html
import json
import pathlib
import sys

STYLE = """
:root { color-scheme: light dark; --pass: #d3f0d3; --fail: #f6cfcf; --part: #fbe9bd; --line: #8888; }
@media (prefers-color-scheme: dark) { :root { --pass: #1d4d24; --fail: #6a2323; --part: #5c4a12; } }
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 75rem; padding: 0 1rem; }
div { overflow-x: auto; }
table { border-collapse: collapse; }
th, td { border: 1px solid var(--line); padding: .3rem .6rem; text-align: right; white-space: nowrap; }
th:first-child { text-align: left; position: sticky; left: 0; background: Canvas; }
thead th { text-align: center; }
td.pass { background: var(--pass); } td.fail { background: var(--fail); } td.part { background: var(--part); }
td a { color: inherit; }
dt { font-weight: 600; margin-top: 1rem; } :target { outline: 3px solid; outline-offset: .3rem; }
code { overflow-wrap: anywhere; }
"""


def profile_of(case):
    return case["id"].rpartition("/")[0]


def is_bad(case):
    return case["outcome"] not in ("pass", "not-asked") and case["strength"] == "must"


def text(value):
    return html.escape(str(value))


def cell(cases, anchor):
    """A cell, and the failure that it leads to."""
    asked = [case for case in cases if case["outcome"] != "not-asked"]
    if not asked:
        return '<td title="not asked"></td>', None
    bad = [case for case in asked if is_bad(case)]
    if not bad:
        return f'<td class="pass" title="all pass">✓ {len(asked)}</td>', None
    passed = len(asked) - len(bad)
    kind = "part" if 2 * passed >= len(asked) else "fail"
    return f'<td class="{kind}"><a href="#{anchor}">✗ {passed} of {len(asked)}</a></td>', bad[0]


def failure(case, anchor, name, profile):
    clauses = ", ".join(case["clauses"])
    return (
        f'<dt id="{anchor}">{text(name)}, {text(profile)}</dt><dd><code>{text(case["id"])}</code>: {text(case["outcome"])}: '
        f"{text(case['what'])}<br>{text(case['why'])}<br>{text(clauses)}<br>"
        f"<code>stackless suite show --filter {text(case['id'])}</code></dd>"
    )


def page(reports):
    profiles = []
    for report in reports:
        for case in report["cases"]:
            if case["outcome"] != "not-asked" and profile_of(case) not in profiles:
                profiles.append(profile_of(case))
    rows, failures = [], []
    for i, report in enumerate(reports):
        implementation = report["implementation"]
        name = f"{implementation['name']} {implementation.get('version', '')}".strip()
        cells = []
        for profile in profiles:
            anchor = f"{i}-{profile.replace('/', '-')}"
            of = [case for case in report["cases"] if profile_of(case) == profile]
            data, first = cell(of, anchor)
            cells.append(data)
            if first:
                failures.append(failure(first, anchor, name, profile))
        rows.append(f"<tr><th>{text(name)}</th>{''.join(cells)}</tr>")
    versions = ", ".join(sorted({report["suite"] for report in reports}))
    heads = "".join(f"<th>{text(profile)}</th>" for profile in profiles)
    first = f"<h2>First failures</h2>\n<dl>{''.join(failures)}</dl>" if failures else ""
    rows = "\n".join(rows)
    return (
        f'<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n<meta name="viewport" content="width=device-width">\n'
        f"<title>Who passes what</title>\n<style>{STYLE}</style>\n<h1>Who passes what</h1>\n"
        f"<p>Cases that pass, by profile, of version {text(versions)} of the suite. An empty cell was not asked: its implementation does "
        f"not name the profile. Other cells lead to the first case that failed.</p>\n<div><table>\n<thead><tr><th></th>{heads}</tr></thead>\n"
        f"<tbody>{rows}</tbody>\n</table></div>\n{first}\n</html>"
    )


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print(page([json.loads(pathlib.Path(path).read_text(encoding="utf-8")) for path in sys.argv[1:]]))


if __name__ == "__main__":
    main()
