"""What must be true of one step of a spring, of any material, state and parabola."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from rows import MATERIALS, Row, as_they_are, row, tools_for

from mdr.spring import contact_modes as of
from mdr.spring import energies
from mdr.spring.contact import Springs
from mdr.spring.path import Ends, zero_of_parabola

TINY = 4000
every_material = pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS)


@cache
def rows(material):
    return [Row.draw(np.random.default_rng(seed), material) for seed in range(8)]


@every_material
def test_a_step_may_be_cut_into_seven(material):
    for one in rows(material):
        for whole, parts in zip(one.stepped(), one.stepped(7), strict=True):
            assert_allclose(parts, whole, rtol=0, atol=1e-11)


@every_material
def test_a_row_is_the_sum_of_its_springs(material):
    one = rows(material)[0]
    (e, s, *sums), (e_all, s_all, of_all, *_) = one.stepped(), one.at_once()
    all_sums = of_all.area, of_all.moment, of_all.stuck, of_all.normal_area, of_all.normal_moment
    for whole, each in ((e_all, e), (s_all, s), (all_sums, np.array(sums) @ one.w)):
        assert_allclose(whole, each, rtol=0, atol=1e-13)


@pytest.mark.parametrize("name", ["elastic", "Kelvin", "quick Kelvin"])
def test_springs_that_do_one_thing_all_step_are_as_from_event_to_event(name):
    """In short steps, in which most do; with rates at the end that are not those of the parabolas."""
    met = set()
    for seed in range(40):
        one = Row.draw(np.random.default_rng(seed), MATERIALS[name], h=0.02)
        rates = tuple(np.random.default_rng(seed).uniform(-1, 1, 2))
        (*lean, _), (*known, each) = one.at_once(rates), one.at_once(rates, each=True)
        for a, b in zip(lean, known, strict=True):
            assert_allclose(a, b, rtol=0, atol=1e-14)
        whole, presses = each.pressed_for == 1, each.f_z > 0
        of_kinds = whole & (np.abs(each.f) < each.f_z), presses & (each.f == each.f_z), presses & (each.f == -each.f_z)
        met |= {kind for kind, who in enumerate((*of_kinds, ~presses)) if who.any()}
    assert met == {0, 1, 2, 3}  # stick, slip, slip back, flight


@every_material
def test_it_does_not_know_forward_from_backward(material):
    for one in rows(material):
        (e, s, *sums), (e_back, s_back, *back) = one.stepped(), one.mirrored().stepped()
        assert_allclose(e_back, -e, rtol=0, atol=1e-13)
        assert_allclose(s_back, s, rtol=0, atol=1e-13)
        assert_allclose(back, np.array(sums) * [[-1], [-1], [1], [1], [1]], rtol=0, atol=1e-13)


# --- against Coulomb's law in tiny steps ---


def beside_tiny_steps(material, n, **fault):
    """How far the step and n tiny ones are apart: e, s, area and moment of every spring, (4, springs)."""
    stepped = zip(*(one.stepped()[:4] for one in rows(material)), strict=True)
    tiny = Row.beside(rows(material)).by_tiny_steps(n, **fault)[:4]
    pairs = zip(tiny, (np.concatenate(each, axis=-1) for each in stepped), strict=True)
    return np.array([np.abs(a - b).reshape(-1, a.shape[-1]).max(axis=0) for a, b in pairs])


def allowed(material):
    """What tiny steps may miss of a force of order 1: a tiny step of an event, and of a fall by h/theta or h/T."""
    T, rho, theta = material
    rates = [rho_j / one for rho_j, one in zip(rho, theta, strict=True)] + ([1 / T] if T else [])
    return (1 + sum(rates)) * 0.2 / TINY


@every_material
def test_it_is_coulombs_law_in_tiny_steps(material):
    apart = beside_tiny_steps(material, TINY)
    assert apart.max() < allowed(material)
    # of first order: a fourth of the error in steps of a fourth; where events fall in them differs
    coarse = beside_tiny_steps(material, TINY // 4).mean(axis=1)
    assert np.all((apart.mean(axis=1) < 0.4 * coarse) | (coarse < 1e-12))


@pytest.mark.parametrize("fault", [{"limit": 0.99}, {"turned": -1.0}, {"touch": 1e-2}, {"dashpot": 0.9}], ids=str)
@every_material
def test_a_planted_fault_would_be_seen(material, fault):
    if "dashpot" in fault and not material[0]:
        pytest.skip("no dashpot")
    assert beside_tiny_steps(material, TINY, **fault).max() > 2 * allowed(material)


# --- energies and forces ---


@every_material
def test_every_energy_goes_somewhere(material):
    for one in rows(material):
        (e, s, area, moment, stuck, *_), looks = one.looked_at()
        sums = np.array([look.sums for look in looks]).T
        stored = [0.5 * one.roots @ (after**2 - before**2) for after, before in ((e, one.e), (s, one.s))]
        work = one.path.x_1 * area + 2 * one.path.x_2 * moment
        spent = sums[energies.FRICTION_LOSS] + sums[energies.SHEAR_VISCOUS] + stored[0]
        assert_allclose(spent, work, rtol=0, atol=1e-9)
        assert_allclose(sums[energies.NORMAL_VISCOUS] + stored[1], sums[energies.NORMAL_WORK], rtol=0, atol=1e-9)
        for loss in (energies.FRICTION_LOSS, energies.SHEAR_VISCOUS, energies.NORMAL_VISCOUS, energies.STICK_IMPULSE):
            assert sums[loss].min() >= 0
        # the law of friction holds at the end, where no spring in contact goes deeper than the indenter
        f_x, f_z, mode = (np.array([getattr(look, name)[0] for look in looks]) for name in ("f", "f_z", "mode"))
        assert np.all(np.abs(f_x) <= f_z * (1 + 1e-12))
        assert np.all(f_z[mode == of.FREE] == 0)
        assert np.all(s[0] >= one.at(one.h)[0] - one.gap - 1e-14)
        assert np.all((stuck >= 0) & (stuck <= one.h * (1 + 1e-15)))
        for slips, side in ((of.SLIP, 1), (of.SLIP_BACK, -1)):
            assert_allclose(f_x[mode == slips], side * f_z[mode == slips], rtol=1e-12)


@every_material
def test_all_modes_are_met(material):
    met = {int(look.mode[0]) for one in rows(material) for look in one.looked_at()[1]}
    assert met == {of.FREE, of.STICK, of.SLIP, of.SLIP_BACK}


@every_material
def test_the_normal_part_alone_is_that_of_the_step(material):
    for one in rows(material):
        s, area, moment, since = one.pressed()
        (_, s_whole, _, _, _, *normal), looks = one.looked_at()
        assert_allclose(s, s_whole, rtol=0, atol=1e-13)
        assert_allclose((area, moment), np.array(normal) @ one.w, rtol=0, atol=1e-13)
        of_look = [look.sums[energies.CONTACT_IMPULSE] for look in looks]
        assert_allclose(area, one.w @ of_look, rtol=0, atol=1e-9)  # of the other by Gauss's rule
        assert_array_equal(since > 0, [look.mode[0] != of.FREE for look in looks])


@every_material
def test_springs_that_keep_their_modes_are_full_slip_and_one_spring(material):
    """The second half of a step, of the springs that stick, slip or slip back all through it."""
    for one in rows(material):
        half = one.h / 2
        (e, s, *_), looks = replace(one, h=half).looked_at()
        then = replace(one, path=one.from_then(half), h=half, e=e, s=s)
        (_, _, _, _, stuck, *_), after = then.looked_at()
        before, mode = (np.array([look.mode[0] for look in which]) for which in (looks, after))
        keeps = (mode == before) & (stuck == np.where(mode == of.STICK, half, 0.0)) & (mode != of.FREE)
        first, then = (
            replace(which, gap=one.gap[keeps], s=which.s[:, keeps], e=which.e[:, keeps], w=one.w[keeps])
            for which in (replace(one, h=half), then)
        )
        tools, end = tools_for(one.law, half, one.gap.size), then.from_then(half)
        T, _, arms = one.law
        lumped = np.zeros((one.s.shape[0], 1))
        row_of = Springs(first.gap, first.w)
        last = row(
            first.s.copy(), first.e.copy(), row_of, None, first.path, 0.0, 0.0, *one.law, tools, lumped, None, None
        )
        ends = end.z_1, end.x_1
        area, moment, force = as_they_are(then.path, last, T, arms, tools, lumped, *ends)
        s_end, of_slip, moment_of_slip, _ = then.pressed()
        normal = one.roots @ (s_end @ then.w) + T * end.z_1 * then.w.sum()
        row_of = Springs(then.gap, then.w)
        of_row = row(then.s.copy(), then.e.copy(), row_of, None, then.path, *ends, *one.law, tools, lumped, None, None)
        known = of_row.area, of_row.moment, of_row.end
        assert keeps.any()
        assert_allclose((of_slip + area, moment_of_slip + moment, normal + force), known, atol=1e-12)


def test_a_parabola_that_begins_below_zero_by_a_rounding_and_falls_has_its_zero_at_once():
    t, a, b, c, tol = 0.1, -2e-15, 1e-9, -1e-2, 4e-15
    ends = Ends(a, b, a + t * (b + c * t), b + 2 * c * t, 2 * c, 2 * c)
    assert zero_of_parabola.py_func(ends, t, tol, a, b, c) == 0.0


def test_tools_of_fewer_springs_are_refused():
    one = rows(MATERIALS["elastic"])[0]
    end, tools = one.from_then(one.h), tools_for(one.law, one.h, one.gap.size - 1)
    springs, ends, lumped = Springs(one.gap, one.w), (end.z_1, end.x_1), np.empty((1, 1))
    with pytest.raises(ValueError, match="of fewer springs"):
        row(one.s.copy(), one.e.copy(), springs, None, one.path, *ends, *one.law, tools, lumped, None, None)
