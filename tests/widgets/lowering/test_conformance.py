"""The conformance vectors: what is committed is what is generated, and it covers all that travels."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from reactive4d_widgets import conformance
from reactive4d_widgets.lowering import calculating, factors, play, playing
from reactive4d_widgets.lowering.numerals import array_of

FILE = Path(__file__).parents[3] / "widgets" / "js" / "test" / "fixtures" / "conformance.json"
COMMITTED = json.loads(FILE.read_text(encoding="utf-8"))
GENERATED = json.loads(json.dumps(conformance.vectors(), allow_nan=False))
AGAIN = "run python -m reactive4d_widgets.conformance widgets/js/test/fixtures/conformance.json"


def inside(x):
    """All dictionaries and lists within something."""
    yield x
    for part in x.values() if isinstance(x, dict) else x if isinstance(x, list) else ():
        yield from inside(part)


def close(a, b):
    """Whether two parts of vectors are the same but for rounding, on whatever machine they were made."""
    if isinstance(a, dict) and isinstance(b, dict) and not {"f64", "f32"} & (a.keys() | b.keys()):
        return a.keys() == b.keys() and all(close(a[key], b[key]) for key in a)
    if isinstance(a, dict) or isinstance(b, dict):
        one, other = array_of(a), array_of(b)
        return one.shape == other.shape and np.allclose(one, other, rtol=1e-5, atol=1e-5)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(close, a, b))
    if isinstance(a, float) and isinstance(b, float | int):
        return a == b or math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-5)
    return a == b


def test_the_committed_vectors_are_the_generated_ones():
    """Whoever changes what travels writes them again."""
    for group in ("tracks", "matrices"):
        names = [entry["name"] for entry in COMMITTED[group]]
        assert names == [entry["name"] for entry in GENERATED[group]], AGAIN
        assert len(set(names)) == len(names)
        for a, b in zip(COMMITTED[group], GENERATED[group], strict=True):
            assert close(a, b), f"{a['name']}: {AGAIN}"


@pytest.mark.parametrize("group", ["tracks", "matrices"])
def test_the_reference_meets_what_is_committed(group):
    """On this machine as on the one on which it was written."""
    words = {"inf": math.inf, "-inf": -math.inf, "nan": math.nan}
    for entry in COMMITTED[group]:
        for point in entry["points"]:
            found = play(entry["track"], point["t"], point["parameters"])
            value = point["value"]
            if isinstance(value, str) and value not in words:
                assert found == value
                continue
            if value is None or value == []:
                assert found == value
                continue
            expected = [words.get(x, x) for x in value] if isinstance(value, list) else words.get(value, value)
            tolerance = 0.0 if point["exact"] else 1e-9 if group == "tracks" else 1e-6
            a, b = np.asarray(expected, dtype=np.float64), np.asarray(found, dtype=np.float64)
            with np.errstate(invalid="ignore"):
                near = np.abs(a - b) <= tolerance * np.maximum(1.0, np.abs(a))
            assert (near | (a == b) | (np.isnan(a) & np.isnan(b))).all(), f"{entry['name']} at {point['t']!r}"


def test_every_kind_operator_and_factor_is_there():
    """At least 150 tracks, and each key met exactly."""
    parts = list(inside(COMMITTED))
    kinds = {x["kind"] for x in parts if isinstance(x, dict) and "kind" in x}
    operators = {x[0] for x in parts if isinstance(x, list) and x and isinstance(x[0], str)}
    operations = {x["op"] for x in parts if isinstance(x, dict) and "op" in x}
    known = {name for table in (calculating.NUMERIC, calculating.LOGICAL) for name in table}

    assert len(COMMITTED["tracks"]) >= 150
    assert kinds == set(playing.KINDS)
    assert operators >= known | {"time", "param", "track", "at"}
    assert operations == set(factors.OPERATIONS)
    exact = [point for entry in COMMITTED["tracks"] for point in entry["points"] if point["exact"]]
    assert len(exact) >= 500


def test_writing_is_repeatable(tmp_path):
    """The same bytes on one machine."""
    paths = [tmp_path / "a.json", tmp_path / "b.json"]
    for path in paths:
        conformance.write(path)

    assert paths[0].read_bytes() == paths[1].read_bytes()
    assert json.loads(paths[0].read_text(encoding="utf-8")) == GENERATED
    assert len(paths[0].read_bytes()) < 1_000_000
