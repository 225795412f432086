"""Answers like this library, but with one mistake: mangle.py STACKLESS MISTAKE. Judges and runners must detect it."""

import json
import os
import subprocess
import sys
import time


def words(reply, name):
    """Returns the list of a field, or an empty list."""
    value = reply.get("result", {}).get(name)
    return value if isinstance(value, list) else []


def first(reply, name, change):
    """Changes the first element that is not null."""
    for i, value in enumerate(words(reply, name)):
        if value is not None:
            reply["result"][name][i] = change(value)
            return


def later(hit, floats):
    return {**hit, "t": f"{int(hit['t'], 16) + floats:08x}"} if isinstance(hit, dict) else hit


def drop(reply, name):
    reply.get("result", {}).pop(name, None)


def put(reply, name, value):
    if "result" in reply:
        reply["result"][name] = value


def turn(reply):
    kind, what = ("result", {}) if "reject" in reply else ("reject", "trail")
    seq = reply["seq"]
    reply.clear()
    reply.update({"seq": seq, kind: what})


def refuse(reply):
    if reply.pop("result", None) is not None:
        reply["unsupported"] = "no"


MISTAKES = {
    "none": lambda reply: None,
    "more": lambda reply: put(reply, "more", 1),
    "one-event-less": lambda reply: words(reply, "events")[:1] and words(reply, "events").pop(),
    "no-events": lambda reply: drop(reply, "events"),
    "other-event": lambda reply: first(reply, "events", lambda event: event + "0"),
    "other-trail": lambda reply: first(reply, "trails", lambda trail: trail + "1"),
    "other-counter": lambda reply: first(reply, "counters", lambda word: word + "0"),
    "other-register": lambda reply: first(reply, "registers", lambda word: word + "0"),
    "unset-registers": lambda reply: (
        put(reply, "registers", [None for _ in words(reply, "registers")]) if words(reply, "registers") else None
    ),
    "no-registers": lambda reply: drop(reply, "registers"),
    "one-register-less": lambda reply: words(reply, "registers")[:1] and words(reply, "registers").pop(),
    "t-1-ulp": lambda reply: first(reply, "hits", lambda hit: later(hit, 1)),
    "t-8-ulp": lambda reply: first(reply, "hits", lambda hit: later(hit, 8)),
    "t-9-ulp": lambda reply: first(reply, "hits", lambda hit: later(hit, 9)),
    "t-257-ulp": lambda reply: first(reply, "hits", lambda hit: later(hit, -257)),
    "other-prim": lambda reply: first(
        reply, "hits", lambda hit: {**hit, "prim": hit["prim"] + 1} if isinstance(hit, dict) else hit
    ),
    "no-hit": lambda reply: first(reply, "hits", lambda hit: not hit if isinstance(hit, bool) else None),
    "one-ray-less": lambda reply: words(reply, "hits")[:1] and words(reply, "hits").pop(),
    "negative-zero": lambda reply: first(
        reply,
        "hits",
        lambda hit: {**hit, "t": hit["t"].replace("00000000", "80000000")} if isinstance(hit, dict) else hit,
    ),
    "no-weights": lambda reply: first(
        reply, "hits", lambda hit: {k: hit[k] for k in ("prim", "t")} if isinstance(hit, dict) else hit
    ),
    "other-cell": lambda reply: first(reply, "cells", lambda word: "0" if word != "0" else "1"),
    "cells-even": lambda reply: words(reply, "cells")[:1] and words(reply, "cells").pop(),
    "no-fold": lambda reply: drop(reply, "fold"),
    "other-fold": lambda reply: put(reply, "fold", "1") if "fold" in reply.get("result", {}) else None,
    "no-bits": lambda reply: drop(reply, "bits"),
    "other-seed": lambda reply: put(reply, "seed", "5") if "seed" in reply.get("result", {}) else None,
    "true-for-one": lambda reply: put(reply, "depth", True) if reply.get("result", {}).get("depth") == 1 else None,
    "turned": turn,
    "other-code": lambda reply: reply.update(reject="index") if "reject" in reply else None,
    "reject-and-result": lambda reply: reply.update(reject="trail"),
    "unsupported": refuse,
    "other-seq": lambda reply: reply.update(seq=reply["seq"] + 1) if reply["seq"] % 7 == 3 else None,
    "crash": lambda reply: os._exit(3) if reply["seq"] % 50 == 11 else None,
    "silence": lambda reply: time.sleep(60) if reply["seq"] % 300 == 11 else None,
}


def main():
    stackless, mistake, *arguments = sys.argv[1:]
    command = [stackless, "suite", "serve", *arguments]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as child:
        for line in sys.stdin:
            child.stdin.write(line)
            child.stdin.flush()
            if json.loads(line)["cmd"] == "bye":
                break
            reply = json.loads(child.stdout.readline())
            if "seq" in reply:
                MISTAKES[mistake](reply)
            print(json.dumps(reply), flush=True)


if __name__ == "__main__":
    main()
