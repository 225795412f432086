"""Every file of `spec/suite` and every answer of this library matches its schema; the schemas refuse changed ones."""

import copy
import functools
import json
import os
import pathlib
import subprocess

import jsonschema
import pytest

SUITE = pathlib.Path(__file__).parents[2] / "spec/suite"
STACKLESS = os.environ.get("STACKLESS", "target/debug/stackless")
FILES = json.loads((SUITE / "index.json").read_text())["files"]


@functools.cache
def validator(name):
    schema = json.loads((SUITE / f"schema/{name}.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


@functools.cache
def vectors(profile):
    return json.loads((SUITE / f"vectors/{profile}.json").read_text())


def check(name, value):
    error = jsonschema.exceptions.best_match(validator(name).iter_errors(value))
    assert error is None, f"{name}: {error.json_path}: {error.message[:500]}"


def is_refused(name, value):
    return not validator(name).is_valid(value)


@pytest.mark.parametrize("row", FILES, ids=lambda row: row["profile"])
def test_each_file_is_as_its_schema_says(row):
    check("vectors", vectors(row["profile"]))
    assert len(vectors(row["profile"])["cases"]) == row["cases"]


def test_the_index_is():
    check("index", json.loads((SUITE / "index.json").read_text()))


@functools.cache
def served(*options):
    """Returns the hello of this library, and its answers to all cases, each with its case."""
    cases = [(row["profile"], case) for row in FILES for case in vectors(row["profile"])["cases"]]
    requests = [{"cmd": "hello", "protocol": 1}]
    for seq, (name, case) in enumerate(cases):
        level, profile = name.split("/")
        requests.append({"cmd": "case", "seq": seq, "level": level, "profile": profile, "input": case["input"]})
    lines = "".join(json.dumps(request) + "\n" for request in [*requests, {"cmd": "bye"}])
    command = [STACKLESS, "suite", "serve", *options]
    ran = subprocess.run(command, input=lines, capture_output=True, text=True, check=True)
    hello, *replies = map(json.loads, ran.stdout.splitlines())
    assert len(replies) == len(cases) > 4000
    return hello, [(case, reply) for (_, case), reply in zip(cases, replies)]


def test_what_this_library_answers_is():
    """The hello of this library and each of its answers match their schemas."""
    hello, answered = served()
    check("hello", hello)
    for _, reply in answered:
        check("reply", reply)
        assert "unsupported" not in reply


def mutate(value, path, change):
    """Returns a copy in which the value at the path is changed."""
    value = copy.deepcopy(value)
    at = value
    for step in path[:-1]:
        at = at[step]
    change(at, path[-1])
    return value


def put(new):
    return lambda at, step: at.__setitem__(step, new)


def drop(at, step):
    del at[step]


@pytest.mark.parametrize(
    ("profile", "path", "change"),
    [
        ("key/u32", ["profile"], put("u33")),
        ("key/u32", ["suite"], put("1.4")),
        ("key/u32", ["cases", 0, "why"], drop),
        ("key/u32", ["cases", 0, "more"], put(1)),
        ("key/u32", ["cases", 0, "input", "key"], put("0X1")),
        ("key/u32", ["cases", 0, "input", "key"], put("01")),
        ("hash/build", ["cases", 0, "expect"], put({"valid": False})),
        ("hash/build-deep", ["profile"], put("build_deep")),
        ("trace/tape", ["cases", 0, "input", "cells", 0], put({"enter": 2**32})),
        ("trace/tape", ["cases", 0, "input", "cells", 0], put({"axis": 3})),
        ("trace/tape", ["cases", 0, "expect", "result", "events", 0], put("enter 0")),
        ("trace/tape", ["cases", 0, "clauses"], put(["ORACLE-1", "ORACLE-1"])),
        ("ray/grid", ["cases", 0, "input", "rays", 0], put("3f800000")),
        ("ray/grid", ["cases", 0, "input", "query"], put("all")),
        ("ray/invalid", ["cases", 0, "expect"], put({"reject": "nonsense"})),
    ],
)
def test_a_file_with_a_mistake_is_refused(profile, path, change):
    file = {**vectors(profile), "cases": vectors(profile)["cases"][:1]}
    check("vectors", file)
    assert is_refused("vectors", mutate(file, path, change))


@pytest.mark.parametrize(
    "reply",
    [
        {"seq": 0},
        {"seq": -1, "reject": "trail"},
        {"seq": 0, "reject": "nonsense"},
        {"seq": 0, "reject": "trail", "unsupported": "no"},
        {"seq": 0, "result": {"key": "1"}, "reject": "trail"},
        {"seq": 0, "result": {"key": 1}},
        {"seq": 0, "result": {"displacements": [], "cells": [], "seed": "1"}},
        {"seq": 0, "result": {"events": ["end"], "hit": {"t": 2**32, "node": 0}}},
    ],
)
def test_a_wrong_answer_is_refused(reply):
    assert is_refused("reply", reply)


@pytest.mark.parametrize(
    "change",
    [
        {"protocol": 2},
        {"profiles": ["key/u33"]},
        {"profiles": ["key/u32", "key/u32"]},
        {"features": ["trails", "trails"]},
        {"features": ["speed"]},
        {"limits": {"wide": {"3": 1}}},
    ],
)
def test_a_wrong_hello_is_refused(change):
    hello = {"protocol": 1, "name": "x", "profiles": ["key/u32"], "features": ["trails"], "limits": {"max_depth": 31}}
    check("hello", hello)
    assert is_refused("hello", {**hello, **change})


def test_what_was_withdrawn_is():
    withdrawn = json.loads((SUITE / "withdrawn.json").read_text())
    check("withdrawn", withdrawn)
    ids = {case["id"] for row in FILES for case in vectors(row["profile"])["cases"]}
    assert withdrawn and ids.isdisjoint(case["id"] for case in withdrawn)
    assert is_refused("withdrawn", [{"id": "ray/exact/x", "reason": "wrong"}])


def test_waivers_are():
    check("waivers", [{"id": "key/u32/child-left-root", "reason": "known"}])
    assert is_refused("waivers", [{"id": "key/u32/child-left-root"}])
