"""Random trees of signals: what is lowered says the same as the signal, at any time."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

import reactive4d as r4
from reactive4d_widgets.lowering import lower

A = r4.Parameter("amount", 0.5)
KEYS = r4.keys({0: 0.0, 1: 2.0, 3: -1.0}, ease="in_out")
CYCLE = r4.keys({0: 0.5, 1.5: 2.0, 2: 1.0}, interpolation="catmull_rom", after="cycle", before="oscillate")
STEPS = r4.keys({-1: 1.0, 0.5: 3.0, 2: 2.0}, interpolation="step")
VECTOR = r4.keys({0: (1, 2, 3), 2: (0, -1, 1)}, after="cycle_offset")

numbers = st.sampled_from([-2.0, -1.0, -0.25, 0.0, 0.5, 1.0, 3.0])
leaves = st.sampled_from([r4.time, A, KEYS, CYCLE, STEPS, VECTOR[0], VECTOR[2]])


def grown(live: st.SearchStrategy) -> st.SearchStrategy:
    """Something made of these parts, and of numbers."""
    parts = st.one_of(live, numbers)
    one = st.sampled_from([np.sin, np.cos, np.tanh, np.abs, np.floor, np.negative, np.square, np.arctan, np.sign])
    two = st.sampled_from([np.add, np.subtract, np.multiply, np.minimum, np.maximum, np.hypot, np.arctan2])
    return st.one_of(
        st.builds(lambda f, a: f(a), one, live),
        st.builds(lambda f, a, b: f(a, b), two, live, parts),
        st.builds(lambda a, b, c: r4.where(a < b, b, c), live, parts, live),
        st.builds(lambda a, b: r4.vec(a, b, 1.0)[0], live, parts),
        st.builds(lambda a, b: r4.vec(a, b)[1] + 0.5, live, live),
        st.builds(lambda a: np.linalg.norm(r4.vec(a, 1.0, 2.0)), live),
        st.builds(lambda a, s: a.delay(s), live, numbers),
        st.builds(lambda a, s: a.stretch(s or 2.0, about=0.5), live, numbers),
        st.builds(lambda a, b: a.delay(b), live, live),
        st.builds(lambda a: a.reverse(0.0, 2.0), live),
        st.builds(lambda a, p: a.repeat(abs(p) or 1.5, start=-0.5), live, numbers),
        st.builds(lambda a: a.hold(0.25, 1.75), live),
        st.builds(lambda a, b: a.warp(np.tanh(b)), live, live),
        st.builds(lambda a, b: r4.keys({0: a, 1: b, 2.5: 1.0}), live, parts),
        st.builds(lambda a: r4.Variable(a) * 2, live),
        st.builds(lambda a, c: a / (c + 4.0), live, numbers),
    )


trees = st.recursive(leaves, grown, max_leaves=12)
times = st.lists(
    st.one_of(st.floats(-6, 6), st.sampled_from([0.0, 0.5, 1.0, 1.5, 2.0, 3.0, -1.0, 0.25, 1.75])),
    min_size=1,
    max_size=8,
)


@given(tree=trees, times=times, amount=numbers)
def test_random_trees_agree(agree, tree, times, amount):
    """Where an answer jumps just there, rounding may decide; such times are not asked."""
    track = lower(tree)
    assume(track is not None)  # it may be too deep: nothing else in these trees is opaque
    steady = []
    for t in times:
        values = [tree.at(t + d, amount=amount) for d in (-1e-9, 0.0, 1e-9)]
        if np.isfinite(values).all() and np.ptp(values) <= 1e-5 * (1.0 + np.abs(values).max()):
            steady.append(t)
    agree(tree, steady, tolerance=1e-7, amount=amount)


@given(tree=trees, times=times)
def test_fixing_the_parameters_changes_nothing(agree, tree, times):
    """A parameter that counts as a constant is not read any more."""
    track = lower(tree, {"amount": -0.25})
    assume(track is not None)
    assert '"param"' not in str(track).replace("'", '"')


def test_a_tree_that_is_too_large_is_not_lowered():
    """Above 10,000 nodes, shared parts counted as often as they are used."""
    signal = r4.time * 1.5
    for _ in range(10):
        signal = np.sin(signal) + np.cos(signal)
    assert lower(signal) is not None
    for _ in range(4):
        signal = np.sin(signal) + np.cos(signal)
    assert lower(signal) is None


def test_a_tree_that_is_too_deep_is_not_lowered():
    """Below 64 levels."""
    signal = r4.time
    for _ in range(50):
        signal = np.sin(signal)
    assert lower(signal) is not None
    for _ in range(20):
        signal = np.sin(signal)
    assert lower(signal) is None
    for _ in range(5000):
        signal = np.sin(signal)
    assert lower(signal) is None
