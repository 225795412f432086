"""Both runners write the same reports for build servers, and the same waivers."""

import json
import xml.etree.ElementTree

import pytest
from test_runner import NAMES, mangled, run
from test_schema import SUITE

SOME = ["key/u32/*", "hash/keys/*", "trace/script/three*", "ray/grid/*-0"]


def junit(path):
    """Returns counts, properties, and the name and outcome of each case, without messages."""
    suite = xml.etree.ElementTree.parse(path).getroot()
    counts = {name: suite.get(name) for name in ("name", "tests", "failures", "errors", "skipped")}
    cases = [(it.get("classname"), it.get("name"), [inside.tag for inside in it]) for it in suite.iter("testcase")]
    return counts, [it.get("value") for it in suite.iter("property")], cases


def both(mistake, folder, *options, **more):
    """Runs both runners and compares all results but the text. Returns those of the runner in Python."""
    results = []
    for runner in NAMES:
        files = [folder / f"{runner}.{ending}" for ending in ("xml", "waivers")]
        words = ["--junit", str(files[0]), "--write-waivers", str(files[1]), *options]
        status, text, report = run(runner, mangled(mistake), folder, *words, **{"filters": SOME, **more})
        written = [row["id"] for row in json.loads(files[1].read_text())]
        outcomes = [(case["id"], case["outcome"], "waived" in case) for case in report["cases"]]
        results.append((status, junit(files[0]), written, report["faults"], outcomes, text))
    assert results[0][:-1] == results[1][:-1]
    return results[1]


@pytest.mark.parametrize("mistake", ["none", "turned", "crash", "more"])
def test_junit_and_waivers_are_the_same(mistake, tmp_path):
    status, (counts, _, cases), waivers, _, _, _ = both(mistake, tmp_path)
    assert status == (mistake != "none") and len(waivers) == int(counts["failures"]) and len(cases) > 300
    # A run with the written waivers succeeds.
    path = tmp_path / "python.waivers"
    kept = tmp_path / "kept"
    kept.write_text(path.read_text())
    assert both(mistake, tmp_path, "--waivers", str(kept))[0] == 0


@pytest.mark.parametrize(
    "ids, is_bad",
    [
        (["key/u32/*", "trace/tape/*"], False),  # waivers of cases that are not chosen are ignored
        (["key/u32/*", "key/u64/*", "ray/exact/*"], False),
        (["hash/keys/*"], True),  # a chosen case fails without a waiver
    ],
)
def test_waivers_are_judged_the_same(ids, is_bad, tmp_path):
    path = tmp_path / "list.json"
    path.write_text(json.dumps([{"id": id, "reason": "known"} for id in ids]))
    status = both("turned", tmp_path, "--waivers", str(path), filters=["key/u32/child*", "key/u32/depth*"])[0]
    assert status == is_bad
    # A case that passes needs no waiver: its id is then a failure, a pattern a fault.
    for id in ("key/u32/child-left-root", "key/u32/child*"):
        path.write_text(json.dumps([{"id": id, "reason": "known"}]))
        assert both("none", tmp_path, "--waivers", str(path), filters=["key/u32/child*"])[0] == 1


@pytest.mark.parametrize("runner", NAMES)
@pytest.mark.parametrize(
    "text",
    ["{", "{}", '[{"id": "key/u32/none", "reason": "x"}]', '[{"id": "key/*"}]', '[{"id": "key/*", "reason": 1}]']
    + ["[" + ", ".join(['{"id": "key/*", "reason": "x"}'] * 2) + "]"],
)
def test_no_list_of_waivers(runner, text, tmp_path):
    path = tmp_path / "list.json"
    path.write_text(text)
    assert run(runner, mangled("none"), tmp_path, "--waivers", str(path), filters=["key/u32/child*"])[0] == 2


