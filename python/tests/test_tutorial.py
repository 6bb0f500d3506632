"""The tutorial of the book does what it says."""

import re
from pathlib import Path


def test_the_tutorial_runs_from_top_to_bottom(capsys):
    text = (Path(__file__).parent / "python.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, flags=re.DOTALL)
    assert len(blocks) >= 5
    names: dict = {}
    for block in blocks:
        exec(compile(block, "python.md", "exec"), names)  # the reader's own words
    printed = capsys.readouterr().out
    assert "velocity_l2" in printed and "must be" in printed
    assert 0.004 < names["depth"] < 0.1
    assert all("newtonian" in variant for variant in names["r"].runs["variant"])
    assert (names["residuals"]["value"] > 0).all() and len(names["residuals"]) == len(names["r"].runs) > 0
