"""Axes: what may vary, and what is refused before any work, in words that name path, rule and way out."""

import math
import re

import numpy as np
import pytest
from grids import BODY, RIGID, SHAPES

import mdr
from mdr.studies.axes import Axis, label_of, read_axes

REFUSED = [
    # paths
    ({"v0": [1.0]}, ValueError, "v0 is no path of this case; did you mean v_0?"),
    ({"R": [1.0]}, ValueError, "did you mean indenter.R?"),
    ({"tau": [1.0]}, ValueError, "did you mean material.tau?"),
    ({"oscilation.u_z0": [1.0]}, ValueError, "did you mean oscillation.u_z0?"),
    ({"material.Tau": [1.0]}, ValueError, "KelvinVoigt has none; did you mean material.tau?"),
    ({"pull.k": [1.0]}, ValueError, "SpringPull has none; did you mean pull.k_x?"),
    ({"xyz": [1.0]}, ValueError, "there are v_0, v_0/v_c, mu_0, indenter, material"),
    ({3: [1.0]}, TypeError, "axes must have paths in quotes"),
    ({}, ValueError, "axes must name at least one path"),
    (["v_0"], TypeError, "axes must map paths to values"),
    # two axes for one
    ({"v_0": [1.0], "v_0/v_c": [1.0]}, ValueError, "v_0 and v_0/v_c set the same"),
    ({"alpha": [0.1], "oscillation.du_z": [1e-6]}, ValueError, "alpha and oscillation.du_z set the same"),
    ({"T": [0.1], "material.tau": [1e-3]}, ValueError, "T and material.tau set the same"),
    ({"k_x/k_xc": [1], "pull.k_x": [1e4]}, ValueError, "k_x/k_xc and pull.k_x set the same"),
    ({"omega_0/omega": [1], "pull.m": [1]}, ValueError, "omega_0/omega and pull.m set the same"),
    # values
    ({"v_0": []}, ValueError, "v_0 has no values"),
    ({"v_0": np.array([])}, ValueError, "v_0 has no values"),
    ({"v_0": 0.1}, TypeError, "v_0 must be a list of values, got 0.1; write [...]"),
    ({"v_0": "slow"}, TypeError, "v_0 must be a list of values"),
    ({"v_0": {0.1, 0.2}}, TypeError, "v_0 must be a list of values"),
    ({"v_0": [0.1, math.nan]}, ValueError, "v_0 must be finite in m/s, got nan"),
    ({"v_0": [math.inf]}, ValueError, "v_0 must be finite"),
    ({"v_0": [0.1, -0.1]}, ValueError, "v_0 must not be negative, got -0.1"),
    ({"v_0": [0.1, "x"]}, TypeError, "v_0 must be real numbers"),
    ({"v_0": [True, 0.5]}, TypeError, "v_0 must be real numbers"),
    ({"v_0": [0.1j]}, TypeError, "v_0 must be real numbers"),
    ({"v_0": [10**400]}, TypeError, "v_0 must be real numbers"),
    ({"mu_0": [[0.1, 0.2]]}, ValueError, "mu_0 must be a plain list"),
    ({"mu_0": [0.1, 0.2, 0.1]}, ValueError, "mu_0 has the value 0.1 twice"),
    ({"pull.m": SHAPES}, TypeError, "pull.m must be real numbers"),
    ({"indenter": [0.1]}, TypeError, "indenter must be a list of records of kind Indenter, got 0.1"),
    ({"indenter": [mdr.Cone]}, TypeError, "indenter must be a list of records of kind Indenter"),
    ({"indenter": SHAPES[0]}, TypeError, "indenter must be a list of values"),
    ({"indenter": [SHAPES[0], mdr.Paraboloid(R=5e-3)]}, ValueError, "indenter has the value Paraboloid(R=0.005) twice"),
    ({"pull": [SHAPES[0]]}, TypeError, "pull must be a list of records of kind Pull"),
]


