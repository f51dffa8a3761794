"""The examples of the book run, one after the other, in the folder of the project."""

import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[3]


def test_examples_of_the_book_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, Any] = {}
    text = (ROOT / "docs/src/how-to/python.md").read_text(encoding="utf-8")
    examples = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(examples) == 4
    for example in examples:
        exec(compile(example, "python.md", "exec"), names)
    assert names["total"] > 100 and names["sight"][:, 0, 0].all()
