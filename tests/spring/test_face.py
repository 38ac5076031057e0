"""A face with a shear strength: its limit as the force of a spring that is compressed by more."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rows import MATERIALS, nodes_of, tools_for

from mdr.spring.face import face_later, raise_to_limit, strength, strengths
from mdr.spring.law import law_of
from mdr.spring.motion import hold
from mdr.spring.path import Face
from mdr.spring.times import STEP
from mdr.tools.jit import compiled

FACE, H = Face(0.3, 1.2, -0.4, 0.7), 0.2


@compiled(error_model="numpy")
def held_at_the_limit(s, z_1, z_2, face, x2, h, T, modes, arms, tools):
    """Area and moment of L[q] over a step, and q at its end."""
    q_1, q_2 = raise_to_limit(s, 0, (z_1, z_2), strengths(face, x2, 0.0, h), h, face.coulomb, T, arms)
    return hold(s, 0, q_1, q_2, h, STEP, T, tools, arms)


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
def test_the_force_of_the_raised_spring_is_the_limit(material):
    """coulomb L[s] and the parabola through three values of the root, whatever the material remembers."""
    law, x2 = law_of(*material), 0.5
    s = np.full((1 + len(material[1]), 1), 0.2)
    s[0] = 0.8
    tools, plain = tools_for(law, H), s.copy()
    area, moment = held_at_the_limit(s, 0.1, -0.3, FACE, x2, H, *law, tools)
    A, B = held_at_the_limit(plain, 0.1, -0.3, Face(1.0, 0.0, 0.0, 0.0), x2, H, *law, tools)  # s alone
    c = [strength.py_func(FACE, x2, t) for t in (0.0, H / 2, H)]
    u = nodes_of(H, None, None)
    on_parabola = np.polynomial.polynomial.polyval(u.u, np.linalg.solve(np.vander([0.0, H / 2, H], increasing=True), c))
    # of an arm of the time 50 a third order in h is left, a share h/50
    near = 1e-12 if 50.0 not in material[2] else 1e-5
    assert_allclose(area, 0.3 * A + u.weight @ on_parabola, rtol=near)
    assert_allclose(moment, 0.3 * B + u.weight @ (u.u * on_parabola), rtol=near)


def test_no_strength_beyond_the_edge_and_none_without_a_face():
    assert strength.py_func(FACE, 2.0, 0.0) == 0.0
    assert face_later.py_func(None, 0.1) is None
    later = face_later.py_func(FACE, 0.1)
    assert_allclose(strength.py_func(later, 0.5, 0.05), strength.py_func(FACE, 0.5, 0.15), rtol=1e-15)
