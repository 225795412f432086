"""A campaign on a Dask cluster of two workers on this machine. STACKLESS names the program."""

import json
import os
import shutil
import signal
import stat
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from distributed import Client, LocalCluster

sys.path.insert(0, str(Path(__file__).parent.parent))
import run

STACKLESS = os.environ["STACKLESS"]
RUN = Path(run.__file__)


def campaign(folder: Path, command: list[str], parts: int) -> Path:
    path = folder / "campaign.toml"
    path.write_text(f"command = {json.dumps(command)}\nparts = {parts}\n")
    return path


def start(path: Path, out: Path, *more: str, program: str = STACKLESS) -> subprocess.CompletedProcess:
    command = [sys.executable, str(RUN), str(path), "--output", str(out), "--workers", "2", "--program", program, *more]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)


def whole(folder: Path, command: list[str]) -> dict:
    path = folder / "whole.json"
    subprocess.run([STACKLESS, "--quiet", *command, "--json", str(path)], check=True)
    return counts(path)


def counts(path: Path) -> dict:
    """A record without the time that it took."""
    record = json.loads(path.read_text())
    del record["run"]["machines"]
    return record


def refused(done: subprocess.CompletedProcess, *what: str) -> None:
    """It could not run, and says why in a sentence."""
    assert done.returncode == 2 and done.stderr.startswith(("error: ", "usage: ")), done
    assert "Traceback" not in done.stderr and all(word in done.stderr for word in what), done


def wrapper(folder: Path, lines: str) -> str:
    """A program that runs these lines of shell before `stackless`, with the part in $part."""
    path = folder / "wrapper"
    path.write_text(
        '#!/bin/bash\npart=none\nfor ((i = 1; i <= $#; i++)); do\n'
        '  if [[ ${!i} == --shard ]]; then j=$((i + 1)); part=${!j}; fi\ndone\n'
        f'{lines}\nexec "{STACKLESS}" "$@"\n'
    )
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return str(path)


CHECK = ["check", "--trees", "3000", "--seed", "5"]


def test_a_lost_worker_costs_its_part_and_nothing_else(tmp_path):
    expected = whole(tmp_path, CHECK)
    # Each part takes long enough to be hit in its middle.
    slow = wrapper(tmp_path, "sleep 0.5")
    out = tmp_path / "out"
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        killed = []

        def kill_one():
            while not any(out.glob("*-of-8.json")):
                time.sleep(0.05)
            # That process alone, by its id. A nanny starts another worker in its place.
            with Client(cluster.scheduler_address) as client:
                pids = list(client.run(os.getpid).values())
            os.kill(pids[0], signal.SIGKILL)
            killed.extend(pids[:1])

        killer = threading.Thread(target=kill_one)
        killer.start()
        done = start(
            campaign(tmp_path, CHECK, 8), out, "--scheduler", cluster.scheduler_address, program=slow
        )
        killer.join()
    assert killed
    assert done.returncode == 0, done
    assert counts(out / "sum.json") == expected
    assert not (out / "failed").exists()


def test_a_part_that_crashes_is_kept_and_stops_no_other(tmp_path):
    out = tmp_path / "out"
    path = campaign(tmp_path, CHECK, 5)
    crashing = wrapper(tmp_path, 'if [[ $part == 3/5 ]]; then echo "out of luck" >&2; exit 9; fi')
    done = start(path, out, "--retries", "1", program=crashing)
    assert done.returncode == 2, done
    assert "600 of 3000 trees are missing: 1200 to 1799" in done.stderr
    assert sorted(file.name for file in out.glob("*.json")) == [f"{i}-of-5.json" for i in (1, 2, 4, 5)]
    failed = json.loads((out / "failed" / "3-of-5.json").read_text())
    assert failed["command"] == CHECK and failed["index"] == 3
    assert "exit code 9: out of luck" in failed["error"]
    # The rest of it is done later.
    done = start(path, out)
    assert done.returncode == 0, done
    assert "4 of 5 parts have a record already" in done.stdout
    assert counts(out / "sum.json") == whole(tmp_path, CHECK)


