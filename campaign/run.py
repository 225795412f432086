#!/usr/bin/env python3
"""Runs the parts of a campaign on Dask, and adds their records up.

A campaign file (TOML) says what to run and in how many parts:

    command = ["check", "--trees", "10000000", "--seed", "7"]
    parts = 64

Each part is a run of `stackless` with `--shard I/N`. Its record is written to the folder as soon as it is there, so a
campaign that was stopped goes on where it was. A part is tried again after a crash, and elsewhere after the loss of a
worker. One that never ends well is kept under `failed`, and the others go on.

A record says which campaign it is of. Records of another campaign, or of another version of the program, are refused; one
that was cut off is made again.

The exit code is that of `stackless merge`: 0 if nothing went wrong, 1 if a check found something, 2 if parts are missing or
the campaign could not run.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tomllib
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from uuid import uuid4

from distributed import Client, LocalCluster, as_completed


@dataclass(frozen=True)
class Campaign:
    """What is run, in how many parts."""

    command: tuple[str, ...]
    parts: int

    @classmethod
    def load(cls, path: Path) -> Campaign:
        """Reads a campaign file. Raises ValueError that names the file and what was expected."""
        try:
            table = tomllib.loads(path.read_text())
        except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            raise ValueError(f"{path}: {error}") from None
        unknown = table.keys() - {"command", "parts"}
        if unknown:
            raise ValueError(f"{path}: unknown key {sorted(unknown)[0]!r}: expected command and parts")
        command, parts = table.get("command"), table.get("parts")
        if not (isinstance(command, list) and command and all(isinstance(word, str) for word in command)):
            raise ValueError(f"{path}: command: expected a list of texts, the arguments of stackless")
        if type(parts) is not int or parts < 1:
            raise ValueError(f"{path}: parts: expected a number from 1 on")
        return cls(tuple(command), parts)


@dataclass(frozen=True)
class Part:
    """One part of a campaign, for one worker. `version` is that of the program, with its commit if it has one."""

    program: str
    version: str
    command: tuple[str, ...]
    index: int
    parts: int
    threads: int

    @property
    def name(self) -> str:
        return f"{self.index}-of-{self.parts}"

    def arguments(self) -> list[str]:
        shard = f"{self.index}/{self.parts}"
        return [self.program, "--quiet", *self.command, "--shard", shard, "--json", "-"]

    def check(self, record: dict) -> None:
        """Raises ValueError if a record is not of this part and this version of the program."""
        run = record["run"]
        version = run["version"] + (f" ({run['commit']})" if run["commit"] else "")
        found = {**record.get("campaign", {}), "version": version}
        for key, expected in {**self.label(), "version": self.version}.items():
            if found.get(key) != expected:
                raise ValueError(f"its {key} is {found.get(key)}, expected {expected}")

    def label(self) -> dict:
        """Returns the fields of a record that identify its campaign."""
        return {"command": list(self.command), "part": self.name}

    def has_record(self, path: Path) -> bool:
        """Whether this file is the record of the part. Raises ValueError if it is one of something else."""
        try:
            record = json.loads(path.read_text())
        except FileNotFoundError:
            return False
        except ValueError:
            print(f"{path}: cut off, the part runs again", flush=True)
            return False
        try:
            self.check(record)
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise ValueError(f"{path}: not a record of this campaign: {error}") from None
        return True


class Crash(Exception):
    """A part that did not run to its end."""


def run_part(part: Part) -> dict:
    """Runs a part where this is called, and returns its record. Raises Crash."""
    environment = {**os.environ, "RAYON_NUM_THREADS": str(part.threads)}
    run = subprocess.run(part.arguments(), capture_output=True, text=True, env=environment, check=False)
    # 1 says that the check has found something: that is in the record.
    if run.returncode not in (0, 1):
        raise Crash(f"exit code {run.returncode}: {run.stderr.strip()[-2000:]}")
    try:
        record = {"campaign": part.label(), **json.loads(run.stdout)}
        part.check(record)
    except (KeyError, TypeError, ValueError) as error:
        raise Crash(f"exit code {run.returncode}, and no record: {error}: {run.stderr.strip()[-2000:]}") from None
    return record


def write(path: Path, value: dict) -> None:
    """Writes a file as JSON completely or not at all, also if several programs write it at the same time."""
    unfinished = path.with_name(f".{path.name}.{uuid4().hex}")
    try:
        with unfinished.open("x") as file:
            json.dump(value, file, indent=2)
            file.flush()
            os.fsync(file.fileno())
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)


def run_parts(client: Client, parts: list[Part], out: Path, retries: int) -> int:
    """Runs parts and writes their records as they come. Returns how many failed."""
    futures = client.map(run_part, parts, retries=retries, pure=False)
    part_of = {future.key: part for future, part in zip(futures, parts, strict=True)}
    done = failed = 0
    for future in as_completed(futures):
        part = part_of[future.key]
        if future.status == "finished":
            done += 1
            record = future.result()
            write(out / f"{part.name}.json", record)
            found = record.get("disagreements", 0)
            note = f", {found} disagreements" if found else ""
        else:
            failed += 1
            error = future.exception()
            note = f" failed: {error}"
            (out / "failed").mkdir(exist_ok=True)
            write(out / "failed" / f"{part.name}.json", {**asdict(part), "error": str(error)})
        print(f"{done + failed} of {len(parts)} parts: {part.name}{note}", flush=True)
        future.release()
    return failed


def merge(program: str, out: Path, campaign: Campaign) -> int:
    """Adds the records in the folder up. Returns the exit code."""
    records = [out / f"{index}-of-{campaign.parts}.json" for index in range(1, campaign.parts + 1)]
    there = [str(path) for path in records if path.exists()]
    if not there:
        print(f"{out}: no part has a record", file=sys.stderr)
        return 2
    return subprocess.run([program, "merge", *there, "--json", str(out / "sum.json")], check=False).returncode


def version(program: str) -> str:
    """The version of the program, with its commit if it was built with one."""
    run = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise ValueError(f"{program} --version: exit code {run.returncode}: {run.stderr.strip()[-2000:]}")
    return run.stdout.strip().partition(" ")[2]


def at_least(least: int) -> Callable[[str], int]:
    """Reads a number of an option."""

    def read(text: str) -> int:
        if not text.isdecimal() or int(text) < least:
            raise argparse.ArgumentTypeError(f"{text!r}: expected a number from {least} on")
        return int(text)

    return read


def run_campaign(args: argparse.Namespace) -> int:
    """Runs what is missing of a campaign, and adds all up. Returns the exit code."""
    campaign, program = Campaign.load(args.campaign), version(args.program)
    args.output.mkdir(parents=True, exist_ok=True)
    all_parts = (
        Part(args.program, program, campaign.command, index, campaign.parts, args.threads)
        for index in range(1, campaign.parts + 1)
    )
    parts = [part for part in all_parts if not part.has_record(args.output / f"{part.name}.json")]
    if len(parts) < campaign.parts:
        print(f"{campaign.parts - len(parts)} of {campaign.parts} parts have a record already", flush=True)
    failed = 0
    if parts:
        # Workers run programs, so one task each at a time.
        cluster = args.scheduler or LocalCluster(n_workers=args.workers, threads_per_worker=1, dashboard_address=None)
        with Client(cluster) as client:
            failed = run_parts(client, parts, args.output, args.retries)
        if not args.scheduler:
            cluster.close()
    code = merge(args.program, args.output, campaign)
    return code if failed == 0 else 2


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaign", type=Path, help="the campaign file")
    parser.add_argument("-o", "--output", type=Path, required=True, help="the folder of the records")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="of a Dask cluster [default: one on this machine]")
    parser.add_argument("--workers", type=at_least(1), default=os.cpu_count(), help="of the cluster on this machine")
    parser.add_argument("--threads", type=at_least(1), default=1, help="of each part")
    parser.add_argument("--retries", type=at_least(0), default=2, help="after a crash of a part")
    parser.add_argument("--program", default="stackless", help="where workers find `stackless`")
    try:
        return run_campaign(parser.parse_args())
    except (OSError, ValueError) as error:
        # 1 would say that a check has found something.
        parser.exit(2, f"error: {error}\n")


if __name__ == "__main__":
    sys.exit(main())
