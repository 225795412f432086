"""The runner in Python and the judges agree with `stackless conform` on each case, for correct and wrong answers."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import pytest
from mangle import MISTAKES
from test_schema import FILES, SUITE, check, served, vectors

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parents[1]
STACKLESS = str(pathlib.Path(os.environ.get("STACKLESS", "target/debug/stackless")).resolve())
# Some cases of each profile, and all cases that detect the mistakes.
SOME = ["*1", "*2-*", "hash/build*", "ray/*-0", "ray/ulp*/*", "ray/grid/*zero*", "trace/script/three*", "resume/*/*-3"]
NAMES = {"stackless": [STACKLESS, "conform", "--window", "1"], "python": [sys.executable, str(SUITE / "conform.py")]}


def run(runner, command, folder, *options, filters=SOME):
    """Returns the exit status, the text, and the content of the JSON file."""
    path = folder / f"{runner}.json"
    chosen = [word for pattern in filters for word in ("--filter", pattern)]
    words = [*NAMES[runner], *chosen, "--json", str(path), *options, "--", *command]
    ran = subprocess.run(words, capture_output=True, text=True, cwd=ROOT)
    report = json.loads(path.read_text()) if path.exists() else None
    return ran.returncode, ran.stdout + ran.stderr, report


def mangled(mistake, *arguments):
    return [sys.executable, str(HERE / "mangle.py"), STACKLESS, mistake, *arguments]


# Some mistakes are visible only in a traversal that keeps these words.
ARGUMENTS = {name: ["--method", "hashed"] for name in MISTAKES if "register" in name or "trail" in name}
ARGUMENTS["other-counter"] = ["--method", "sparse"]
# Changes that the suite allows, at least in some profiles.
RIGHT = {"none", "negative-zero", "t-1-ulp", "t-8-ulp"}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_both_runners_say_the_same(mistake, tmp_path):
    command = mangled(mistake, *ARGUMENTS.get(mistake, ()))
    # Each silent case takes the whole timeout.
    options = ["--timeout", "0.7"] if mistake == "silence" else []
    results = {runner: run(runner, command, tmp_path, *options) for runner in NAMES}
    outcomes = {}
    for runner, (status, text, report) in results.items():
        check("report", report)
        outcomes[runner] = {case["id"]: case["outcome"] for case in report["cases"]}
        assert status == (0 if report["conforms"] else 1), text
    assert outcomes["stackless"] == outcomes["python"]
    failed = [id for id, outcome in outcomes["python"].items() if outcome not in ("pass", "not-asked")]
    if mistake in ("none", "negative-zero"):
        assert not failed and results["python"][2]["conforms"]
    elif mistake in RIGHT:
        assert failed and all(id.startswith(("ray/grid", "ray/exact")) for id in failed)
    else:
        assert failed, mistake


def judged(command):
    """Returns the verdict of a judge on each answer of the library, correct and mangled, with the expected verdict."""
    cases = [case for row in FILES for case in vectors(row["profile"])["cases"] if "valid" not in case["expect"]]
    chosen = cases[::5] + [case for case in cases if "ulp" in case["id"]]
    tests = []
    for mistake in (
        "none",
        "more",
        "one-event-less",
        "other-event",
        "t-9-ulp",
        "no-hit",
        "other-prim",
        "turned",
        "other-code",
    ):
        for hello, case, reply in zip(*answers(mistake, tuple(case["id"] for case in chosen), chosen)):
            tests.append({"test": case, "reply": reply, "hello": hello})
    lines = "".join(json.dumps(test) + "\n" for test in tests)
    said = subprocess.run(command, input=lines, capture_output=True, text=True, check=True).stdout.splitlines()
    assert len(said) == len(tests) > 5000
    for test, line in zip(tests, said):
        assert (line == "") == is_right(test), f"{test['test']['id']}: {line}: {json.dumps(test['reply'])[:300]}"
    assert 1000 < sum(line == "" for line in said) < len(said) - 1000


def is_right(test):
    sys.path.insert(0, str(SUITE))
    from stackless_conform.judge import Flaw, judge

    try:
        judge(test["test"], test["hello"], test["reply"])
    except Flaw:
        return False
    return True


def answers(mistake, ids, cases):
    hello, answered = served("--method", "hashed", "--word", "u32")
    replies = {case["id"]: reply for case, reply in answered}
    replies = [json.loads(json.dumps(replies[id])) for id in ids]
    asked = [i for i, reply in enumerate(replies) if "unsupported" not in reply]
    for i in asked:
        MISTAKES[mistake](replies[i])
        # The judges do not support counters and registers.
        for name in ("counters", "registers"):
            replies[i].get("result", {}).pop(name, None)
    plain = {**hello, "features": [name for name in hello["features"] if name not in ("counters", "registers")]}
    return [plain] * len(asked), [cases[i] for i in asked], [replies[i] for i in asked]


def test_the_judge_in_javascript(tmp_path):
    driver = tmp_path / "driver.mjs"
    driver.write_text(
        f'import {{ judge }} from "{SUITE}/judges/judge.mjs";\nimport {{ readFileSync }} from "node:fs";\n'
        "const lines = readFileSync(0, 'utf8').trim().split('\\n').map((line) => JSON.parse(line));\n"
        "console.log(lines.map(({ test, reply, hello }) => judge(test, reply, hello) ?? '').join('\\n'));\n"
    )
    judged([need("node"), str(driver)])


def test_the_judge_in_cpp(tmp_path):
    driver = tmp_path / "driver.cpp"
    driver.write_text(
        f'#include "{SUITE}/judges/judge.hpp"\n#include <iostream>\n#include <nlohmann/json.hpp>\n'
        "int main() {\n  for (std::string line; std::getline(std::cin, line);) {\n"
        "    const auto it = nlohmann::json::parse(line);\n"
        '    std::cout << stackless_suite::judge(it["test"], it["reply"], it["hello"]).value_or("") << "\\n";\n  }\n}\n'
    )
    program = tmp_path / "driver"
    flags = ["-std=c++17", "-Wall", "-Wextra", "-Werror", "-O1"]
    subprocess.run([need("c++"), *flags, "-o", str(program), str(driver)], check=True)
    judged([str(program)])


def need(tool):
    path = shutil.which(tool)
    assert path, f"{tool} is not here"
    return path


@pytest.mark.parametrize("runner", NAMES)
def test_the_skeletons_conform(runner, tmp_path):
    program = tmp_path / "skeleton"
    flags = ["-std=c++17", "-Wall", "-Wextra", "-Werror", "-O2"]
    subprocess.run([need("c++"), *flags, "-o", str(program), str(SUITE / "adapters/skeleton.cpp")], check=True)
    for command in ([str(program)], [need("node"), str(SUITE / "adapters/skeleton.mjs")]):
        status, text, report = run(runner, command, tmp_path, filters=["*"])
        passed = sum(case["outcome"] == "pass" for case in report["cases"])
        assert (status, passed) == (0, 285), text


def is_gone(pid):
    """Waits until a process has ended. Its entry may remain in the process table, as a zombie."""
    for _ in range(200):
        state = subprocess.run(["ps", "-o", "stat=", "-p", pid], capture_output=True, text=True).stdout.strip()
        if state == "" or state.startswith("Z"):
            return True
        time.sleep(0.01)
    return False


def test_the_runner_in_python_is_not_fooled(tmp_path):
    """No case, no program, a child process that outlives the program, and waivers: stale ones and patterns."""
    status, text, _ = run(
        "python", ["sh", "-c", 'read h; echo \'{"protocol":1,"name":"x","profiles":[]}\'; read b'], tmp_path
    )
    assert status == 1 and "nothing was asked" in text
    for command in (["sh", "-c", "exit 3"], ["/no/such/program"], ["echo", "no"]):
        assert run("python", command, tmp_path)[0] == 2
    pids = tmp_path / "pids"
    orphan = ["sh", "-c", f"sleep 1000 > /dev/null & echo $! > {pids}; exec {' '.join(mangled('none'))}"]
    assert run("python", orphan, tmp_path, filters=["key/u32/child-*"])[0] == 0
    assert is_gone(pids.read_text().strip())
    # A runner that is ended ends the program too.
    for end in (signal.SIGTERM, signal.SIGHUP):
        pids.unlink()
        command = [*NAMES["python"], "--", "sh", "-c", f"echo $$ > {pids}; sleep 1000"]
        with subprocess.Popen(command, stderr=subprocess.DEVNULL) as runner:
            while not (pids.exists() and pids.read_text().strip()):
                time.sleep(0.01)
            runner.send_signal(end)
            assert runner.wait(20) == 128 + end
        assert is_gone(pids.read_text().strip())
    waivers = tmp_path / "waivers.json"
    for id, expected in (("key/u32/*", 0), ("key/u32/child-left-root", 1)):
        waivers.write_text(json.dumps([{"id": id, "reason": "known"}]))
        mistake = "turned" if expected == 0 else "none"
        options = ["--waivers", str(waivers)]
        assert run("python", mangled(mistake), tmp_path, *options, filters=["key/u32/child-left-root"])[0] == expected