def test_a_part_is_tried_again(tmp_path):
    marks = tmp_path / "marks"
    marks.mkdir()
    flaky = wrapper(
        tmp_path, f'if [[ $part != none ]] && mkdir "{marks}/${{part//\\//-}}" 2> /dev/null; then kill -SEGV $$; fi'
    )
    out = tmp_path / "out"
    done = start(campaign(tmp_path, CHECK, 3), out, "--retries", "1", program=flaky)
    assert done.returncode == 0 and len(list(marks.iterdir())) == 3, done
    assert "pass: 3,000 trees, 0 rays, 27 methods, 0 disagreements" in done.stdout.splitlines()


def test_what_was_found_is_the_exit_code(tmp_path):
    """A record with disagreements, as a program would write that has found some."""
    out = tmp_path / "out"
    path = campaign(tmp_path, CHECK, 2)
    assert start(path, out).returncode == 0
    record = json.loads((out / "2-of-2.json").read_text())
    record["disagreements"] = 1
    (out / "2-of-2.json").write_text(json.dumps(record))
    done = start(path, out)
    assert done.returncode == 1, done
    assert "1 of 3,000 cases went wrong" in done.stdout


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("parts = 3", "command: expected a list of texts"),
        ('command = "check"\nparts = 3', "command: expected a list of texts"),
        ('command = ["check"]\nparts = 0', "parts: expected a number from 1 on"),
        ('command = ["check"]\nparts = true', "parts: expected a number from 1 on"),
        ('command = ["check"]\nparts = 3\nspeed = 2', "unknown key 'speed'"),
        ("command = [", "campaign.toml: "),
    ],
)
def test_bad_files_are_named(tmp_path, text, what):
    path = tmp_path / "campaign.toml"
    path.write_text(text)
    done = start(path, tmp_path / "out")
    assert done.returncode == 2 and what in done.stderr, done
    assert len(done.stderr.splitlines()) == 1


def test_what_cannot_run_is_no_finding(tmp_path, monkeypatch):
    path, out = campaign(tmp_path, CHECK, 2), tmp_path / "out"
    refused(start(path, out, program=str(tmp_path / "none")), "none")
    refused(start(path, out, program="false"), "false --version: exit code 1")
    file = tmp_path / "file"
    file.touch()
    refused(start(path, file), str(file))
    monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT", "1s")
    for address in ("127.0.0.1:1", "nowhere://x"):
        refused(start(path, out, "--scheduler", address), address.partition(":")[0])
    for option in (["--workers", "0"], ["--workers", "-1"], ["--threads", "0"], ["--retries", "-1"]):
        refused(start(path, out, *option), option[0], "expected a number from")
    assert not list(out.glob("*.json"))


def test_a_run_accepts_only_its_own_records(tmp_path):
    out = tmp_path / "out"
    path = campaign(tmp_path, CHECK, 2)
    assert start(path, out).returncode == 0
    first, second = (out / f"{i}-of-2.json" for i in (1, 2))
    assert first.stat().st_mode & 0o777 == (tmp_path / "campaign.toml").stat().st_mode & 0o777
    for command in (["check", "--trees", "3000", "--seed", "6"], [*CHECK, "--nosuch"]):
        refused(start(campaign(tmp_path, command, 2), out), "1-of-2.json: not a record of this campaign: its command is")
    path = campaign(tmp_path, CHECK, 2)
    text = first.read_text()
    for key, value in (("version", "0.0.9"), ("commit", "0123abc")):
        record = json.loads(text)
        record["run"][key] = value
        first.write_text(json.dumps(record))
        refused(start(path, out), "1-of-2.json: not a record of this campaign: its version is", value)
    for other in (second.read_text(), "[]", "{}", '{"run": 5}', '{"run": {"version": 5, "commit": null}}'):
        first.write_text(other)
        refused(start(path, out), "1-of-2.json: not a record of this campaign: ")
    # What a crash has cut off is made again.
    for cut in ("", text[:-9]):
        first.write_text(cut)
        done = start(path, out)
        assert done.returncode == 0 and "1-of-2.json: cut off" in done.stdout, done
        assert counts(first) == json.loads(text) | {"run": counts(first)["run"]}


def test_a_worker_with_another_version_fails(tmp_path):
    out = tmp_path / "out"
    other = wrapper(tmp_path, 'if [[ $1 == --version ]]; then echo "stackless 9.9.9 (0123abc)"; exit; fi')
    done = start(campaign(tmp_path, CHECK, 2), out, "--retries", "0", program=other)
    assert done.returncode == 2 and "expected 9.9.9 (0123abc)" in done.stdout, done
    assert not list(out.glob("*.json"))