@pytest.mark.parametrize("runner", NAMES)
def test_a_withdrawn_case_is_named(runner, tmp_path):
    path = tmp_path / "list.json"
    path.write_text('[{"id": "ray/exact/stack-ulp", "reason": "known"}]')
    for options, filters in ((["--waivers", str(path)], ["key/u32/child*"]), ([], ["ray/exact/stack-ulp"])):
        status, text, _ = run(runner, mangled("none"), tmp_path, *options, filters=filters)
        assert status == 2 and "'ray/exact/stack-ulp' was withdrawn in suite 2.0.0: " in text, text


def test_level_and_first_failure(tmp_path):
    assert both("none", tmp_path, "--level", "key", filters=["*-root"])[0] == 0
    outcomes = both("turned", tmp_path, "--fail-fast", "--level", "key", filters=["key/u32/*"])[4]
    assert [outcome for _, outcome, _ in outcomes] == ["fail"] + ["not-asked"] * (len(outcomes) - 1)
    for runner in NAMES:
        assert run(runner, mangled("none"), tmp_path, "--level", "ray", filters=["key/*"])[0] == 2
        assert run(runner, mangled("none"), tmp_path, "--timeout", "0", filters=["key/*"])[0] == 2


def test_the_basic_profile_is_named_first(tmp_path):
    """The order of failures and the hints to more basic profiles are equal in both runners."""
    found = []
    for runner in NAMES:
        _, text, _ = run(runner, mangled("turned"), tmp_path, "--show", "40", filters=[*SOME, "resume/state/*"])
        hints = [line for line in text.splitlines() if ": fail: " in line or line.endswith(("first", "say more"))]
        found.append([line.partition(": fail: ")[0] for line in hints])
    assert found[0] == found[1]
    assert "  key/u32 fails too: look there first" in found[1] and found[1][0].startswith("key/u32/"), found[1]
    # A program that names only one profile gets a hint to the more basic one.
    filters = ["trace/tape/*-0"]
    hello = '{"protocol":1,"name":"x","profiles":["trace/tape"],"features":["changing"]}'
    wrong = ["sh", "-c", f"read h; echo '{hello}'; while read c; do echo '{{\"seq\":0,\"result\":{{}}}}'; done"]
    for runner in NAMES:
        _, text, _ = run(runner, wrong, tmp_path, filters=filters)
        assert "  trace/script, on which this rests, is not named: its cases say more" in text, text


def test_a_failure_says_what_to_do(tmp_path):
    status, text, _ = run("python", mangled("one-event-less"), tmp_path, filters=["trace/script/three*"])
    assert status == 1
    alone = f"  alone: python3 {SUITE / 'conform.py'} --filter 'trace/script/"
    for said in ("  why: ", "  clauses ", alone, "stackless explain --suite-case 'trace/", "    1 node 0: ", "received"):
        assert said in text, text
    _, text, _ = run("python", mangled("t-257-ulp"), tmp_path, filters=["ray/grid/inside-0"])
    for said in ("    # OBJ\n    v ", "    # ray ", "prim 0, t 4 (40800000)"):
        assert said in text, text


def test_both_runners_tell_what_a_program_said_last(tmp_path):
    hello = '{"protocol":1,"name":"x","profiles":["trace/tape"],"features":["changing"]}'
    ends = "echo first >&2; echo out of luck >&2; echo >&2; exit 3"
    said = "the program ended: exit status: 3; its standard error ends with: out of luck"
    for runner in NAMES:
        _, _, report = run(
            runner, ["sh", "-c", f"read h; echo '{hello}'; read c; {ends}"], tmp_path, filters=["trace/tape/*-0"]
        )
        asked = [case for case in report["cases"] if case["outcome"] != "not-asked"]
        assert asked and all(case["outcome"] == "crash" and case["what"] == said for case in asked), (runner, asked)
        status, text, _ = run(runner, ["sh", "-c", f"read h; {ends}"], tmp_path, filters=["trace/tape/*-0"])
        assert status == 2 and "out of luck" in text, text
