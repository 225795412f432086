#!/usr/bin/env python3
"""A page of who passes what, from reports of runs: dashboard.py REPORT.json... > page.html

REPORT.json is what `stackless conform --json` or `conform.py --json` writes. Of each level a table: one row
for each implementation, one column for each profile that one of them names. A cell leads to the first case that failed.
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


EMPTY = '<td title="not asked"></td>'

HEAD = f"""<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Who passes what</title>
<style>{STYLE}</style>
<h1>Who passes what</h1>
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
        return EMPTY, None
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
    was_asked = [case for report in reports for case in report["cases"] if case["outcome"] != "not-asked"]
    profiles = list(dict.fromkeys(map(profile_of, was_asked)))
    parts = [part(reports, level, profiles) for level in dict.fromkeys(name.split("/")[0] for name in profiles)]
    tables, failures = ("\n".join(all) for all in zip(*parts)) if parts else ("", "")
    versions = ", ".join(sorted({report["suite"] for report in reports}))
    first = f"<h2>First failures</h2>\n<dl>{failures}</dl>\n" if failures.strip() else ""
    return HEAD + (
        f"<p>Cases that pass, by profile, of version {text(versions)} of the suite. An empty cell was not asked: its\n"
        f"implementation does not name the profile. Red and yellow cells lead to the first case that failed.</p>\n"
        f"{tables}\n{first}</html>"
    )


def part(reports, level, profiles):
    """The table of a level, with the implementations that were asked, and the failures that it leads to."""
    profiles = [profile for profile in profiles if profile.split("/")[0] == level]
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
        if any(data != EMPTY for data in cells):
            rows.append(f"<tr><th>{text(name)}</th>{''.join(cells)}</tr>")
    heads = "".join(f"<th>{text(profile.split('/')[1])}</th>" for profile in profiles)
    table = "<table>\n<thead><tr><th></th>{}</tr></thead>\n<tbody>{}</tbody>\n</table>".format(heads, "\n".join(rows))
    return f"<h2>{text(level)}</h2>\n<div>{table}</div>", "\n".join(failures)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print(page([json.loads(pathlib.Path(path).read_text(encoding="utf-8")) for path in sys.argv[1:]]))


if __name__ == "__main__":
    main()
