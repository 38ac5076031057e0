"""Twenty paths with exact forces: the answers against closed forms and explicit steps, and the library against them."""

import csv
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from pages import DOCS

import mdr
from mdr.element.cuts import ACCURACY
from validation import reference_paths, reference_springs

FOUND = reference_paths.paths()
PATHS = {one.name: one for one in FOUND}
each = pytest.mark.parametrize("path", FOUND, ids=PATHS)


@cache
def stored(name):
    with (DOCS / "paths" / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.reader(file))


@each
def test_the_stored_table_is_what_is_written(path):
    """To the digits that are printed."""
    head, *rows = stored(path.name)
    assert ",".join(head) == reference_paths.HEADER
    assert 20 <= len(rows) <= 200
    values = np.array(rows, float)
    assert_allclose(values[:, 1:4], path.u, rtol=1e-12, atol=1e-20)
    assert_allclose(values[:, 4:], path.F, rtol=0, atol=1e-11 * path.scale)


def test_the_list_has_all_twenty(tmp_path, capsys):
    reference_paths.main(["-o", str(tmp_path)])
    assert "20 paths" in capsys.readouterr().out
    assert {one.name for one in tmp_path.iterdir()} == {one.name for one in (DOCS / "paths").iterdir()}
    assert (tmp_path / "paths.csv").read_text() == (DOCS / "paths" / "paths.csv").read_text()
    assert len(PATHS) == len(stored("paths")) - 1 == 20


# --- the answers ---


@pytest.mark.parametrize("name", [one for one in PATHS if one.startswith("ball") and one != "ball_kelvin"])
def test_the_quadrature_has_its_digits(name):
    path = PATHS[name]
    finer = reference_springs.tangential(path.contact, path.u, reference_springs.dragged(path.contact, path.u), 90)
    assert_allclose(finer, path.F[:, 0] + 1j * path.F[:, 1], rtol=0, atol=1e-11 * path.scale)


def cattaneo(path, u, depth):
    """F_x of a ball that is pulled by u from rest: Cattaneo 1938, Mindlin 1949."""
    c = path.contact
    return c.mu_0 * c.load(depth) * (1 - np.maximum(1 - u / (c.mu_0 * c.kappa * depth), 0) ** 1.5)


def test_a_ball_has_its_closed_forms():
    """Pulled; and back and forth by Masing's rule, after Mindlin and Deresiewicz 1953."""
    pull, back = PATHS["ball_pull"], PATHS["ball_reversal"]
    d, u = pull.u[0, 2], back.u[:, 0]
    assert_allclose(pull.F[:, 0], cattaneo(pull, pull.u[:, 0], d), rtol=0, atol=1e-11 * pull.scale)
    top, bottom = (cattaneo(back, 0.7 * 15e-6, d) * sign for sign in (1, -1))
    masing = np.concatenate(
        [
            cattaneo(back, u[:21], d),
            top - 2 * cattaneo(back, (u[20] - u[21:41]) / 2, d),
            bottom + 2 * cattaneo(back, (u[41:] - u[40]) / 2, d),
        ]
    )
    assert_allclose(back.F[:, 0], masing, rtol=0, atol=1e-11 * back.scale)


def test_a_punch_that_turns_goes_on_a_tractrix():
    """Where it slips on a leg, half of the angle has a tangent that falls by exp(-way/leash)."""
    path = PATHS["punch_legs"]
    n, leash = (path.F[:, 0] + 1j * path.F[:, 1]) / path.scale, reference_paths.unit(path.contact)
    w = path.u[:, 0] + 1j * path.u[:, 1]
    slips = np.flatnonzero(np.isclose(np.abs(n), 1, rtol=1e-12))
    slips = slips[(slips > 21) & (slips != 31) & np.isin(slips - 1, slips)]
    assert slips.size > 8
    for k in slips:
        way = w[k] - w[k - 1]
        before, after = (np.tan(np.angle(n[i] / way) / 2) for i in (k - 1, k))
        assert after == pytest.approx(before * np.exp(-abs(way) / leash), rel=1e-9)


# --- the library ---


def of_library(path, n_springs, parts):
    """The worst error of a contact element over mu_0 F_z, each interval in so many parts."""
    c = path.contact
    shape = mdr.Paraboloid(R=c.size) if c.shape == "ball" else mdr.FlatPunch(a=c.size)
    material = mdr.Prony(E_inf=c.E, arms=((c.E_1, c.tau_1),) if c.E_1 else (), nu=c.nu, tau=c.tau)
    element = mdr.ContactElement(shape, material, c.mu_0, u_z_max=path.u[:, 2].max(), n_springs=n_springs)
    state, F = element.at_rest(path.u[0]), [path.F[0]]
    for k in range(1, len(path.t)):
        for part in range(1, parts + 1):
            u = path.u[k - 1] + part / parts * (path.u[k] - path.u[k - 1])
            force, state = element.step(state, (path.t[k] - path.t[k - 1]) / parts, u)
        F.append(force)
    return np.abs(np.array(F) - path.F).max() / path.scale


@each
def test_an_element_comes_to_the_answer(path):
    """A punch is one spring, and exact; but for a leash that changes on a turned way, of fourth order in the step. With
    arms a step is cut until it is right to an accuracy, and of second order beyond. A ball misses what n springs leave
    out between them, some 1 / n².
    """
    turned_at_once = path.name in ("ball_eight", "punch_circle")
    if path.contact.shape == "punch":
        one, four, more = (of_library(path, 16, parts) for parts in (1, 4, 16))
        if path.contact.E_1:
            assert one < ACCURACY
            assert more < one / 100  # of second order it is 256 times
            return
        assert one < (2e-5 if turned_at_once else 1e-12)
        assert turned_at_once or four < 2e-12
        assert more < max(four / 30, 1e-12)
    else:
        coarse, fine = of_library(path, 64, 4), of_library(path, 512, 4)
        assert coarse < 2 / 64**2
        assert fine < 2 / 512**2
