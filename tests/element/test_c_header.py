"""The contact in C: the library's own steps, on turned, reversed, tapping and paused ways; and what it refuses."""

import ctypes
import subprocess

import numpy as np
import pytest
from elements import BALL, DEPTH, DOUBLES, KELVIN, MU_0, REACH, at, element, in_c, walk
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr.element.c_header import header
from mdr.element.fmu import NoCompiler, compiler

SHAPES = {"ball": BALL, "punch": mdr.FlatPunch(a=1e-3), "cone": mdr.TruncatedCone(theta=0.02, b=0.5e-3)}
WALL = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
#: the steps of standard input, "dt x y z" each, with tangents
PROGRAM = """
#include <stdio.h>
#include "contact.h"
int main(void) {
    double state[CONTACT_N_STATE], u[3] = {0.0, 0.0, 0.5 * CONTACT_U_Z_MAX}, dt, F[3], K[9];
    int status = contact_at_rest(state, u);
    while (status == 1 && scanf("%lf %lf %lf %lf", &dt, u, u + 1, u + 2) == 4) {
        status = contact_step(state, state, dt, u, F, K);
    }
    printf("%d", status);
    return 0;
}
"""
LIBRARY = """
#include "contact.h"
int at_rest(double *state, const double *u) { return contact_at_rest(state, u); }
int step(const double *state, double *new_state, double dt, const double *u, double *F, double *K) {
    return contact_step(state, new_state, dt, u, F, K);
}
double stored(const double *state) { return contact_stored(state); }
"""


@pytest.fixture(scope="module")
def cc():
    try:
        return compiler()
    except NoCompiler as fault:
        pytest.skip(str(fault))


def built(cc, folder, contact, source, *options, change=lambda text: text):
    """A program or library of this source around the header of a contact."""
    (folder / "contact.h").write_text(change(header(contact, "contact", "of a test */ here")), encoding="utf-8")
    (folder / "made.c").write_text(source, encoding="utf-8")
    made = folder / "made"
    done = subprocess.run(
        [*cc, "-O2", *options, "made.c", "-o", made, "-lm"], cwd=folder, capture_output=True, text=True
    )
    if "cc1plus" in done.stderr:
        pytest.skip("this compiler has no C++")
    if any(one.startswith("-fsanitize") for one in options) and "cannot find" in done.stderr:
        pytest.skip("this compiler comes without sanitizers")
    assert (done.returncode, done.stderr) == (0, "")
    return made


def library(cc, folder, contact, **given):
    made = ctypes.CDLL(str(built(cc, folder, contact, LIBRARY, "-fPIC", "-shared", *WALL, **given)))
    made.step.argtypes = [DOUBLES, DOUBLES, ctypes.c_double, DOUBLES, DOUBLES, DOUBLES]
    made.at_rest.argtypes = [DOUBLES, DOUBLES]
    made.stored.argtypes, made.stored.restype = [DOUBLES], ctypes.c_double
    return made


def far_off(F, G, contact):
    """The greatest difference of forces on a path, over mu_0 F_N, or that of a dashpot, whose rounding stays."""
    return np.abs(F - G).max() / max(MU_0 * contact.indenter.force(DEPTH, contact.material.E_star), np.abs(G).max())


# --- what it answers ---


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
@in_c
def test_steps_are_those_of_the_library(cc, tmp_path, material, shape):
    """Twenty paths of 60 steps, each on its own state; the tangent is a difference of such forces."""
    contact = element(material, shape, n_springs=64)
    made, worst, of_tangent = library(cc, tmp_path, contact), 0.0, 0.0
    for seed in range(20):
        dt, us = walk(seed)
        start = np.array([0.0, 0.0, 0.5 * DEPTH])
        own, state, K, forces = np.empty(contact.n_state), contact.at_rest(start), np.empty((3, 3)), []
        assert made.at_rest(at(own), at(start)) == 1
        assert_allclose(own, state, rtol=1e-15)
        for u in us:
            F = np.empty(3)
            assert made.step(at(own), at(own), dt, at(u), at(F), at(K)) == 1
            G, state, L = contact.step(state, dt, u, tangent=True)
            forces.append((F, G))
            of_tangent = max(of_tangent, np.abs(K - L).max() / max(np.abs(L).max(), contact.material.E_star * 1e-6))
        worst = max(worst, far_off(*np.swapaxes(forces, 0, 1), contact))
        swift = np.abs(np.diff(us[:, :2], axis=0)).max() / REACH * max(1.0, material.tau / dt)  # T p, over 1 of a state
        assert_allclose(own[4:-1], state[4:-1], rtol=0, atol=1e-14 * max(1.0, swift))
        assert own[3] - made.stored(at(own)) == pytest.approx(float(contact.dissipated(state)), rel=1e-12)
    assert worst < 1e-14
    assert of_tangent < 1e-7


