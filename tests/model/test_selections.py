"""Selections: later changes of the shape act on the selected points alone."""

import numpy as np

import reactive4d as r4


def bar() -> r4.Box:
    """A bar along z with points every quarter metre."""
    return r4.Box(size=(0.2, 0.2, 2), segments=(1, 1, 8))


def test_a_deformation_acts_on_what_is_selected_and_on_nothing_else():
    """F289: an XForm acts on all, or on the selected part."""
    obj = bar()
    still = obj.points.at(0.0)
    obj.apply(r4.Select(lower=(-1, -1, 0.1), upper=(1, 1, 2)))
    obj.apply(r4.XForm(offset=(0, 0, 1)))
    chosen = obj.selection.at(0.0)
    moved = obj.points.at(0.0)
    assert 0 < chosen.sum() < len(chosen)
    assert (chosen == (still[:, 2] > 0.1)).all()
    assert (moved[~chosen] == still[~chosen]).all()
    assert np.allclose(moved[chosen] - still[chosen], (0, 0, 1))


def test_a_bend_sees_the_selected_points_as_if_there_were_no_others():
    """The angle is over the extent of what is selected: the upper half alone becomes the whole arc."""
    whole, part = r4.Box(size=(0.2, 0.2, 1), segments=(1, 1, 4)), bar()
    whole.apply(r4.XForm(offset=(0, 0, 0.5)))
    whole.apply(r4.Bend(90, center=(0, 0, 0)))
    part.apply(r4.Select(lower=(-1, -1, -0.01), upper=(1, 1, 2)))
    part.apply(r4.Bend(90, center=(0, 0, 0)))
    assert np.allclose(part.bounds.at(0.0)[1], whole.bounds.at(0.0)[1], atol=1e-6)


def test_a_selection_may_follow_a_solid_that_moves():
    """The points inside of a ball are selected, wherever the ball is."""
    obj, ball = bar(), r4.Sphere(radius=0.3)
    ball.translate(r4.keys({0: (0, 0, -1), 2: (0, 0, 1)}))
    obj.apply(r4.Select(volume=ball))
    obj.apply(r4.XForm(offset=(1, 0, 0)))
    low, high = obj.points.at(0.0), obj.points.at(2.0)
    assert low[low[:, 0] > 0.5][:, 2].max() < -0.7
    assert high[high[:, 0] > 0.5][:, 2].min() > 0.7


def test_an_inverted_selection_selects_the_others():
    """What is selected and what is not make the whole."""
    one, other = bar(), bar()
    one.apply(r4.Select(upper=(1, 1, 0)))
    other.apply(r4.Select(upper=(1, 1, 0), is_inverted=True))
    assert (one.selection.at(0.0) ^ other.selection.at(0.0)).all()


def test_without_the_selection_all_points_are_deformed_again():
    """A selection is a change like others: disabled, it selects nothing out."""
    obj, plain = bar(), bar()
    select = obj.apply(r4.Select(upper=(1, 1, 0)))
    for each in (obj, plain):
        each.apply(r4.Twist(90))
    assert (obj.points.at(0.0) != plain.points.at(0.0)).any()
    select.enabled = False
    assert (obj.points.at(0.0) == plain.points.at(0.0)).all()
    assert obj.selection.at(0.0) is None


def test_control_points_can_be_deformed_instead_of_the_surface():
    """F015: deforming a patch may be switched to deforming its control points: inaccurate, but acceptable."""
    net = r4.Patch(segments=(32, 32))
    exact, rough = net.extend(), net.extend()
    for each in (exact, rough):
        each.translate((0, 0, 1))
        each.apply(r4.Bend(30, axis="x"))
    rough.deforms = "hull"
    near = np.abs(exact.points.at(0.0) - rough.points.at(0.0)).max()
    assert 1e-4 < near < 0.05
    assert len(rough.points.at(0.0)) == len(exact.points.at(0.0))
    assert rough.topology.at(0.0) is exact.topology.at(0.0)
