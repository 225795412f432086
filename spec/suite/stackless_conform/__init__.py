"""The small runner of the conformance suite: Python 3.8 or newer, standard library only."""

import pathlib

HERE = pathlib.Path(__file__).resolve().parent
# In a wheel the suite is in the package; in the repository the package is in the suite.
SUITE = HERE / "suite" if (HERE / "suite").is_dir() else HERE.parent
VERSION = (SUITE / "VERSION").read_text(encoding="utf-8").strip()