@pytest.mark.parametrize("shape", SHAPES.values(), ids=SHAPES)
@in_c
def test_steps_have_no_fault_of_memory(cc, tmp_path, material, shape):
    """Under the sanitizers of memory and of undefined behaviour."""
    contact, (dt, us) = element(material, shape, n_springs=20), walk(6)
    program = built(cc, tmp_path, contact, PROGRAM, "-fsanitize=address,undefined", "-fno-sanitize-recover=all", *WALL)
    steps = "\n".join(" ".join(map(repr, [dt, *map(float, u)])) for u in us)
    done = subprocess.run([program], input=steps, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "1", "")


@in_c
def test_a_step_is_pure_and_may_write_over_its_state(cc, tmp_path, material):
    contact, (dt, us) = element(material), walk(3, 25)
    made, F, G = library(cc, tmp_path, contact), np.empty(3), np.empty(3)
    state = contact.at_rest((0, 0, 0.5 * DEPTH))
    for u in us:
        kept, new = state.copy(), np.empty_like(state)
        made.step(at(state), at(new), dt, at(u), at(F), None)
        assert_array_equal(state, kept)
        made.step(at(state), at(state), dt, at(u), at(G), at(np.empty(9)))
        assert_array_equal(state, new)
        assert_array_equal(F, G)


@in_c
def test_it_is_c_plus_plus_without_a_warning(cc, tmp_path, material):
    built(cc, tmp_path, element(material), LIBRARY, "-x", "c++", "-fPIC", "-shared", *WALL[1:])


# --- what it refuses, and doubts ---

HOSTILE = {
    "NaN": {"u": [0.0, np.nan, 1e-6]},
    "infinite": {"u": [np.inf, 0.0, 1e-6]},
    "too deep": {"u": [0.0, 0.0, 41e-6]},
    "too high": {"u": [0.0, 0.0, -np.inf]},
    "far away": {"u": [1.7e308, -1.7e308, 1e-6]},
    "dt < 0": {"dt": -1e-3},
    "dt NaN": {"dt": np.nan},
    "dt infinite": {"dt": np.inf},
    "state": {"state": np.nan},
    "last u": {"state": np.inf},
}


@in_c
def test_what_it_refuses_it_leaves_alone(cc, tmp_path, material):
    contact = element(material)
    made, good = library(cc, tmp_path, contact), {"dt": 1e-3, "u": [1e-6, 0.0, 20e-6]}
    cases = {"good": {}, **HOSTILE, "dt = 0": {"dt": 0.0}}
    for name, change in cases.items():
        dt, u = ({**good, **change}[key] for key in ("dt", "u"))
        state, out = contact.at_rest((0, 0, 20e-6)), np.full(contact.n_state + 12, 7.0)
        state[{"state": 9, "last u": 1}.get(name, 3)] = change.get("state", state[3])
        new, F, K = out[:-12], out[-12:-9], out[-9:]
        refused = name in HOSTILE or (name == "dt = 0" and material.tau > 0)
        status = made.step(at(state), at(new), dt, at(np.array(u)), at(F), at(K))
        assert (status, bool(np.all(out == 7.0))) == ((-1, True) if refused else (1, False)), name
    state = np.full(contact.n_state, 7.0)
    for u in ([np.nan, 0, 0], [0, 0, 41e-6]):
        assert made.at_rest(at(state), at(np.array(u))) == -1
        assert np.all(state == 7.0)


def test_it_says_where_it_left_a_search(cc, tmp_path):
    """With one look instead of 100 a step of events is unreliable, and one of plain slip is not."""
    contact = element(KELVIN)
    made = library(cc, tmp_path, contact, change=lambda text: text.replace("CONTACT_MOST 100", "CONTACT_MOST 1"))
    state, F = contact.at_rest((0, 0, 20e-6)), np.empty(3)
    found = [made.step(at(state), at(state), 1e-3, at(np.array(u)), at(F), None)
             for u in ([0.0, 0.0, 20e-6], [50e-6, 0.0, 20e-6], [50e-6, 0.0, 35e-6])]  # fmt: skip
    assert found == [1, 1, 0]


# --- its text ---


@in_c
def test_a_header_has_500_lines_at_most_and_its_own_names(material):
    text = header(element(material), "left_foot", "one line\nanother */ line")
    assert len(text.splitlines()) <= 500
    assert "contact_" not in text
    assert "@" not in text
    assert text.count("*/ line") == 0
    assert all(word in text for word in ("#ifndef LEFT_FOOT_H", "left_foot_step(", " *     another * / line"))
    assert ("define LEFT_FOOT_T " in text) == (material.tau > 0)  # an elastic contact has no dashpot to carry
