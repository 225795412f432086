"""The dashboard: red cells link to their first failure, and text of an adapter is never markup."""

import html.parser
import sys

import pytest
from test_schema import SUITE

sys.path.insert(0, str(SUITE))
import dashboard  # noqa: E402


def case(id, outcome, **more):
    what = {} if outcome in ("pass", "not-asked") else {"what": f"what of {id}"}
    return {
        "id": id,
        "clauses": ["KEY-1"],
        "strength": "must",
        "why": f"why of {id}",
        "outcome": outcome,
        **what,
        **more,
    }


def report(name, *cases):
    return {
        "suite": "1.4.0",
        "implementation": {"name": name, "profiles": []},
        "conforms": False,
        "faults": [],
        "cases": cases,
    }


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.cells, self.ids, self.tags, self.words = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        if tag == "td":
            self.cells.append([attributes.get("class"), None])
        if tag == "a":
            self.cells[-1][1] = attributes["href"]
        if "id" in attributes:
            self.ids.append(attributes["id"])

    def handle_data(self, data):
        self.words.append(data)


def test_cells_lead_to_first_failures():
    one = report("one", case("ray/grid/a", "pass"), case("ray/grid/b", "fail"), case("ray/grid/c", "crash"))
    two = report("two", case("ray/grid/a", "pass"), case("key/u32/a", "pass"), case("ray/exact/a", "not-asked"))
    more = case("ray/grid/a", "fail", strength="may")
    page = Page(dashboard.page([one, two, report("three", more, case("key/u32/a", "error"))]))
    # A table for rays with all three reports, and one for keys without the first.
    assert page.cells == [
        ["fail", "#0-ray-grid"],
        ["pass", None],
        ["pass", None],
        ["pass", None],
        ["fail", "#2-key-u32"],
    ]
    assert page.ids == ["0-ray-grid", "2-key-u32"]
    text = "".join(page.words)
    assert "what of ray/grid/b" in text and "what of ray/grid/c" not in text


@pytest.mark.parametrize("evil", ["<script>alert(1)</script>", '"><img src=x onerror=alert(1)>', "&lt;b&gt;", "</dl>"])
def test_what_others_say_is_text(evil):
    page = Page(dashboard.page([report(evil, case("ray/grid/a", "fail", what=evil, why=evil))]))
    assert not {"script", "img", "b"} & set(page.tags)
    assert "".join(page.words).count(evil) == 4


def test_the_page_of_peers_is_of_this_version():
    """`tests/suite/peers.sh` writes it."""
    page = (SUITE / "peers.html").read_text()
    assert f"version {(SUITE / 'VERSION').read_text().strip()} of the suite" in page
