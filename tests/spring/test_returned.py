"""The return map of a row of springs in the plane: its limits, and what is lost."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from rows import for_python, row, tools_for

from mdr.spring import returned as of
from mdr.spring.contact import Each, Springs
from mdr.spring.law import law_of
from mdr.spring.path import Path
from mdr.spring.times import STEP, Times, Tools

LAWS = {
    "one arm": law_of(0.0, (2.0,), (0.3,)),
    "far apart": law_of(0.0, (0.5, 3.0, 1.0), (1e-9, 0.4, 1e3)),
    "with a dashpot": law_of(0.1, (0.5, 3.0), (0.02, 50.0)),
}
returned, fill_stages = for_python(of.returned), for_python(of.fill_stages)
every_law = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)


def springs(law, n=30, seed=3):
    """Gaps, and relaxed springs that are stretched along x within friction; the top is at z = 0."""
    rng = np.random.default_rng(seed)
    gap, s = -rng.uniform(0.5, 2.0, n), np.zeros((1 + law.arms.rho.size, n))
    s[0] = -gap
    e = np.zeros(s.shape, complex)
    e[0] = rng.uniform(-0.9, 0.9, n) * s[0]
    return gap, s, e


def answer(law, gap, s, e, z_1, x_1, h, pieces):
    """That of the row; s and e are updated."""
    tools, n = tools_for(law, h, gap.size, in_plane=True), gap.size
    tools = Tools(Times(*tools.times[:-1], pieces), tools.room)
    fill_stages(h, STEP, law.arms, tools.times)
    each = Each(np.empty(n), np.empty(n, complex), np.empty(n))
    return returned(s, e, Springs(gap, np.full(n, 1 / n)), Path(0.0, z_1, 0.0, x_1, 0j), *law, tools, each)


@every_law
def test_along_a_line_it_comes_to_the_row_along_a_line(law):
    """Which is exact: the error falls with the square of the pieces, but for springs that begin to slip in one."""
    gap, s, e = springs(law)
    for z_1, x_1 in ((0.5, 3.0), (-0.6, -4.0)):
        one, two, tools = s.copy(), e.real.copy(), tools_for(law, 0.5, gap.size)
        lumped = np.empty((s.shape[0], 1))
        path, w = Path(0.0, z_1, 0.0, x_1, 0.0), np.full(gap.size, 1 / gap.size)
        known = row(one, two, Springs(gap, w), None, path, z_1, x_1, *law, tools, lumped, None, None)
        off = []
        for pieces in (1, 8, 64):
            s_2, e_2 = s.copy(), e.copy()
            found = answer(law, gap, s_2, e_2, z_1, complex(x_1), 0.5, pieces)
            assert_allclose(found.end, known.end, rtol=1e-12)
            assert_allclose(found.normal_area, known.normal_area, rtol=1e-12)
            off.append(abs(found.area - known.area))
        assert off[2] < 1e-3 * known.normal_area
        assert off[2] < 0.1 * off[0] + 1e-12


@every_law
def test_a_step_loses_energy_however_long(law):
    """Work of the motion less what is stored, of each size of a step and direction."""
    rng, moduli = np.random.default_rng(5), np.concatenate([[1.0], law.arms.rho])
    for h in 10.0 ** np.arange(-9.0, 4.0):
        gap, s, e = springs(law)
        for _ in range(10):
            way, sinks = complex(*rng.normal(0, 2, 2)), rng.uniform(-0.4, 0.4)
            before = [moduli @ np.mean(np.abs(one) ** 2, axis=1) / 2 for one in (s, e)]
            of = answer(law, gap, s, e, sinks / h, way / h, h, 1)
            after = [moduli @ np.mean(np.abs(one) ** 2, axis=1) / 2 for one in (s, e)]
            work = of.normal_area * sinks / h, (of.area.conjugate() * way).real / h
            for done, one, two in zip(work, before, after, strict=True):
                assert done - (two - one) >= -1e-13 * (abs(done) + one + two)
            gap = gap - sinks
