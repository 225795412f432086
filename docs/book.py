"""Links of the book that lead out of it, into the repository: their targets must be there, and are shown where it is published."""

import os
import pathlib
import re

from mkdocs.exceptions import PluginError

ROOT = pathlib.Path(__file__).resolve().parents[1]
# `[text](../path)` and `![text](../path)`, as the texts of docs/ write them.
OUT = re.compile(r"(!?)\[([^\]]*)\]\(\.\./([^)#\s]*)(#[^)\s]*)?\)")
# Where files of the repository can be read; without it they are named and not linked.
SOURCE = os.environ.get("BOOK_SOURCE", "").rstrip("/")


def on_page_markdown(markdown, page, config, files):
    def resolved(link):
        is_image, text, path, anchor = link[1], link[2], link[3], link[4] or ""
        target = ROOT / path
        if not target.exists():
            raise PluginError(f"{page.file.src_path}: {link[0]}: there is no {path}")
        if anchor and anchor[1:] not in anchors(target):
            raise PluginError(f"{page.file.src_path}: {link[0]}: {path} has no such heading")
        if is_image:
            return f"![{text}](pictures/{target.name})"
        return f"[{text}]({SOURCE}/{path}{anchor})" if SOURCE else f"{text} (`{path}`)"

    return OUT.sub(resolved, markdown)


def anchors(path):
    """The anchors of a text's headings."""
    headings = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}
