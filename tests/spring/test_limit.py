"""The limit of friction as the force of a state q: of Coulomb's friction, and with a shear strength."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rows import MATERIALS, Row, for_python, nodes_of, row, tools_for

from mdr.spring import limit as of
from mdr.spring.contact import Springs
from mdr.spring.law import law_of
from mdr.spring.limit import Pressing, Strength
from mdr.spring.motion import hold
from mdr.spring.path import LENT, Path
from mdr.spring.times import STEP
from mdr.tools.jit import inner

H, COULOMB = 0.2, 0.3
STRENGTH = Strength(COULOMB, np.array([0.5, 2.0]), 1.2, -0.4, 0.7)


@inner(error_model="numpy", **LENT)
def held(limit, s, e, pressing, T, modes, arms, tools):
    """Area and moment of L[q] over a step, and q at its end."""
    q, of_q, _ = of.at_limit(limit, s, e, 0, pressing, T, arms, tools)
    return hold(q, 0, of_q.z[0], of_q.z[1], of_q.t, STEP, T, tools, arms)


held_at_the_limit = for_python(held)


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)
def test_the_force_of_q_is_the_limit(material):
    """coulomb L[s] and the parabola through three values of the root, whatever the material remembers; s goes on."""
    law = law_of(*material)
    s = np.full((1 + len(material[1]), 2), 0.2)
    s[0] = 0.8
    tools, plain, e = tools_for(law, H, 2), s.copy(), np.zeros_like(s)
    pressing = Pressing((0.1, -0.3), (0.0, 0.0), H, STEP, 0.0, 0.0, (0.0, 0.0))
    area, moment = held_at_the_limit(STRENGTH, s, e, pressing, *law, tools)
    A, B = held_at_the_limit(None, plain, e, pressing, *law, tools)  # q is s
    assert_allclose(s, plain, rtol=0)
    assert s[0, 0] != s[0, 1]
    c = [of.strength.py_func(STRENGTH, 0, t) for t in (0.0, H / 2, H)]
    u = nodes_of(H, None, None)
    on_parabola = np.polynomial.polynomial.polyval(u.u, np.linalg.solve(np.vander([0.0, H / 2, H], increasing=True), c))
    # of an arm of the time 50 a third order in h is left, a share h/50
    near = 1e-12 if 50.0 not in material[2] else 1e-5
    assert_allclose(area, COULOMB * A + u.weight @ on_parabola, rtol=near)
    assert_allclose(moment, COULOMB * B + u.weight @ (u.u * on_parabola), rtol=near)


def test_no_strength_beyond_the_edge_and_none_of_coulomb():
    assert of.strength.py_func(STRENGTH, 1, 0.0) == 0.0
    assert of.limit_later.py_func(None, 0.1) is None
    assert of.limit_at.py_func(None, 0, 0.7, 0.1) == 0.7
    later = of.limit_later.py_func(STRENGTH, 0.1)
    assert_allclose(of.strength.py_func(later, 0, 0.05), of.strength.py_func(STRENGTH, 0, 0.15), rtol=1e-15)


@pytest.mark.parametrize("material", ["elastic", "Kelvin", "arm and dashpot"])
def test_a_strength_that_adds_nothing_is_coulomb(material):
    """The same steps as without it, which take another way: springs that do one thing for all of a step go first."""
    rng, law = np.random.default_rng(8), law_of(*MATERIALS[material])
    one = Row.draw(rng, MATERIALS[material])
    e, s, known, *_ = one.at_once()
    nothing, end = Strength(1.0, np.ones(one.gap.size), 0.0, 0.0, 0.0), one.from_then(one.h)
    e_1, s_1, tools = one.e.copy(), one.s.copy(), tools_for(law, one.h, one.gap.size)
    lumped, springs = np.zeros((s.shape[0], 1)), Springs(one.gap, one.w)
    got = row(s_1, e_1, springs, nothing, one.path, end.z_1, end.x_1, *law, tools, lumped, None, None)
    assert_allclose(s_1, s, rtol=1e-12, atol=1e-14)
    assert_allclose(e_1, e, rtol=1e-9, atol=1e-12)
    assert_allclose(got, known, rtol=1e-9, atol=1e-12)


def test_springs_at_one_place_bear_less_further_out():
    """Dragged on in full slip, each has coulomb L[s] and its own root for its force."""
    law, path = law_of(*MATERIALS["elastic"]), Path(1.0, 0.1, 0.0, 30.0, 0.0)
    s, e, springs = np.full((1, 2), 1.0), np.zeros((1, 2)), Springs(np.zeros(2), np.array([0.4, 0.6]))
    tools, lumped = tools_for(law, H, 2), np.zeros((1, 1))
    end = row(s, e, springs, STRENGTH, path, 0.1, 30.0, *law, tools, lumped, None, None).end
    root = np.sqrt(np.maximum(STRENGTH.a_0 + H * (STRENGTH.a_1 + H * STRENGTH.a_2) - STRENGTH.x2, 0.0))
    assert_allclose(end, springs.w @ (COULOMB * (1.0 + 0.1 * H) + root), rtol=1e-14)
