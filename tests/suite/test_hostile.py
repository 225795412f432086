"""The runner in Python judges the lines of hostile.json like `stackless conform` (crates/suite/tests/suite/hostile.rs)."""

import json
import sys

import pytest
from test_schema import FILES, SUITE, vectors

sys.path.insert(0, str(SUITE))
from stackless_conform.__main__ import wrong_names
from stackless_conform.judge import Flaw, judge, read_hello, read_reply

HOSTILE = json.loads((SUITE / "hostile.json").read_text())
CASES = {case["id"]: case for row in FILES for case in vectors(row["profile"])["cases"]}


def outcome_of_hello(line):
    try:
        hello = read_hello(line)
    except ValueError:
        return "refused"
    return "does not conform" if wrong_names(hello, [row["profile"] for row in FILES]) else "conforms"


def outcome_of_answer(case, line):
    try:
        reply = read_reply(line, 0)
    except ValueError:
        return "error"
    try:
        judge(case, {"features": [], "limits": {}}, reply)
    except (Flaw, AttributeError, KeyError, TypeError, ValueError):  # as in Run.ask
        return "fail"
    return "pass"


@pytest.mark.parametrize("row", HOSTILE["hellos"], ids=lambda row: row["line"][:60])
def test_hello(row):
    assert outcome_of_hello(row["line"].encode("utf-8", "surrogatepass")) == row["outcome"]


@pytest.mark.parametrize("row", HOSTILE["answers"], ids=lambda row: row["line"][:60])
def test_answer(row):
    assert outcome_of_answer(CASES[row["case"]], row["line"].encode("utf-8", "surrogatepass")) == row["outcome"]


def test_what_is_no_text():
    for line in (b"\xff", '{"seq":0,"result":{"key":"2"}}'.encode("utf-16")):
        assert outcome_of_answer(CASES["key/u32/child-left-root"], line) == "error"
