"""Fitting matrices that can only be asked: as a translation, a rotation and a symmetric stretch, each for itself."""

from typing import Any

import numpy as np

from reactive4d_widgets.lowering.fits import Breaks, Fitted, Pieces, Sample, fitted_cubics
from reactive4d_widgets.lowering.measures import Numbers, Turns
from reactive4d_widgets.lowering.numerals import Array
from reactive4d_widgets.lowering.polar import parts_of
from reactive4d_widgets.lowering.terms import NotExactError

__all__ = ["PRECISE", "SMALLEST", "TURN", "fit_matrix"]

PRECISE = 1e-4
TURN = 1e-3  # radians
SMALLEST = 1e-6  # metres: nothing is seen of a scene that is smaller


def fit_matrix(sample: Sample, start: float, stop: float, *, size: float, breaks: Breaks = ()) -> Fitted | None:
    """Matrices that can only be asked, as a product of one factor: translation, rotation and symmetric stretch.

    Args:
        sample: answers at times (n,): (n, 4, 4).
        start: of the time, seconds.
        stop: of the time, itself included.
        size: of the scene, metres: a ten-thousandth of it is how far a translation may be off.
        breaks: as of `fit`.

    Returns:
        None where it is too rough.
    """
    source = _Matrices(sample)
    found: dict[str, Pieces] = {}
    for name, measure in _measures(size):
        pieces = fitted_cubics(source.part(name), start, stop, measure=measure, breaks=breaks)
        if pieces is None:
            return None
        found[name] = pieces
    fitted = {name: found[name].track(measure.tolerance) for name, measure in _measures(size)}
    factor = _trs({name: one.track for name, one in fitted.items()})
    return Fitted(
        {"kind": "product", "factors": [factor]},
        max(one.error for one in fitted.values()),
        len(source.known),
        max(one.pieces for one in fitted.values()),
    )


def _measures(size: float) -> list[tuple[str, Numbers | Turns]]:
    measures = (Numbers(PRECISE * max(size, SMALLEST)), Turns(TURN), Numbers(PRECISE))
    return list(zip(("translation", "rotation", "stretch"), measures, strict=True))


def _trs(tracks: dict[str, Any]) -> dict[str, Any]:
    stretch = tracks["stretch"]
    is_rigid = stretch["kind"] == "const" and np.allclose(stretch["value"], (1, 0, 0, 1, 0, 1), rtol=0.0, atol=1e-9)
    return {"op": "trs", **tracks, "stretch": None if is_rigid else stretch}


class _Matrices:
    """Matrices that were asked, and their parts: each time is asked once for all three."""

    def __init__(self, sample: Sample) -> None:
        self.sample = sample
        self.known: dict[float, Any] = {}

    def part(self, name: str) -> Sample:
        """One of the parts as samples."""

        def sample(times: Array) -> Any:
            new = [t for t in times.tolist() if t not in self.known]
            if new:
                matrices = np.asarray(self.sample(np.array(new)), dtype=np.float64)
                if matrices.shape[1:] != (4, 4) or not np.isfinite(matrices).all():
                    raise NotExactError("matrices that are not finite, or none")
                parts = parts_of(matrices)
                stretch = np.where(np.abs(parts.stretch - _UNSTRETCHED) < 1e-9, _UNSTRETCHED, parts.stretch)
                for t, *row in zip(new, parts.translation, parts.rotation, stretch, strict=True):
                    self.known[t] = dict(zip(("translation", "rotation", "stretch"), row, strict=True))
            return np.array([self.known[t][name] for t in times.tolist()])

        return sample


_UNSTRETCHED: Array = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 1.0])
