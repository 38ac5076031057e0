"""A contact that is pulled along x and then along y at a constant depth: friction as a vector with a memory."""

from dataclasses import replace

import numpy as np
from numpy.testing import assert_allclose

import mdr
from mdr.half_space.influence import X, Y, Z
from mdr.half_space.steps import Contact
from validation.half_space.benchmarks import body

MU = 0.3


def paraboloid(n, nu):
    """R = d = a = E* = 1."""
    half_space, r = body(n, nu, 2 * 1.06)
    return Contact(half_space, r**2 / 2, mdr.Coulomb(MU))


def test_two_stages_are_of_second_order_where_friction_turns():
    contact, s = paraboloid(11, 0.3), np.linspace(0, 1, 65)
    way = MU * np.stack([np.sin(4 * s), 1 - np.cos(4 * s)])
    start, F = contact.full_slip(1.0), {}
    for turning in (False, True):
        for every in (1, 4, 8):
            some = way[:, ::every]
            *_, end = replace(contact, turning=turning).march(start, np.ones(some.shape[1]), some, 1.0)
            F[turning, every] = contact.forces(end.tractions)
    off = {key: np.max(np.abs(one - F[True, 1])) / (MU * one[Z]) for key, one in F.items()}
    assert off[True, 4] < off[True, 8] / 2.5
    assert off[True, 4] < off[False, 4] / 5
    assert np.all(np.hypot(*end.tractions[:2]) <= MU * end.pressure * (1 + 1e-9))


def test_the_stiffness_before_slip_is_mindlins():
    """Of a way so short that next to nothing slips."""
    contact, way = paraboloid(41, 0.3), 1e-4 * MU
    start = contact.full_slip(1.0, way=0.0)
    end = contact.step(start, 1.0, np.array([way, 0.0]), 1.0)
    force = contact.forces(end.tractions - start.tractions)[X]
    assert_allclose(force / way, 2 * contact.half_space.G_star, rtol=0.02)  # 2 G* a


def test_paths_turned_by_ninety_degrees_turn_the_force():
    contact, d = paraboloid(15, 0.2), np.ones(9)
    way = np.stack([np.linspace(0, 0.2, 9), 0.1 * np.linspace(0, 1, 9) ** 2])
    start = contact.full_slip(1.0, way=0.0)
    one = list(contact.march(start, d, way, 1.0))[-1]
    two = list(contact.march(start, d, np.stack([-way[1], way[0]]), 1.0))[-1]  # x -> y, y -> -x
    F, turned_F = (contact.forces(step.tractions) for step in (one, two))
    assert_allclose(turned_F, [-F[Y], F[X], F[Z]], rtol=1e-5, atol=1e-7)


def test_the_path_by_another_way():
    """Coulomb's law cell by cell, in turns, on a dense matrix, without coupling: Gauss and Seidel's method."""
    contact = paraboloid(9, 0.3)
    body = contact.half_space
    contact = Contact(type(body)(body.n, body.h, body.E_star, body.G_star), contact.shape, mdr.Coulomb(MU))
    n, at = body.n, np.arange(body.n)
    rows = at[:, None, None, None] - at[:, None] + n - 1, at[:, None, None] - at + n - 1

    def matrix(i, j):
        return body.coefficients(i, j)[rows].reshape(n * n, n * n)

    C = np.block([[matrix(X, X), matrix(X, Y)], [matrix(Y, X), matrix(Y, Y)]])
    step = 0.5 * MU * body.E_star / body.G_star / 3
    moves = 3 * [(step, 0.0)] + 3 * [(0.0, step)]  # along x, then along y
    way = np.cumsum([(0.0, 0.0), *moves], axis=0).T
    ends = list(contact.march(contact.full_slip(1.0, way=0.0), np.ones(7), way, 1.0))
    p = ends[0].pressure.ravel()
    cells = np.flatnonzero(p > 0)
    q = np.zeros(2 * n * n)
    for end, moved in zip(ends, moves, strict=True):
        asked = C @ q + np.repeat(moved, n * n)
        for _ in range(400):
            for k in cells:
                both = [k, k + n * n]
                new = q[both] + (asked[both] - C[both] @ q) / C[k, k]
                q[both] = new * min(1.0, MU * p[k] / np.hypot(*new))
        assert_allclose(end.tractions[:2].ravel(), q, atol=1e-5 * MU * p.max())