@pytest.mark.parametrize(("axes", "kind", "words"), REFUSED, ids=[words for _, _, words in REFUSED])
def test_what_can_never_be_set_is_refused_at_once(axes, kind, words):
    with pytest.raises(kind) as caught:
        mdr.sweep(BODY, axes, quantities=["v_c"] if not any("v" in str(path) for path in axes) else ["cof"])
    assert words in str(caught.value)
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize(
    ("axes", "words"),
    [
        ({"pull.m": [0.1]}, "pull.m is no path of this case; RigidPull has none"),
        ({"k_x/k_xc": [1.0]}, "k_x/k_xc sets pull.k_x, which RigidPull has not; give one that has it"),
        ({"omega_0/omega": [1.0]}, "omega_0/omega sets pull.m"),
        ({"material": [mdr.Elastic(E=1e6, nu=0.3)], "T": [1.0]}, "T sets material.tau, which Elastic has not"),
        ({"oscillation": [mdr.LoadOscillation(1, 0.5, 300)], "alpha": [0.1]}, "alpha sets oscillation.du_z"),
        ({"indenter": [mdr.Cone(theta=0.1)], "indenter.R": [1e-3]}, "Cone has none; did you mean indenter"),
    ],
)
def test_a_path_that_no_case_of_the_grid_has(axes, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        read_axes(RIGID, axes)


def test_a_path_that_some_records_have_is_an_axis():
    axes = read_axes(RIGID, {"indenter.R": [1e-3], "indenter": SHAPES, "pull": [mdr.SpringPull(1e4)], "pull.m": [0.1]})
    assert [axis.path for axis in axes] == ["indenter.R", "indenter", "pull", "pull.m"]


def test_numbers_of_any_kind_are_taken():
    for values in ([1, 2.5], (1, 2.5), np.array([1, 2.5], dtype=np.float32), iter([1, 2.5]), range(1, 3)):
        (axis,) = read_axes(RIGID, {"v_0": values})
        assert axis.is_numeric
        assert axis.values.dtype == np.float64
        assert axis[0] == 1.0


def test_the_values_are_the_study_s_own():
    given = np.array([1.0, 2.0])
    (axis,) = read_axes(RIGID, {"v_0": given})
    given[0] = 7.0
    assert axis[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        axis.values[0] = 7.0


def test_fields_that_are_no_numbers_have_labels():
    prony = mdr.Prony(E_inf=1e6, arms=[(1e6, 1e-3)], nu=0.5)
    arms = [[(1e6, 1e-3)], [(2e6, 1e-3), (1e5, 1.0)]]
    material, axis = read_axes(RIGID, {"material": [prony], "material.arms": arms})
    assert axis.labels == ("((1000000.0, 0.001),)", "((2000000.0, 0.001), (100000.0, 1.0))")
    assert material.labels[0].startswith("Prony(E_inf=1000000.0")


def test_lists_in_lists_are_taken_as_tuples():
    """As a study file gives them."""
    prony = mdr.Prony(E_inf=1e6, arms=[(1e6, 1e-3)], nu=0.5)
    _, axis = read_axes(RIGID, {"material": [prony], "material.arms": [[[1e6, 1e-3]]]})
    assert axis.values == (((1e6, 1e-3),),)


def test_labels_are_distinct_and_know_no_places_in_memory():
    curves = [mdr.SampledProfile(np.linspace(0, 1e-3, 9), k * np.linspace(0, 1e-3, 9) ** 2) for k in (100, 100.000001)]
    made = read_axes(RIGID, {"indenter": curves})[0].labels
    assert len(set(made)) == 2
    assert " at 0x" not in label_of(mdr.Profile(lambda r: r**2, name="bowl"))


def test_values_are_found_exactly():
    numbers, records = read_axes(RIGID, {"v_0": [0.1, 0.3], "indenter": SHAPES})
    assert numbers.index(0.3) == 1
    assert records.index(mdr.Cone(theta=0.05)) == records.index("Cone(theta=0.05)") == 1
    with pytest.raises(ValueError, match=r"v_0 has no value 0.30000000000000004; the nearest is 0.3"):
        numbers.index(0.1 + 0.2)
    with pytest.raises(ValueError, match="v_0 has numbers for values"):
        numbers.index("fast")
    with pytest.raises(ValueError, match=r"indenter has no value Cone\(theta=0.06\); there are Paraboloid"):
        records.index(mdr.Cone(theta=0.06))


def test_axes_are_equal_by_path_and_values_records_by_label():
    (one,), (two,) = read_axes(RIGID, {"indenter": SHAPES}), read_axes(RIGID, {"indenter": SHAPES[:2]})
    again = Axis("indenter", one.labels, one.labels)
    assert one == again
    assert hash(one) == hash(again)
    assert one != two
    assert one != "indenter"
    assert Axis("v_0", np.array([1.0])) != Axis("v_0", np.array([2.0]))
    assert Axis("v_0", np.array([1.0])) == Axis("v_0", np.array([1.0]))


def test_a_shaken_case_varies_its_shake_and_is_pulled_both_ways():
    shake = mdr.InPlaneOscillation(omega=300.0, du_x=3e-5, phi_x=1.5)
    depth = mdr.ConstantDepth(u_z0=20e-6)
    case = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.5), 0.4, depth, shake=shake)
    saw = mdr.InPlaneMotion(omega=300.0, x_sin=(1e-5, 5e-6))
    study = mdr.sweep(case, {"chi": [0.5, 2.0], "shake.phi_x": [0.0, 1.5], "v_0/v_c": [-1.2, 0.3]})
    assert study["cof"].shape == (2, 2, 2)
    assert np.allclose(study["cof"][..., 0], -0.4, rtol=1e-9)
    assert np.allclose(study["cof"][:, 0], study["cof"][:, 1], rtol=1e-7)  # of a shake alone the phase says nothing
    other = mdr.sweep(case, {"shake": [shake, saw], "v_0": [-1e-3, 1e-3]})
    assert np.all(np.diff(other["cof"]) > 0)
    still = mdr.SlidingContact(mdr.Paraboloid(R=5e-3), RIGID.material, 0.4, RIGID.oscillation)
    with pytest.raises(ValueError, match=r"chi sets shake\.du_x, which a case without shake has not"):
        read_axes(still, {"chi": [0.5]})
    with pytest.raises(ValueError, match=r"chi and shake\.du_x set the same"):
        read_axes(case, {"chi": [0.5], "shake.du_x": [1e-6]})
