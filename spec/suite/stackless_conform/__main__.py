"""Runs the conformance suite against a program: stackless-conform -- ./mine

The verdicts and reports are those of `stackless conform`, which also sends many cases at once. The exit code is 0 if a case
was sent and nothing failed, 1 otherwise, and 2 if the program could not run.
"""

import argparse
import atexit
import json
import os
import pathlib
import signal
import sys

from . import SUITE, VERSION
from . import waivers as waive
from .judge import shown
from .program import Run
from .report import Report, is_failure

LEVELS = ("key", "hash", "trace", "resume", "ray")
GIVEN_UP_AFTER = 20  # starts in a row that answer nothing


def main():
    args = arguments()
    if args.folder:
        print(SUITE)
        return
    run = Run(args)
    atexit.register(run.stop)  # for every exit
    for name in ("SIGTERM", "SIGHUP", "SIGQUIT"):  # Windows has only SIGTERM
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), run.terminate)
    try:
        bases, cases = load()
        waivers = waive.load(args.waivers, [case["id"] for _, case in cases])
        cases = [(name, case) for name, case in cases if is_wanted(args, case["id"])]
        if not cases:
            raise ValueError(waive.withdrawn(args.filter) or "no case has this level and a matching id")
        run.hello = run.start()
    except (OSError, ValueError) as error:  # TimeoutError is an OSError
        run.stop()
        print(f"{shown(args.command[0])}: {shown(str(error) or 'no hello in time')}", file=sys.stderr)
        sys.exit(2)
    faults = wrong_names(run.hello, bases)
    verdicts, is_over = ask_all(run, args, cases, waivers)
    if not any("what" in row or row["outcome"] == "pass" for row in verdicts):
        faults.append("nothing was asked: the program names no profile of these cases, or lacks their features")
    faults += run.bye()
    if not is_over:
        faults += not_shown(run.hello, verdicts)
        # After a first failure, the need for other waivers is unknown.
        faults += waive.not_needed(waivers, verdicts)
    report = Report(run.hello, verdicts, faults, bases, not args.filter and args.level is None)
    for line in report.text(args.show, args.command):
        print(line)
    if args.json:
        write(args.json, json.dumps(report.to_json(), indent=1))
    if args.junit:
        write(args.junit, "\n".join(report.to_junit()))
    if args.write_waivers:
        write(args.write_waivers, json.dumps(waive.written(waivers, verdicts), indent=1))
    sys.exit(0 if report.conforms else 1)


def load():
    """Returns the profiles, each with the more basic ones, and the cases, each with its profile."""
    rows, cases = json.loads((SUITE / "index.json").read_text(encoding="utf-8"))["files"], []
    for row in rows:
        file = json.loads((SUITE / row["file"]).read_text(encoding="utf-8"))
        if len(file["cases"]) != row["cases"] or file["suite"] != VERSION:
            raise ValueError(f"{row['file']}: not what index.json says")
        cases += [(row["profile"], case) for case in file["cases"]]
    return {row["profile"]: row.get("rests_on", []) for row in rows}, cases


def is_wanted(args, id):
    is_of_level = args.level is None or id.startswith(args.level + "/")
    return is_of_level and (not args.filter or any(waive.matches(id, pattern) for pattern in args.filter))


def wrong_names(hello, profiles):
    faults = [f"there is no profile '{shown(name)}'" for name in hello["profiles"] if name not in profiles]
    for names in (hello["profiles"], hello["features"]):
        faults += [f"'{shown(name)}' is named twice" for i, name in enumerate(names) if name in names[:i]]
    return faults


def not_shown(hello, verdicts):
    """Yields faults: named profiles without evidence. No case was run, or only advised cases were, and all failed."""
    for profile in dict.fromkeys(hello["profiles"]):
        rows = [row for row in verdicts if row["id"].rpartition("/")[0] == profile]
        asked = [row for row in rows if row["outcome"] != "not-asked"]
        if rows and not asked:
            yield f"{profile} is named, and none of its cases was asked: they need features or limits that were not"
        elif asked and all("what" in row and row["strength"] == "may" and "waived" not in row for row in asked):
            yield f"{profile} is named, and all that was asked of it is only advised, and failed"


def ask_all(run, args, cases, waivers):
    """Returns the result of each case, and whether the run ended at the first failure."""
    verdicts, silent, is_over = [], 0, False
    for seq, (profile, case) in enumerate(cases):
        outcome, what, reply = "not-asked", None, None
        if is_over:
            pass
        elif silent >= GIVEN_UP_AFTER:
            outcome, what = "error", f"given up: the last {silent} starts answered nothing"
        elif is_asked(run.hello, profile, case):
            outcome, what, reply = run.ask(seq, profile, case)
            silent = silent + 1 if outcome in ("error", "crash", "timeout") else 0
        row = {name: case[name] for name in ("id", "clauses", "strength", "why")}
        row.update(outcome=outcome, size=sum(map(size, case["input"].values())))
        if what is not None:
            row["what"] = what
        if reply is not None:
            row["shown"] = (case, reply)
        reason = waive.reason(waivers, case["id"], outcome)
        if reason is not None:
            row["waived"] = reason
        verdicts.append(row)
        is_over = is_over or args.fail_fast and "what" in row and is_failure(row)
    return verdicts, is_over


def is_asked(hello, profile, case):
    wide, slots = hello.get("limits", {}).get("wide"), case["input"].get("slots")
    return (
        profile in hello["profiles"]
        and all(feature in hello.get("features", ()) for feature in case.get("features", ()))
        and (slots is None or wide is None or str(slots) in wide)
    )


def size(value):
    return len(value) + sum(map(size, value)) if isinstance(value, list) else 0


def write(path, text):
    """Writes the file atomically."""
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    beside.write_text(text + "\n", encoding="utf-8")
    os.replace(beside, path)


def arguments():
    parser = argparse.ArgumentParser(
        prog="stackless-conform", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add, file = parser.add_argument, pathlib.Path
    add("--level", choices=LEVELS, help="run only cases of this level")
    add("--filter", action="append", default=[], help="run only cases with a matching id (* and ?); repeatable")
    add("--json", type=file, metavar="FILE", help="write the result of each case, as JSON")
    add("--junit", type=file, metavar="FILE", help="write the results as JUnit XML, for build servers")
    add("--waivers", type=file, metavar="FILE", help="expect the failures in this file (schema/waivers.json)")
    add("--write-waivers", type=file, metavar="FILE", help="write the waivers with which this run succeeds")
    add("--timeout", type=seconds, default=10, help="seconds to wait for an answer")
    add("--budget", type=seconds, default=1800, help="seconds for the whole run")
    add("--fail-fast", action="store_true", help="stop at the first failing case")
    add("--show", type=int, default=10, help="number of failures to print")
    add("--stderr", action="store_true", help="show the program's standard error")
    add("--folder", action="store_true", help="print the folder of the suite's files: vectors, adapters, judges")
    add("--version", action="version", version=f"suite {VERSION}")
    add("command", nargs="*", help="the program and its arguments, after --")
    args = parser.parse_args()
    if not args.command and not args.folder:
        parser.error("a program is needed, after --")
    return args


def seconds(text):
    if not 0.001 <= float(text) < 1e6:
        raise argparse.ArgumentTypeError("expected 0.001 to 1000000")
    return float(text)


if __name__ == "__main__":
    main()
