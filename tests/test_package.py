"""The package as a whole: what importing it loads, what it shows, its command line, and the programs of its pages."""

import ast
import doctest
import importlib.metadata
import inspect
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import reactive4d
import reactive4d_apps
import reactive4d_widgets
from reactive4d_apps.__main__ import main

ROOT = Path(__file__).parent.parent
PACKAGES = [Path(package.__file__ or "").parent for package in (reactive4d, reactive4d_apps, reactive4d_widgets)]
MODULES = sorted(path for package in PACKAGES for path in package.rglob("*.py"))
HEAVY = {"vtk", "vtkmodules", "pyvista", "trame", "trimesh", "scipy", "ipywidgets", "anywidget"}
# The programs of decisions are evidence of their day, and may need more than the tests do.
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def short(path: Path) -> str:
    """The name of a module or page in a test's id: from the package or folder downwards."""
    return path.relative_to(next((p.parent for p in PACKAGES if p in path.parents), ROOT)).as_posix()


def python(*arguments: str, cwd: Path | None = None, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run this interpreter in a process of its own, warnings being errors."""
    return subprocess.run(
        [sys.executable, "-W", "error", *arguments],
        cwd=cwd,
        capture_output=True,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "utf-8", **environment},
        stdin=subprocess.DEVNULL,
        check=False,
    )


def loaded(program: str) -> set[str]:
    """The top-level modules that a program leaves loaded."""
    code = f"{program}\nimport json, sys\nprint(json.dumps([name.partition('.')[0] for name in sys.modules]))"
    run = python("-c", code)
    assert run.returncode == 0, run.stderr
    return set(json.loads(run.stdout))


def test_importing_the_core_loads_nothing_heavy():
    """Importing reactive4d loads none of the heavy libraries: of those of others, NumPy and param at most."""
    new = loaded("import reactive4d") - loaded("")

    assert not new & HEAVY
    foreign = {name for name in new - sys.stdlib_module_names if "cython" not in name}  # what NumPy is compiled with
    assert foreign <= {"reactive4d", "numpy", "param"}


def test_importing_the_outer_packages_loads_nothing_heavy():
    """Importing the packages of widgets and apps alone loads no screen and no server either."""
    assert not loaded("import reactive4d_apps.__main__, reactive4d_widgets") & HEAVY


def test_the_public_surface_is_complete():
    """What `reactive4d.__all__` lists exists, and what is public and no module is listed, once."""
    listed = reactive4d.__all__
    public = {name for name, value in vars(reactive4d).items() if not (name.startswith("_") or inspect.ismodule(value))}

    assert len(listed) == len(set(listed))
    assert public <= set(listed)
    assert [name for name in listed if not hasattr(reactive4d, name)] == []


def test_the_public_surface_is_sorted():
    """`reactive4d.__all__` stands in order: constants, then classes, then the rest, each by name."""

    def order(name: str) -> tuple[int, str]:
        return (0 if name.isupper() else 1 if name[0].isupper() else 2), name

    assert list(reactive4d.__all__) == sorted(reactive4d.__all__, key=order)


@pytest.mark.parametrize("name", reactive4d.__all__)
def test_a_public_name_says_what_it_is(name: str):
    """Every public class and function has a docstring of its own."""
    value: Any = getattr(reactive4d, name)
    if inspect.isclass(value) or inspect.isroutine(value):
        assert (value.__doc__ or "").strip()


@pytest.mark.parametrize("name", reactive4d.__all__)
def test_a_public_call_takes_at_most_three_arguments_by_position(name: str):
    """Beyond the third, the arguments of public functions, classes and their methods are keyword-only."""
    value: Any = getattr(reactive4d, name)
    if inspect.isclass(value):
        members = {key: member for key, member in vars(value).items() if not key.startswith("_")}
        calls = [value.__init__, *filter(inspect.isfunction, members.values())]
    else:
        calls = [value] if inspect.isfunction(value) else []
    for call in calls:
        parameters = list(inspect.signature(call).parameters.values())
        if parameters and parameters[0].name == "self":
            parameters = parameters[1:]
        placed = [p.name for p in parameters if p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD)]
        assert len(placed) <= 3, f"{name}: {call.__name__}({', '.join(placed)})"


def test_the_version_is_that_of_the_installed_package():
    """The metadata, the command line and, where the package tells it, the package agree."""
    version = importlib.metadata.version("reactive4d")

    assert getattr(reactive4d, "__version__", version) == version
    assert python("-m", "reactive4d", "--version").stdout == f"reactive4d {version}\n"


@pytest.mark.parametrize("path", MODULES, ids=short)
def test_a_module_tells_its_idea(path: Path):
    """Every module opens with a docstring."""
    assert ast.get_docstring(ast.parse(path.read_text(encoding="utf-8")))


@pytest.mark.parametrize("path", MODULES, ids=short)
def test_a_module_has_a_name_of_its_own(path: Path):
    """No module or package is named like one of the standard library."""
    own = path.relative_to(next(p for p in PACKAGES if p in path.parents)).with_suffix("").parts
    assert {name for name in own if not name.startswith("__")}.isdisjoint(sys.stdlib_module_names)


@pytest.mark.parametrize("path", [path for path in MODULES if "engine" in path.parts], ids=short)
def test_the_engine_stands_on_the_standard_library(path: Path):
    """A module of the engine imports the standard library, the engine, the errors and the intervals; nothing else."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, "relative imports hide the layer"
            names.add(node.module or "")
    ours = {name for name in names if name.partition(".")[0] == "reactive4d"}

    assert {name.partition(".")[0] for name in names - ours} <= sys.stdlib_module_names
    assert {".".join(name.split(".")[:2]) for name in ours} <= {
        "reactive4d.engine",
        "reactive4d.errors",
        "reactive4d.intervals",
    }


def test_the_command_is_installed():
    """The console command `reactive4d` is the function that these tests call."""
    (entry,) = importlib.metadata.entry_points(group="console_scripts", name="reactive4d")
    assert entry.load() is main


def blocks(path: Path, language: str) -> list[tuple[str, str | None]]:
    """The fenced programs of a page, each with the fenced text that follows at once, if there is one."""
    fence = rf"^```{language}\n(.*?)^```$(?:\n\n?(?:[^\n`]+:\n\n)?^```text\n(.*?)^```$)?"
    return re.findall(fence, path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("path", [page for page in PAGES if blocks(page, "python")], ids=short)
def test_the_programs_of_a_page_print_what_the_page_says(path: Path, tmp_path: Path):
    """Each program of a page runs by itself, and prints the text that stands below it."""
    for program, text in blocks(path, "python"):
        run = python("-c", program, cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        if text:
            assert run.stdout == text


@pytest.mark.parametrize("path", [page for page in PAGES if blocks(page, "pycon")], ids=short)
def test_the_examples_of_a_page_answer_what_the_page_says(path: Path):
    """The examples of a page, typed one after the other, answer as they do on the page."""
    text = "\n".join(program for program, _ in blocks(path, "pycon"))
    test = doctest.DocTestParser().get_doctest(text, {}, path.name, str(path), 0)
    report: list[str] = []
    result = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE).run(
        test, out=report.append
    )

    assert result.failed == 0, "".join(report)


@pytest.mark.parametrize("name", [name for name in reactive4d.__all__ if name != "FOREVER"])
def test_a_public_name_has_an_example(name: str):
    """What one reads about a public name shows how it is used; all examples are run as tests."""
    assert ">>>" in (inspect.getdoc(getattr(reactive4d, name)) or "")
