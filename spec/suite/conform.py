#!/usr/bin/env python3
"""Asks a program the cases of this folder, without cargo: python3 spec/suite/conform.py -- ./mine

The small runner: one case at a time, Python 3.8 or newer, standard library only. It judges as `stackless conform` does,
and writes the same `--json` (schema/report.json). `stackless conform` also writes JUnit, and asks many cases at once.
"""

import argparse
import atexit
import fnmatch
import json
import os
import pathlib
import queue
import re
import signal
import subprocess
import sys
import threading
import time

SUITE = pathlib.Path(__file__).resolve().parent
VERSION = (SUITE / "VERSION").read_text(encoding="utf-8").strip()
KINDS = ("result", "reject", "unsupported")  # of answers
GIVEN_UP_AFTER = 20  # starts in a row that answer nothing


class Flaw(Exception):
    """What is wrong with an answer."""


def shown(value):
    """Text of others: cut, and nothing in it that a terminal obeys."""
    text = value if isinstance(value, str) else json.dumps(value)
    text = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text[:121])
    return text if len(text) <= 120 else text[:120] + "..."


# The judge.


def judge(case, hello, reply):
    """Raises what is wrong with an answer to a case."""
    expect = {"reject": "too-deep"} if is_too_deep(case, hello) else case["expect"]
    kinds = [kind for kind in KINDS if reply.get(kind) is not None]
    if kinds == ["unsupported"]:
        raise Flaw(f"unsupported ({shown(reply['unsupported'])}), though profile and features were named")
    if "reject" in expect:
        if kinds == ["result"]:
            raise Flaw(f"answered, expected the rejection '{expect['reject']}'")
        if reply["reject"] != expect["reject"]:
            raise Flaw(f"rejected as '{shown(reply['reject'])}', expected '{expect['reject']}'")
    elif kinds == ["reject"]:
        raise Flaw(f"rejected as '{shown(reply['reject'])}', expected an answer")
    elif "near" in expect:
        judge_near(expect["near"], reply["result"])
    elif "valid" in expect:
        judge_table(case["input"], reply["result"])
    else:
        judge_result(case, hello.get("features", ()), expect["result"], reply["result"])


def same(name, expected, found):
    if isinstance(expected, list) and isinstance(found, list):
        for i in range(max(len(expected), len(found))):
            a, b = [json.dumps(it[i]) if i < len(it) else "nothing" for it in (expected, found)]
            if a != b and (i >= len(expected) or i >= len(found) or expected[i] != found[i] or "true" in a + b):
                raise Flaw(f"{name}[{i}]: {shown(b)}, expected {shown(a)}")
    elif expected != found or isinstance(expected, bool) != isinstance(found, bool):
        raise Flaw(f"{name}: {shown(found)}, expected {shown(expected)}")


def judge_result(case, features, expected, found):
    known = set(expected)
    for name, value in expected.items():
        if name == "trails" and "trails" not in features:
            continue
        if name not in found:
            raise Flaw(f"no field '{name}'")
        if name == "hits":
            value, other = (plain_hits(hits, "weights" in features) for hits in (value, found[name]))
            same(name, value, other)
        else:
            same(name, value, found[name])
    if "events" in expected and "trails" in expected and "slots" not in case["input"]:
        keys = [int(event.split()[1], 16) for event in expected["events"] if event.startswith(("enter", "leaf"))]
        visits = list(zip(keys, (int(trail, 16) for trail in expected["trails"])))
        for name, judge_list in (("counters", judge_counters), ("registers", judge_registers)):
            if name in features:
                known.add(name)
                if name not in found:
                    raise Flaw(f"no field '{name}'")
                judge_list(visits, found[name])
    for name in found:
        if name not in known:
            raise Flaw(f"unknown field '{shown(name)}'")


def plain_hits(hits, weights):
    """Zeros of either sign are one, and weights are there only if they are asked for."""
    if not isinstance(hits, list):
        return hits
    names = {"u", "v"} if not weights else set()
    return [
        {k: "00000000" if v == "80000000" else v for k, v in hit.items() if k not in names}
        if isinstance(hit, dict)
        else hit
        for hit in hits
    ]


def judge_counters(visits, found):
    same("counters", [format((1 << (key.bit_length() - 1)) * 2 - 1 - trail, "x") for key, trail in visits], found)


def judge_registers(visits, found):
    """Unset, or the node that comes next; always set while the sibling is postponed."""
    if not isinstance(found, list) or len(found) != len(visits):
        raise Flaw("registers: expected one for each visit")
    for i, ((key, trail), register) in enumerate(zip(visits, found)):
        low = (trail & -trail).bit_length() - 1
        right = format((key >> low) ^ 1, "x") if trail else None
        if register != right and (register is not None or trail & 1):
            raise Flaw(f"registers[{i}]: {shown(register)}, expected {shown(right)}")


