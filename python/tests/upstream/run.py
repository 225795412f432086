"""Runs the ray and proximity tests of trimesh's own released test-suite with the intersectors of trimesh and with ours.
Together with our intersector it tests our proximity functions.

    python tests/upstream/run.py [ARCHIVE]

pip downloads the source archive of the installed version, unless one is given. The archive has neither the models nor
`generic.py`, which the tests import: ours stands in for it, with made meshes. A test whose model cannot be made anew is
skipped. It prints a table, and fails if other tests fail with our intersector than those of DIFFERENCES.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

import trimesh

# Tests that fail with our intersector, and why that is right. One that passes is a failure of this script.
DIFFERENCES = {
    "test_embree_duplicate_hits": "one ray through a vertex of six faces: `intersects_id` tells all six, as trimesh's "
    "native one does; the test expects Embree's one of each side",
    "test_returns_correct_point_in_ambiguous_cases": "the point is nearer to face 0 by 1e-9; the test expects face 1, "
    "because trimesh takes the distances as equal",
}
FILES = ["test_ray.py", "test_ray_upstream.py", "test_proximity.py", "test_thickness.py"]
HERE = Path(__file__).parent


def main() -> int:
    with tempfile.TemporaryDirectory() as folder:
        archive = Path(sys.argv[1]) if len(sys.argv) > 1 else downloaded(Path(folder))
        tests = Path(folder) / "tests"
        tests.mkdir()
        with tarfile.open(archive) as tar:
            for name in FILES:
                member = f"trimesh-{trimesh.__version__}/tests/{name}"
                (tests / name).write_bytes(tar.extractfile(member).read())
        for name, become in [("generic.py", "generic.py"), ("engines.py", "conftest.py")]:
            (tests / become).write_bytes((HERE / name).read_bytes())
        engines = ["native", "embreex", "exact"] if has_embreex() else ["native", "exact"]
        outcomes = {engine: run(tests, engine) for engine in engines}
    print("| test |", " | ".join(engines), "|\n|---|" + "---|" * len(engines))
    for test in sorted(set().union(*outcomes.values())):
        print(f"| `{test}` |", " | ".join(outcomes[engine].get(test, "-") for engine in engines), "|")
    found = list(outcomes["exact"].values())
    print({outcome: found.count(outcome) for outcome in sorted(set(found))})
    failed = {test for test, outcome in outcomes["exact"].items() if outcome not in ("passed", "skipped")}
    # Without embreex this test does not look.
    expected = set(DIFFERENCES) - (set() if has_embreex() else {"test_embree_duplicate_hits"})
    return 0 if found.count("passed") > 20 and failed == expected else 1


def downloaded(folder: Path) -> Path:
    # Only the archive is wanted: nothing of it is built.
    version = f"trimesh=={trimesh.__version__}"
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check", "--no-deps"]
    subprocess.run([*pip, "--no-binary", ":all:", "--dest", folder, version], check=True)
    return next(folder.glob("trimesh-*.tar.gz"))


def has_embreex() -> bool:
    try:
        import embreex  # noqa: F401
    except ImportError:
        return False
    return True


def run(tests: Path, engine: str) -> dict[str, str]:
    """What becomes of each test with an intersector."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-rA", "--tb=line", "-q", *FILES]
    environment = {**os.environ, "INTERSECTOR": engine}
    ran = subprocess.run(command, cwd=tests, env=environment, capture_output=True, text=True)
    lines = re.findall(r"^(PASSED|FAILED|ERROR) test_\w+\.py::([\w:]+)", ran.stdout, re.MULTILINE)
    outcomes = {test.split("::")[-1]: outcome.lower() for outcome, test in lines}
    names = re.findall(r"^SKIPPED .*?(\w+) needs ", ran.stdout, re.MULTILINE)
    if not outcomes:
        sys.exit(ran.stdout + ran.stderr)
    if failed := [line for line in ran.stdout.splitlines() if "Error" in line]:
        print(engine, *failed, sep="\n  ", file=sys.stderr)
    return outcomes | dict.fromkeys(names, "skipped")


if __name__ == "__main__":
    sys.exit(main())
