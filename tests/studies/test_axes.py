"""Axes: what may vary, and what is refused before any work, in words that name path, rule and way out."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import contact
from grids import RIGID

import mdr
from mdr.studies.axes import label_of, read_axes


def test_the_values_are_the_study_s_own():
    given = np.array([1.0, 2.0])
    (axis,) = read_axes(RIGID, {"v_0": given})
    given[0] = 7.0
    assert axis[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        axis.values[0] = 7.0


def test_fields_that_are_no_numbers_have_labels():
    prony = mdr.Prony(E_inf=1e6, arms=[(1e6, 1e-3)], nu=0.5)
    arms = [[[1e6, 1e-3]], [(2e6, 1e-3), (1e5, 1.0)]]  # lists in lists, as a study file gives them
    material, axis = read_axes(RIGID, {"material": [prony], "material.arms": arms})
    assert axis.values == (((1e6, 1e-3),), ((2e6, 1e-3), (1e5, 1.0)))
    assert axis.labels == ("((1000000.0, 0.001),)", "((2000000.0, 0.001), (100000.0, 1.0))")
    assert material.labels[0].startswith("Prony(E_inf=1000000.0")


def test_a_shaken_case_varies_its_shake_and_is_pulled_both_ways():
    shake = mdr.InPlaneOscillation(omega=300.0, du_x=3e-5, phi_x=1.5)
    case = replace(contact("paraboloid"), oscillation=mdr.ConstantDepth(u_z0=20e-6), shake=shake)
    saw = mdr.InPlaneMotion(omega=300.0, x_sin=(1e-5, 5e-6))
    study = mdr.sweep(case, {"chi": [0.5, 2.0], "shake.phi_x": [0.0, 1.5], "v_0/v_c": [-1.2, 0.3]})
    assert study["cof"].shape == (2, 2, 2)
    assert np.allclose(study["cof"][..., 0], -0.4, rtol=1e-9)
    assert np.allclose(study["cof"][:, 0], study["cof"][:, 1], rtol=1e-7)  # of a shake alone the phase says nothing
    other = mdr.sweep(case, {"shake": [shake, saw], "v_0": [-1e-3, 1e-3]})
    assert np.all(np.diff(other["cof"]) > 0)


def test_a_shake_across_is_varied_by_its_amplitude_or_by_eta():
    shake = mdr.InPlaneOscillation(omega=300.0, du_y=1e-5)
    case = replace(contact("flat", nu=0.5), oscillation=mdr.ConstantDepth(u_z0=20e-6), shake=shake)
    by_group = mdr.sweep(case, {"eta": [0.28, 0.6, 2.0]}, quantities=("static_cof",))
    # sqrt(1 - eta²) of a flat face
    assert np.allclose(by_group["static_cof"], [0.4 * 0.96, 0.4 * 0.8, 0.0], atol=1e-12)
    reach = 0.4 * case.material.mindlin_ratio * 20e-6
    by_field = mdr.sweep(case, {"shake.du_y": [0.6 * reach]}, quantities=("static_cof",))
    assert np.allclose(by_field["static_cof"], by_group["static_cof"][1])


def test_labels_are_distinct_and_know_no_places_in_memory():
    curves = [mdr.SampledProfile(np.linspace(0, 1e-3, 9), k * np.linspace(0, 1e-3, 9) ** 2) for k in (100, 100.000001)]
    made = read_axes(RIGID, {"indenter": curves})[0].labels
    assert len(set(made)) == 2
    assert " at 0x" not in label_of(mdr.Profile(lambda r: r**2, name="bowl"))
