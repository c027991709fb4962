"""The notebooks run as they stand, and each is the same program as its pair."""

import ast
from pathlib import Path
from typing import Any

import jupytext
import nbformat
import pytest
from nbclient import NotebookClient

ROOT = Path(__file__).parents[2]
NOTEBOOKS = ROOT / "notebooks"
EXAMPLES = ROOT / "tests" / "examples"
PAIRS = sorted(NOTEBOOKS.glob("*.ipynb"))
# The program of which each notebook is made.
PROGRAMS = {
    "01_first_scene": "ex01_static_scene",
    "02_keys": "ex02_keyframes",
    "03_expressions": "ex03_expression",
    "04_a_camera_that_follows": "ex04_tracking_camera",
    "05_prototypes": "ex05_rivets",
    "06_changes": "ex06_modifier_stack",
    "07_solids": "ex07_csg",
    "08_an_illustration": "ex10_illustration",
    "09_a_sweep": "ex12_sweep",
}


def cells(notebook: Any) -> list[tuple[str, str]]:
    """What stands in a notebook: the kinds of its cells and their texts."""
    return [(cell.cell_type, cell.source) for cell in notebook.cells]


def read(path: Path) -> Any:
    """A notebook, or a program as one."""
    if path.suffix == ".py":
        return jupytext.read(path, fmt="py:percent")
    return nbformat.read(path, as_version=4)


def test_every_program_that_can_run_is_a_notebook():
    """And every notebook is one of them."""
    assert [path.stem for path in PAIRS] == sorted(PROGRAMS)
    assert sorted(PROGRAMS.values()) == sorted(path.stem for path in EXAMPLES.glob("ex*.py"))


@pytest.mark.parametrize("path", PAIRS, ids=lambda path: path.stem)
def test_a_notebook_and_its_program_are_one(path: Path):
    """Cell by cell, and nothing that a run left."""
    notebook = read(path)
    assert cells(notebook) == cells(read(path.with_suffix(".py")))
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert cell.outputs == []
            assert cell.execution_count is None


@pytest.mark.parametrize("path", PAIRS, ids=lambda path: path.stem)
def test_a_notebook_says_what_its_program_says(path: Path):
    """Every statement of the program stands in it, as it is there."""
    known = {ast.unparse(node) for _, text in cells(read(path)) for node in _body(text)}
    program = (EXAMPLES / f"{PROGRAMS[path.stem]}.py").read_text(encoding="utf-8")
    wanted = [node for node in _body(program) if not isinstance(node, ast.ImportFrom)]
    missing = [ast.unparse(node) for node in wanted if ast.unparse(node) not in known]
    assert [text for text in missing if not text.startswith(("'", '"'))] == []


def _body(text: str) -> list[ast.stmt]:
    try:
        return ast.parse(text).body
    except SyntaxError:
        return []  # prose


@pytest.mark.parametrize("path", PAIRS, ids=lambda path: path.stem)
def test_a_notebook_runs(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """From top to bottom, in a kernel of its own; a figure leaves a picture for those who have no kernel."""
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    monkeypatch.setenv("JUPYTER_ALLOW_INSECURE_WRITES", "1")
    notebook = read(path)
    client = NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    )
    client.execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert [output for output in outputs if output.output_type == "error"] == []
    shown = [output.data for output in outputs if "data" in output]
    if any(".show()" in text or text == "Pendulum(length=1.5)" for _, text in cells(notebook)):
        assert any("application/vnd.jupyter.widget-view+json" in data for data in shown)
