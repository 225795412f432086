"""Cases that are known to fail: a list of ids or patterns, each with a reason (schema/waivers.json)."""

import fnmatch
import json

from . import SUITE
from .judge import shown


def is_pattern(id):
    return "*" in id or "?" in id


def matches(id, pattern):
    """Matches like `stackless conform`: `*` is any text, `?` any character, and `[` is not special."""
    return fnmatch.fnmatchcase(id, pattern.replace("[", "[[]"))


def load(path, ids):
    """Reads patterns with their reasons. Raises ValueError for an invalid list, or for an id without a case."""
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
    """Returns why the first withdrawn case with one of these ids was withdrawn (withdrawn.json), or None."""
    for case in json.loads((SUITE / "withdrawn.json").read_text(encoding="utf-8")):
        if case["id"] in ids:
            return f"case '{case['id']}' was withdrawn in suite {case['since']}: {case['reason']}"
    return None


def reason(waivers, id, outcome):
    """Returns the reason of the waiver with this id, otherwise of the first pattern that matches. None if not excused."""
    own = id if id in waivers else next((pattern for pattern in waivers if matches(id, pattern)), None)
    # Some cases of a pattern may pass, and a case that was not run needs no excuse.
    if own is None or outcome == "not-asked" or (outcome == "pass" and is_pattern(own)):
        return None
    return waivers[own]


def not_needed(waivers, verdicts):
    """Yields faults: waivers of chosen cases that excuse no failure."""
    for id in waivers:
        outcomes = {row["outcome"] for row in verdicts if matches(row["id"], id)}
        if outcomes == {"not-asked"}:
            yield f"the waiver of '{shown(id)}' is not needed: the case was not asked"
        elif outcomes and is_pattern(id) and outcomes <= {"pass", "not-asked"}:
            yield f"the waiver of '{shown(id)}' is not needed any more: no such case fails"


def written(waivers, verdicts):
    """Returns the list with which a run succeeds. Waivers of cases that were not chosen are kept."""
    elsewhere = [id for id in waivers if not any(matches(row["id"], id) for row in verdicts)]
    rows = [{"id": id, "reason": waivers[id]} for id in elsewhere]
    for row in verdicts:
        if "what" in row and row["strength"] == "must":
            rows.append({"id": row["id"], "reason": row.get("waived", f"{row['outcome']}: {row['what']}")})
    return rows
