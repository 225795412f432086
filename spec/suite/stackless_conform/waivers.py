"""Cases that are known to fail: a list of ids or patterns, each with a reason (schema/waivers.json)."""

import fnmatch
import json

from . import SUITE
from .judge import shown


def is_pattern(id):
    return "*" in id or "?" in id


def matches(id, pattern):
    """As `stackless conform` has it: `*` is any text, `?` any character, and `[` is itself."""
    return fnmatch.fnmatchcase(id, pattern.replace("[", "[[]"))


def load(path, ids):
    """Pattern and reason. ValueError where a list is none, or names what is no case."""
    if path is None:
        return {}
    waivers = {}
    rows = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(rows, list):
        raise ValueError("expected a list of waivers")
    for row in rows:
        is_waiver = isinstance(row, dict) and set(row) == {"id", "reason"}
        if not is_waiver or not all(isinstance(it, str) for it in row.values()):
            raise ValueError("expected waivers of an id and a reason")
        if row["id"] in waivers:
            raise ValueError(f"case '{shown(row['id'])}' stands twice")
        if not any(matches(id, row["id"]) for id in ids):
            raise ValueError(withdrawn([row["id"]]) or f"there is no case '{shown(row['id'])}'")
        waivers[row["id"]] = row["reason"]
    return waivers


def withdrawn(ids):
    """Why the first of these ids that belonged to a case was withdrawn (withdrawn.json); None if none did."""
    for case in json.loads((SUITE / "withdrawn.json").read_text(encoding="utf-8")):
        if case["id"] in ids:
            return f"case '{case['id']}' was withdrawn in suite {case['since']}: {case['reason']}"
    return None


def reason(waivers, id, outcome):
    """Why a case is excused: by its own id, or else by the first pattern. None if it is not."""
    own = id if id in waivers else next((pattern for pattern in waivers if matches(id, pattern)), None)
    # Of the cases of a pattern some may pass, and one that is not asked needs no excuse.
    if own is None or outcome == "not-asked" or (outcome == "pass" and is_pattern(own)):
        return None
    return waivers[own]


def not_needed(waivers, verdicts):
    """Faults: waivers of cases that were run, and that excuse nothing."""
    for id in waivers:
        outcomes = {row["outcome"] for row in verdicts if matches(row["id"], id)}
        if outcomes == {"not-asked"}:
            yield f"the waiver of '{shown(id)}' is not needed: the case was not asked"
        elif outcomes and is_pattern(id) and outcomes <= {"pass", "not-asked"}:
            yield f"the waiver of '{shown(id)}' is not needed any more: no such case fails"


def written(waivers, verdicts):
    """The list with which a run succeeds. Those of cases that were not run are kept."""
    elsewhere = [id for id in waivers if not any(matches(row["id"], id) for row in verdicts)]
    rows = [{"id": id, "reason": waivers[id]} for id in elsewhere]
    for row in verdicts:
        if "what" in row and row["strength"] == "must":
            rows.append({"id": row["id"], "reason": row.get("waived", f"{row['outcome']}: {row['what']}")})
    return rows