def judge_near(near, result):
    hits = result.get("hits")
    if set(result) != {"hits"} or not isinstance(hits, list) or len(hits) != len(near["hits"]):
        raise Flaw("expected hits, one for each ray, and nothing else")
    for i, (expected, found) in enumerate(zip(near["hits"], hits)):
        if expected is None or not isinstance(found, dict):
            right = expected is None and found is None
        else:
            bits = found.get("t")
            right = found.get("prim") in expected["prims"] and isinstance(bits, str)
            right = right and re.fullmatch("[0-9a-f]{8}", bits) is not None
            right = right and abs(int(bits, 16) - int(expected["t"], 16)) <= near["ulps"]
        if not right:
            raise Flaw(f"hits[{i}]: {shown(found)}, expected {shown(expected)} within {near['ulps']} ulp")


def levels(children):
    """The level of each node; None where the children are no tree with the root 0."""
    level, pending = {}, [(0, 0)]
    while pending:
        node, at = pending.pop()
        if node in level or node >= len(children):
            return None
        level[node] = at
        pending += [(child, at + 1) for child in children[node] or ()]
    return level if len(level) == len(children) else None


def is_too_deep(case, hello):
    limits, fields = hello.get("limits", {}), case["input"]
    level = (
        case["id"].startswith(("trace/", "resume/")) and "reject" not in case["expect"] and levels(fields["children"])
    )
    if not level:
        return False
    if "slots" in fields:
        limit = (limits.get("wide") or {}).get(str(fields["slots"]))
        deepest = max(at for node, at in level.items() if fields["children"][node] is not None)
    else:
        limit, deepest = limits.get("max_depth"), max(level.values())
    return limit is not None and deepest > limit


def mixed(key, seed, bits):
    shifts, factors = {
        64: ((30, 27, 31), (0xBF58476D1CE4E5B9, 0x94D049BB133111EB, 1)),
        32: ((16, 15, 16), (0x7FEB352D, 0x846CA68B, 1)),
    }[bits]
    key = (key ^ seed) & (1 << bits) - 1
    for shift, factor in zip(shifts, factors):
        key = (key ^ key >> shift) * factor & (1 << bits) - 1
    return key


def folded(key, seed):
    rest = key.bit_length()
    if rest <= 64:
        return key
    length = rest
    while rest > 0:
        rest = max(rest - 63, 0)
        seed, key = mixed(key >> rest, seed, 64), key & (1 << rest) - 1
    return mixed(length, seed, 64)


def hashed(children, reach):
    """Key and node of all that is hashed."""
    nodes, pending = {}, [(1, 0)]
    while pending:
        key, node = pending.pop()
        nodes[key] = node
        pending += [(2 * key + side, child) for side, child in enumerate(children[node] or ())]
    below = {}  # of each key the greatest way down, as far as the reach says
    for key in sorted(nodes, reverse=True):
        below[key] = 1 + max(below[2 * key], below[2 * key + 1]) if 2 * key in nodes else 0
    if reach is None:
        return nodes
    needed = min(reach[0] + 2, reach[1] + 1)
    return {key: node for key, node in nodes.items() if below.get(key ^ 1, -1) >= needed}


def judge_table(asked, result):
    """Whether a table leads each key of the tree to its node."""
    children, keys = asked["children"], hashed(asked["children"], asked.get("reach"))
    may_fold = max(levels(children).values()) >= 64
    for name in result:
        if name not in ("displacements", "cells", "seed", "bits") and not (name == "fold" and may_fold):
            raise Flaw(f"unknown field '{shown(name)}'")
    if "fold" not in result and any(key.bit_length() > 64 for key in keys):
        raise Flaw("no field 'fold'")
    try:
        displacements, cells = ([word(text, 32) for text in result[name]] for name in ("displacements", "cells"))
        fold = word(result.get("fold", "0"), 64)
        seed, bits = word(result["seed"], 64) if "seed" in result else None, result.get("bits")
    except (KeyError, TypeError, ValueError) as error:
        raise Flaw(f"the table is wrong: {shown(str(error))}") from None
    d, h = len(displacements), len(cells)
    if d == 0 or d & d - 1 or h % 2 == 0 or "sizes" in asked and asked["sizes"] != [d, h]:
        raise Flaw(f"the table is wrong: D = {d}, H = {h}")
    if (seed is None) != (bits is None) or seed is not None and (bits not in (32, 64) or "sizes" in asked):
        raise Flaw("the table is wrong: seed and bits")
    for key, node in keys.items():
        key = folded(key, fold)
        key = key if seed is None else mixed(key, seed, bits)
        found = displacements[key % d]
        found = found if found >> 31 else cells[(key % h + found) % h]
        expected = 0x80000000 | node if children[node] is not None else node ^ 0xFFFFFFFF
        if found != expected:
            raise Flaw(f"the table is wrong: a key leads to {found:x}, expected {expected:x}")


