"""The report of a run: as text, as JSON (schema/report.json), and as JUnit."""

import pathlib
import shlex
import sys
from collections import defaultdict

from . import VERSION
from .judge import shown
from .picture import picture

OUTCOMES = ("pass", "fail", "error", "crash", "timeout", "not-asked")


class Report:
    def __init__(self, hello, verdicts, faults, bases, is_whole):
        self.is_whole = is_whole
        self.hello, self.verdicts, self.faults, self.bases = hello, verdicts, faults, bases
        self.failed = [row for row in verdicts if is_failure(row)]
        self.conforms = not self.failed and not faults

    def failures(self):
        """Returns the smallest failure of each profile, basic profiles first; then the second smallest of each, and so on."""
        profiles = defaultdict(list)
        for row in sorted(self.failed, key=lambda row: (len(self.bases[profile(row)]), profile(row), row["size"], is_drawn(row))):
            profiles[profile(row)].append(row)
        ranked = [pair for rows in profiles.values() for pair in enumerate(rows)]
        return [row for _, row in sorted(ranked, key=lambda it: it[0])]

    def look_first(self, row):
        """Returns a hint to a more basic profile, where the mistake shows earlier: it fails too, or is not named."""
        bases, failing = self.bases[profile(row)], {profile(it) for it in self.failed}
        for base in bases:
            if base in failing:
                return f"{base} fails too: look there first"
        for base in reversed(bases):
            if base not in self.hello["profiles"]:
                return f"{base}, on which this rests, is not named: its cases say more"
        return None

    def text(self, show, command):
        failures = self.failures()
        for at, row in enumerate(failures[:show]):
            yield f"{row['id']}: {row['outcome']}: {row.get('what', 'waived, and passes')}\n  why: {row['why']}"
            yield f"  clauses {', '.join(clauses(row, self.hello['features']))}"
            yield f"  alone: {own_name(sys.argv[0])} --filter '{row['id']}' -- {shown(' '.join(map(shlex.quote, command)))}"
            if row["id"].startswith("trace/") and not profile(row).endswith("invalid"):
                yield f"  step by step: stackless explain --suite-case '{row['id']}' -o case.html"
            hint = self.look_first(row)
            if hint:
                yield f"  {hint}"
            if at == 0 and "shown" in row:
                yield from (f"    {line}" for line in picture(*row["shown"]))
        if len(failures) > show:
            yield f"and {len(failures) - show} more (--show {len(failures)}, --json FILE)"
        yield from self.faults
        yield from self.table()
        counts = [self.count(name) for name in OUTCOMES]
        waived = sum("waived" in row for row in self.verdicts)
        # If only a part was chosen, other cases may fail.
        passed = "conforms in what it names" if self.is_whole else "passes what was chosen"
        verdict = passed if self.conforms else "does not conform"
        yield (
            f"{shown(self.hello.get('name', ''))} {shown(self.hello.get('version', ''))} {verdict} (suite {VERSION}): "
            f"{counts[0]} of {len(self.verdicts)} cases passed, {sum(counts[1:5])} failed, {counts[5]} not asked, "
            f"{waived} waived"
        )

    def count(self, name, rows=None):
        rows = self.verdicts if rows is None else rows
        return sum(row["outcome"] == name and "waived" not in row for row in rows)

    def table(self):
        """Yields a line for each profile with a case that was run."""
        profiles = defaultdict(list)
        for row in self.verdicts:
            if row["outcome"] != "not-asked":
                profiles[profile(row)].append(row)
        width = max(map(len, profiles), default=0)
        yield "  ".join([" " * width, *OUTCOMES[:5], "waived"])
        for name, rows in profiles.items():
            counts = [self.count(outcome, rows) for outcome in OUTCOMES[:5]]
            counts.append(len(rows) - sum(counts))
            cells = (str(count).rjust(len(head)) for count, head in zip(counts, [*OUTCOMES[:5], "waived"]))
            yield "  ".join([name.ljust(width), *cells])

    def to_json(self):
        rows = [{name: value for name, value in row.items() if name not in ("size", "shown")} for row in self.verdicts]
        about = {"suite": VERSION, "implementation": self.hello, "conforms": self.conforms, "faults": self.faults}
        return {**about, "cases": rows}

    def to_junit(self):
        """Yields a test case for each case, `skipped` if it was not run or is waived."""
        rows = [(*row["id"].rsplit("/", 1), inside(row)) for row in self.verdicts]
        rows += [("run", f"fault {i}", failure(fault)) for i, fault in enumerate(self.faults)]
        failures, skipped = (sum(it.startswith(tag) for _, _, it in rows) for tag in ("<failure", "<skipped"))
        yield '<?xml version="1.0" encoding="UTF-8"?>'
        name = escaped(str(self.hello.get("name", "")))
        yield f'<testsuite name="{name}" tests="{len(rows)}" failures="{failures}" errors="0" skipped="{skipped}">'
        yield f'<properties><property name="suite" value="{VERSION}"/></properties>'
        for group, name, it in rows:
            yield f'<testcase classname="{escaped(group)}" name="{escaped(name)}">{it}</testcase>'
        yield "</testsuite>"


def own_name(path):
    """Returns the command that starts this runner."""
    name = pathlib.Path(path).name
    if name == "__main__.py":
        return "python3 -m stackless_conform"
    return f"python3 {shlex.quote(path)}" if name.endswith(".py") else name


def is_drawn(row):
    """Returns whether a case was drawn by a seed. Of cases of equal size, those with a descriptive name come first."""
    return row["id"].rpartition("-")[2].isdigit()


# The clauses of each field, and the clauses that need a feature.
OF_FIELD = {"registers": ("REGISTER-", "UNCLE-", "HASHED-"), "trails": ("TRAIL-", "WIDE-10"), "counters": ("TRAIL-6",)}
OF_REGISTERS = (*OF_FIELD["registers"], "HASH-3")


def clauses(row, features):
    """Returns the clauses, those of the field that differs first, and those of registers only with the feature."""
    first = OF_FIELD.get(row.get("what", "").partition("[")[0], ())
    kept = [it for it in row["clauses"] if "registers" in features or not it.startswith(OF_REGISTERS)]
    return sorted(kept or row["clauses"], key=lambda it: not it.startswith(first) if first else False)


def profile(row):
    return row["id"].rpartition("/")[0]


def is_failure(row):
    """Returns whether a required case failed without a waiver, or a waived case passed."""
    if "waived" in row:
        return row["outcome"] == "pass"
    return "what" in row and row["strength"] == "must"


def inside(row):
    """Returns the content of a test case of JUnit."""
    if is_failure(row):
        more = f"{row['why']}\nclauses {', '.join(row['clauses'])}" if "what" in row else ""
        return failure(row.get("what", "waived, and passes"), more)
    if row["outcome"] == "pass":
        return ""
    return f'<skipped message="{escaped(row.get("waived") or row.get("what") or row["outcome"])}"/>'


def failure(message, more=""):
    return f'<failure message="{escaped(message)}">{escaped(more)}</failure>'


def escaped(text):
    """Escapes text for XML 1.0, which cannot represent some characters."""
    named = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\n": "&#10;", "\t": "&#9;"}
    return "".join(named.get(c) or (c if is_xml(c) else "\ufffd") for c in text)


def is_xml(c):
    is_control = c < " " or "\x7f" <= c <= "\x9f"
    return not (is_control or "\ud800" <= c <= "\udfff" or c in "\ufffe\uffff")
