"""The co-simulation unit: valid, driven by fmpy, rolled back; without a compiler, and with wrong input."""

from zipfile import ZipFile

import numpy as np
import pytest
from elements import DEPTH, ELASTIC, REACH, element
from numpy.testing import assert_allclose, assert_array_equal

import mdr
from mdr.element.fmu import FLAGS, NoCompiler, compiler, fmu, library, sources

fmpy = pytest.importorskip("fmpy", reason="fmpy, of the extra export, drives the unit")
from fmpy.fmi2 import FMU2Slave  # noqa: E402

U, F, LOST = [0, 1, 2], [3, 4, 5], [6]  # value references
#: the time of the dashpot is not that of a step, from which on a slip goes by another formula
MATERIALS = {"elastic": ELASTIC, "Kelvin": mdr.KelvinVoigt(E=3e6, nu=0.5, tau=7e-4)}
T = np.arange(1, 31)
WALK = np.column_stack([REACH * np.sin(0.4 * T), REACH * np.cos(0.7 * T), DEPTH * (0.4 + 0.6 * np.sin(0.9 * T))])


@pytest.fixture(scope="module", params=MATERIALS)
def unit(request, tmp_path_factory):
    """A contact, the path of its unit, and what makes instances of it."""
    try:
        compiler()
    except NoCompiler as fault:
        pytest.skip(str(fault))
    contact = element(MATERIALS[request.param], n_springs=32)
    path = tmp_path_factory.mktemp("unit") / "pin.fmu"
    path.write_bytes(fmu(sources(contact, "pin", "a pin"), "pin"))
    described, open_ones = fmpy.read_model_description(str(path)), []
    folder = fmpy.extract(str(path), unzipdir=str(path.parent / "unzipped"))

    def instance(u_z=0.5 * DEPTH):
        one = FMU2Slave(guid=described.guid, unzipDirectory=folder, modelIdentifier="pin", instanceName="one")
        open_ones.append(one)
        one.instantiate()
        one.setupExperiment(startTime=0.0)
        one.enterInitializationMode()
        one.setReal(U, [0.0, 0.0, u_z])
        one.exitInitializationMode()
        return one

    yield contact, path, instance
    for one in open_ones:
        one.freeInstance()


def driven(one, us, dt=1e-3):
    forces = []
    for k, u in enumerate(us):
        one.setReal(U, u)
        one.doStep(k * dt, dt)
        forces.append(one.getReal(F + LOST))
    return np.array(forces)


def test_it_is_valid_and_holds_its_sources(unit):
    _, path, _ = unit
    assert fmpy.validation.validate_fmu(str(path)) == []
    described = fmpy.read_model_description(str(path), validate=True)
    can = described.coSimulation
    assert can.canGetAndSetFMUstate
    assert can.canSerializeFMUstate
    assert can.providesDirectionalDerivative
    assert can.canHandleVariableCommunicationStepSize
    assert [one.name for one in described.modelVariables] == ["u_x", "u_y", "u_z", "F_x", "F_y", "F_z", "lost"]
    assert {"sources/pin.h", "sources/pin_fmu.c", "modelDescription.xml"} < set(ZipFile(path).namelist())


def test_its_steps_are_those_of_the_library(unit):
    contact, _, instance = unit
    one, state, us = instance(), contact.at_rest((0, 0, 0.5 * DEPTH)), WALK
    G, _ = contact.step(state, 1.0, (0, 0, 0.5 * DEPTH))
    assert_allclose(one.getReal(F), G, rtol=1e-14)
    known = []
    for u in us:
        G, state = contact.step(state, 1e-3, u)
        known.append([*G, contact.dissipated(state)])
    found, known = driven(one, us), np.array(known)
    assert_allclose(found, known, rtol=0, atol=1e-13 * np.abs(known).max())


def test_rolled_back_and_serialised_states_go_on_bit_for_bit(unit):
    _, _, instance = unit
    one, us = instance(), WALK
    driven(one, us[:12])
    kept, before = one.getFMUState(), one.getReal(U + F + LOST)
    forces = driven(one, us[12:])
    one.setFMUState(kept)
    assert one.getReal(U + F + LOST) == before
    assert_array_equal(driven(one, us[12:]), forces)
    other, written = instance(0.0), one.serializeFMUState(kept)
    read = other.deserializeFMUState(written)
    other.setFMUState(read)
    assert_array_equal(driven(other, us[12:]), forces)
    nan = bytearray(written)
    nan[-16:-8] = np.array([np.nan]).tobytes()
    for wrong in (written[:-8], bytes([written[0] ^ 1]) + bytes(written[1:]), bytes(nan)):  # cut, of another unit, NaN
        with pytest.raises(fmpy.fmi1.FMICallException):
            other.deserializeFMUState(wrong)
    one.freeFMUState(kept)
    other.freeFMUState(read)