def word(text, bits):
    if not re.fullmatch("0|[1-9a-f][0-9a-f]*", text) or int(text, 16) >> bits:
        raise ValueError(f"{text}: no word of {bits} bits")
    return int(text, 16)


# The program that is asked.


class Program:
    """A start of it. Whatever it starts ends with it, where there are process groups."""

    def __init__(self, command, passes_errors):
        errors = None if passes_errors else subprocess.DEVNULL
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": errors}
        self.child = subprocess.Popen(command, start_new_session=True, **pipes)
        self.lines = queue.Queue(4)
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        for line in self.child.stdout:
            self.lines.put(line)
        self.lines.put(None)

    def ask(self, request, timeout):
        """The answer; None if it has ended, TimeoutError if there is none in time."""
        try:
            self.child.stdin.write(json.dumps(request, separators=(",", ":")).encode() + b"\n")
            self.child.stdin.flush()
            if request["cmd"] == "bye":
                self.child.stdin.close()
        except OSError:
            pass  # it has ended, which is heard
        try:
            return self.lines.get(timeout=timeout)
        except queue.Empty:
            raise TimeoutError from None

    def end(self):
        try:
            os.killpg(self.child.pid, signal.SIGKILL)
        except (AttributeError, ProcessLookupError, PermissionError):
            self.child.kill()
        self.child.wait()


class Run:
    def __init__(self, args):
        self.args, self.program, self.hello, self.deadline = args, None, None, time.monotonic() + args.budget
        self.is_starting = self.is_over = False

    def terminate(self, *_):
        """Not between the start of a program and its name: nobody could end it."""
        self.is_over = True
        if not self.is_starting:
            sys.exit(143)

    def start(self):
        self.is_starting = True
        try:
            self.program = Program(self.args.command, self.args.stderr)
        finally:
            self.is_starting = False
        if self.is_over:
            sys.exit(143)
        line = self.program.ask({"cmd": "hello", "protocol": 1}, self.args.timeout)
        hello = json.loads(line or "null")
        if not isinstance(hello, dict) or hello.get("protocol") != 1 or not isinstance(hello.get("profiles"), list):
            raise ValueError(f"no hello: {shown((line or b'').decode(errors='replace'))}")
        return hello

    def stop(self):
        if self.program:
            self.program.end()
        self.program = None

    def ask(self, seq, profile, case):
        """Outcome and what is wrong."""
        level, name = profile.split("/")
        request = {"cmd": "case", "seq": seq, "level": level, "profile": name, "input": case["input"]}
        if time.monotonic() > self.deadline:
            return "error", f"given up: the run has taken {self.args.budget:g} s"
        try:
            if not self.program:
                self.start()
            line = self.program.ask(request, self.args.timeout)
        except TimeoutError:
            self.stop()
            return "timeout", "no answer in time (is every line flushed?)"
        except (OSError, ValueError) as error:
            self.stop()
            return "error", shown(str(error))
        if line is None:
            status = self.program.child.wait()
            self.stop()
            return "crash", f"the program ended: exit status: {status}"
        try:
            reply = json.loads(line)
            if not isinstance(reply, dict) or reply.get("seq") != seq:
                raise ValueError("no answer to this case")
            if sum(reply.get(kind) is not None for kind in KINDS) != 1:
                raise ValueError("expected one of result, reject and unsupported")
        except ValueError as error:
            self.stop()
            return "error", f"{shown(str(error))} in {shown(line.decode(errors='replace'))}"
        try:
            judge(case, self.hello, reply)
        except Flaw as flaw:
            return "fail", str(flaw)
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            return "fail", f"not as it must be: {shown(repr(error))}"
        return "pass", None


def is_asked(hello, profile, case):
    wide, slots = hello.get("limits", {}).get("wide"), case["input"].get("slots")
    return (
        profile in hello["profiles"]
        and all(feature in hello.get("features", ()) for feature in case.get("features", ()))
        and (slots is None or wide is None or str(slots) in wide)
    )


