"""The version and its date are the same in pyproject.toml, CITATION.cff and CHANGELOG.md."""

import re
import tomllib

from bench.base.provenance import ROOT


def test_release_is_the_same_everywhere():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    cited = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    date = re.search(r'^date-released: "(\d{4}-\d\d-\d\d)"$', cited, re.MULTILINE)[1]
    newest = re.search(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)[1]
    assert f"\nversion: {version}\n" in cited
    assert newest == f"[{version}] - {date}"