def test_directional_derivatives_are_the_tangent_of_the_last_step(unit):
    contact, _, instance = unit
    one, state, us = instance(), contact.at_rest((0, 0, 0.5 * DEPTH)), WALK[:7]
    driven(one, us)
    for u in us:
        _, state, K = contact.step(state, 1e-3, u, tangent=True)
    rows = np.array([one.getDirectionalDerivative(F, [j], [1.0]) for j in U]).T
    assert_allclose(rows, K, rtol=0, atol=1e-7 * np.abs(K).max())
    assert_allclose(one.getDirectionalDerivative([3, 5], U, [1.0, -2.0, 0.5]), K[[0, 2]] @ [1, -2, 0.5],
                    rtol=0, atol=1e-6 * np.abs(K).max())  # fmt: skip


@pytest.mark.parametrize(("u", "dt"), [((0, 0, 2 * DEPTH), 1e-3), ((np.nan, 0, 0), 1e-3), ((0, 0, 0), 0.0)])
def test_a_step_that_is_refused_is_an_error_and_changes_nothing(unit, u, dt):
    _, _, instance = unit
    one, us = instance(), WALK[:8]
    driven(one, us[:4])
    before = one.getReal(F + LOST)
    one.setReal(U, u)
    with pytest.raises(fmpy.fmi1.FMICallException) as refusal:
        one.doStep(4e-3, dt)
    assert refusal.value.status == 3  # fmi2Error: upon fmi2Discard fmpy would try for ever
    assert one.getReal(F + LOST) == before
    other = instance()
    driven(other, us[:4])
    assert_array_equal(driven(one, us[4:]), driven(other, us[4:]))


def test_wrong_variables_and_wrong_marks_are_refused(unit):
    _, _, instance = unit
    one = instance()
    for call in (lambda: one.setReal([3], [1.0]), lambda: one.getReal([7]),
                 lambda: one.getDirectionalDerivative([6], [0], [1.0]),
                 lambda: one.getDirectionalDerivative([3], [4], [1.0])):  # fmt: skip
        with pytest.raises(fmpy.fmi1.FMICallException):
            call()
    one.guid = "{another}"
    with pytest.raises(Exception, match="instantiate"):
        one.instantiate()


@pytest.mark.parametrize(("cc", "words"), [("no-such-compiler", "cannot be run"), ("false", "failed")])
def test_what_cannot_be_compiled_says_so(monkeypatch, cc, words):
    contact = element()
    monkeypatch.setenv("CC", cc)
    with pytest.raises(NoCompiler, match=words):
        fmu(sources(contact, "pin", ""), "pin")
    monkeypatch.delenv("CC")
    monkeypatch.setenv("PATH", "")
    with pytest.raises(NoCompiler, match="install gcc or clang"):
        compiler()


def test_its_sources_compile_without_a_warning(monkeypatch, unit):
    contact, _, _ = unit
    monkeypatch.setattr("mdr.element.fmu.FLAGS", (*FLAGS, "-Wall", "-Wextra", "-Werror"))
    assert library(sources(contact, "pin", "a pin"), "pin")


def test_fmpy_simulates_it(unit):
    contact, path, _ = unit
    t = np.arange(31) * 1e-3
    u = np.vstack([[0, 0, 0.5 * DEPTH], WALK])
    steps = np.array(list(zip(t, *u.T, strict=True)), dtype=[(name, float) for name in ("time", "u_x", "u_y", "u_z")])
    found = fmpy.simulate_fmu(str(path), stop_time=0.03, step_size=1e-3, output_interval=1e-3, input=steps,
                              start_values={"u_z": 0.5 * DEPTH}, output=["F_x", "F_z"])  # fmt: skip
    state = contact.at_rest((0, 0, 0.5 * DEPTH))
    for k in range(30):  # in a step it goes to the input at its begin
        G, state = contact.step(state, 1e-3, u[k])
        assert_allclose([found["F_x"][k + 1], found["F_z"][k + 1]], G[[0, 2]], rtol=0, atol=1e-10)


def test_a_state_that_is_set_while_it_is_initialised_is_that_state(unit):
    _, _, instance = unit
    one, us = instance(), WALK
    forces = driven(one, us[:12])
    kept = one.getFMUState()
    one.reset()
    one.setupExperiment(startTime=0.0)
    one.enterInitializationMode()
    one.setFMUState(kept)
    assert_array_equal(one.getReal(F + LOST), forces[-1])
    one.freeFMUState(kept)