def size(value):
    return len(value) + sum(map(size, value)) if isinstance(value, list) else 0


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--filter", action="append", default=[], help="ids of cases, with * and ?; several times")
    parser.add_argument("--json", type=pathlib.Path, help="write what came of each case")
    parser.add_argument("--waivers", type=pathlib.Path, help="cases that are known to fail (schema/waivers.json)")
    parser.add_argument("--timeout", type=float, default=10, help="seconds to wait for an answer")
    parser.add_argument("--budget", type=float, default=1800, help="seconds for the whole run")
    parser.add_argument("--show", type=int, default=10, help="failures to print")
    parser.add_argument("--stderr", action="store_true", help="let the program's standard error through")
    parser.add_argument("--version", action="version", version=f"suite {VERSION}")
    parser.add_argument("command", nargs="+", help="the program and its arguments, after --")
    return parser.parse_args()


def main():
    args = arguments()
    run = Run(args)
    atexit.register(run.stop)  # however we end
    signal.signal(signal.SIGTERM, run.terminate)
    waivers = (
        {it["id"]: it["reason"] for it in json.loads(args.waivers.read_text(encoding="utf-8"))} if args.waivers else {}
    )
    try:
        run.hello = hello = run.start()
    except (OSError, ValueError, TimeoutError) as error:
        run.stop()
        print(f"{args.command[0]}: {shown(str(error) or 'no hello in time')}", file=sys.stderr)
        sys.exit(2)
    cases, faults = [], []
    files = json.loads((SUITE / "index.json").read_text(encoding="utf-8"))["files"]
    for row in files:
        file = json.loads((SUITE / row["file"]).read_text(encoding="utf-8"))
        if len(file["cases"]) != row["cases"] or file["suite"] != VERSION:
            run.stop()
            print(f"{row['file']}: not what index.json says", file=sys.stderr)
            sys.exit(2)
        cases += [(row["profile"], case) for case in file["cases"]]
    names = {row["profile"] for row in files}
    faults += [f"there is no profile '{shown(name)}'" for name in hello["profiles"] if name not in names]
    if len(set(hello["profiles"])) < len(hello["profiles"]):
        faults.append("a profile is named twice")
    patterns = args.filter or ["*"]
    cases = [(p, case) for p, case in cases if any(fnmatch.fnmatchcase(case["id"], pattern) for pattern in patterns)]
    verdicts, silent = [], 0
    for seq, (profile, case) in enumerate(cases):
        outcome, what = "not-asked", None
        if silent >= GIVEN_UP_AFTER:
            outcome, what = "error", f"given up: the last {silent} starts answered nothing"
        elif is_asked(hello, profile, case):
            outcome, what = run.ask(seq, profile, case)
            silent = silent + 1 if outcome in ("error", "crash", "timeout") else 0
        row = {name: case[name] for name in ("id", "clauses", "strength", "why")}
        row.update(outcome=outcome, size=size(list(case["input"].values())))
        if what is not None:
            row["what"] = what
        reason = next((why for id, why in waivers.items() if fnmatch.fnmatchcase(case["id"], id)), None)
        if reason is not None and (what is not None or outcome == "pass" and case["id"] in waivers):
            row["waived"] = reason
        verdicts.append(row)
    if all(row["outcome"] == "not-asked" for row in verdicts):
        faults.append("nothing was asked: the program names no profile of these cases, or lacks their features")
    if run.program:
        try:
            if run.program.ask({"cmd": "bye"}, args.timeout) is not None:
                faults.append("wrote more than was asked")
        except TimeoutError:
            faults.append("the program does not end after 'bye'")
    run.stop()
    sys.exit(report(args, hello, verdicts, faults))


def report(args, hello, verdicts, faults):
    failed = [
        row
        for row in verdicts
        if ("waived" in row and row["outcome"] == "pass")
        or ("waived" not in row and "what" in row and row["strength"] == "must")
    ]
    conforms = not failed and not faults
    failed.sort(key=lambda row: row["size"])
    for row in failed[: args.show]:
        print(f"{row['id']}: {row['outcome']}: {row.get('what', 'waived, and passes')}\n  why: {row['why']}")
        print(f"  clauses {', '.join(row['clauses'])}")
    for fault in faults:
        print(fault)
    counts = {name: sum(row["outcome"] == name for row in verdicts) for name in ("pass", "not-asked")}
    verdict = "conforms in what it names" if conforms else "does not conform"
    print(
        f"{shown(hello.get('name', ''))} {shown(hello.get('version', ''))} {verdict} (suite {VERSION}): {counts['pass']} of "
        f"{len(verdicts)} cases passed, {len(failed)} failed, {counts['not-asked']} not asked"
    )
    if args.json:
        rows = [{name: value for name, value in row.items() if name != "size"} for row in verdicts]
        whole = {"suite": VERSION, "implementation": hello, "conforms": conforms, "faults": faults, "cases": rows}
        args.json.write_text(json.dumps(whole, indent=1) + "\n", encoding="utf-8")
    return 0 if conforms else 1


if __name__ == "__main__":
    main()
