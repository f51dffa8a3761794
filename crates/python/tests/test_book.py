"""The examples of README and book run, one after the other, in the folder of the project."""

import re
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[3]


def examples(page: str) -> list[str]:
    return re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)


def run(page: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    for example in examples(page):
        exec(compile(example, page, "exec"), names)
    return names


def test_examples_of_the_book_run(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "maps").symlink_to(ROOT / "maps")
    monkeypatch.chdir(tmp_path)
    pytest.importorskip("pandas")
    page = "docs/src/how-to/python.md"
    assert len(examples(page)) == 8
    names = run(page)
    assert names["total"] > 100 and names["sight"][:, 0, 0].all()


def test_the_example_of_sweeps_runs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    pytest.importorskip("pandas")
    assert len(examples("docs/src/how-to/sweep.md")) == 1
    assert len(run("docs/src/how-to/sweep.md")["swept"].runs()) == 10


def test_examples_of_learning_run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(ROOT)
    pytest.importorskip("gymnasium")
    assert len(examples("docs/src/how-to/learn.md")) == 3
    names = run("docs/src/how-to/learn.md")
    assert names["observations"].shape == (64, 78)
    assert "lanelets" in capsys.readouterr().out


def test_the_eight_lines_of_the_readme_run(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (example,) = examples("README.md")
    assert len(example.split("\n\n")[0].splitlines() + example.split("\n\n")[1].splitlines()) == 8
    run("README.md")
    assert "lane changes" in capsys.readouterr().out and (tmp_path / "traffic.png").stat().st_size > 2_000
