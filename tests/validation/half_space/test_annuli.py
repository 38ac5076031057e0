"""The half-space on annuli: contacts with closed forms, and the springs of which it is the judge."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr
from validation.cases import DEPTH, RADIUS, SHAPES
from validation.half_space.across import Point, on_annuli, on_cells
from validation.half_space.annuli import annuli, friction, pressure


@pytest.mark.parametrize("shape", SHAPES)
def test_the_force_under_a_shape(shape):
    """That of the library, in units of E* radius depth; to second order but for the infinite pressure of a punch."""
    known = float(SHAPES[shape].force(DEPTH, 1.0)) / (RADIUS * DEPTH)
    off = [annuli(n).area @ pressure(SHAPES[shape], RADIUS, DEPTH, n) / known - 1 for n in (16, 32)]
    assert abs(off[1]) < (2e-2 if shape == "flat punch" else 2e-3)
    assert abs(off[1]) < 0.6 * abs(off[0])


def test_a_pull_from_rest_is_cattaneo_and_mindlin():
    """1 - (1 - x)^(3/2) of mu_0 F_z under a paraboloid that is pulled by x of mu_0 kappa d."""
    p = pressure(SHAPES["paraboloid"], RADIUS, DEPTH, 48)
    for x in (0.3, 0.7):
        way = np.stack([x * np.array([0.0, 0.5, 1.0]), np.zeros(3)])
        end = friction(p, way, 1, 0.0, start=np.zeros((2, p.size, 1))).tractions
        force = np.sqrt(annuli(48).area) @ end[:, :, 0].T / (annuli(48).area @ p)
        assert_allclose(force, [1 - (1 - x) ** 1.5, 0], atol=2e-3)


def test_a_punch_is_one_spring():
    """Dragged aside on a leash: half of the tangent of the angle falls like exp(-way)."""
    p, way = pressure(SHAPES["flat punch"], RADIUS, DEPTH, 12), np.stack([np.zeros(65), np.linspace(0, 1, 65)])
    end = friction(p, way, 1, 0.0).tractions[:, :, 0] / (np.sqrt(annuli(12).area) * p)
    angle = np.pi / 2 - 2 * np.arctan(np.exp(-1))
    assert_allclose(end, np.outer([np.cos(angle), np.sin(angle)], np.ones(12)), atol=2e-4)


def test_cells_say_the_same():
    points = [Point("paraboloid", 0.0, 0.3, False, 1.0, 0.0, 0.0, v) for v in (0.8, 0.3)]
    for one, other in zip(on_cells(points, 17, 24), on_annuli(points, 20, 24), strict=True):
        assert one.springs == other.springs == pytest.approx(mdr.slide(one.point.case, one.point.v_0).cof / 0.3)
        assert abs(one.cof - other.cof) < one.error + other.error < 0.02
