"""sensitivity(): derivatives of closed forms by hand, of runs beside finer runs, the laws of dimensions, and what has
none.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import contact
from horn import HORN

import mdr
from mdr.case.paths import facts_at
from mdr.friction.slopes import Function, Functions, slope
from mdr.given.case_file import case_of
from mdr.march.periodic.order import cut_of
from mdr.march.periodic.steady import MOST_ACCURATE, Resolution, steady
from mdr.tools.arrays import EPS

BODY = contact("cone", 5.0, k_ratio=2.0, omega_0_ratio=1.6, c_ratio=0.1)
KELVIN = contact("paraboloid", 5.0, T=0.3, k_ratio=0.5, omega_0_ratio=0.6, c_ratio=0.1)
LOST = contact("paraboloid", 0.6, T=0.3, k_ratio=0.5, omega_0_ratio=0.6, c_ratio=0.1)
BACK = contact("paraboloid", 1.56, k_ratio=0.3, omega_0_ratio=0.9, c_ratio=0.02)  # springs that leave slip back
RIGID = contact("paraboloid", 4.0, T=0.3)
ARMS = replace(contact("cone", 5.0), material=mdr.Prony(E_inf=3e6, arms=((2e6, 2e-3), (1e6, 2e-2)), nu=0.45))
SHAKEN = replace(RIGID, shake=mdr.InPlaneOscillation(du_x=3e-6, omega=300.0))
CONTACTS = {"rigid": RIGID, "body": BODY, "kelvin": KELVIN, "lost": LOST, "arms": ARMS, "shaken": SHAKEN}
#: exponents of pressure, length and time in the units of inputs
UNITS = {
    "m": (0, 1, 0), "rad/s": (0, 0, -1), "Hz": (0, 0, -1), "s": (0, 0, 1), "Pa": (1, 0, 0), "N/m": (1, 1, 0),
    "N s/m": (1, 1, 1), "kg": (1, 1, 2), "m/s": (0, 1, -1), "rad": (0, 0, 0), "-": (0, 0, 0),
}  # fmt: skip


def half_speed(case):
    return 0.5 * mdr.critical_velocity(case)


def elasticities(found, of="cof"):
    """Derivatives per share, and their errors; zero of what does not matter to a quantity."""
    value = abs(getattr(found, of))
    errors = {path: error * abs(found.inputs[path]) / value for path, error in found.error[of].items()}
    return found.elasticity(of), errors


def test_v_c_of_a_rigid_pull_grows_with_each_factor_of_eq_1():
    """v_c = mu_0 kappa omega du_z, kappa = (2 - nu)/(2 - 2 nu), so that d ln kappa/d nu = 1/((2 - nu)(1 - nu))."""
    case = contact("cone", 10.0, nu=0.3)
    found = mdr.sensitivity(case)
    of_nu = 0.3 / ((2 - 0.3) * (1 - 0.3))
    wanted = {"mu_0": 1, "frequency": 1, "oscillation.du_z": 1, "material.nu": of_nu, "material.E": 0}
    wanted |= {"indenter.theta": 0, "oscillation.u_z0": 0}
    assert found.elasticity("v_c") == pytest.approx(wanted, abs=1e-9)
    assert found.d_v_c["oscillation.du_z"] == pytest.approx(found.v_c / 2e-6, rel=1e-9)
    assert (found.cof, found.d_cof, found.v_0) == (None, {}, None)


def test_v_c_of_a_body_is_eq_2_by_hand():
    """d ln v_c/d ln k_x of Eq. (2): with D = m omega² - k_x it is k_x/D - k_x/(D - k_xc)."""
    found = mdr.sensitivity(BODY, fields=["k_x", "m"])
    k_x, m, k_xc, omega = 2.0, 2.0 / (1.6 * 300.0) ** 2, 1.0, 300.0  # in units of k_xc
    c = 0.1 / omega
    D = m * omega**2 - k_x - 1j * c * omega

    def slope(dD):
        """d ln |(D - k_xc)/D|"""
        return (dD * (1 / (D - k_xc) - 1 / D)).real

    wanted = {"pull.k_x": slope(-k_x), "pull.m": slope(m * omega**2)}
    assert found.elasticity("v_c") == pytest.approx(wanted, abs=1e-9)


def test_static_friction_of_a_cone_is_its_least_over_its_mean_force():
    """F_N = c u_z²: mu_0 (1 - a)²/(1 + a²/2), a = du_z/u_z0, whose elasticity in a is -2 a/(1 - a) - a²/(1 + a²/2)."""
    found = mdr.sensitivity(contact("cone", 10.0), fields=["mu_0", "du_z", "u_z0", "E"])
    of_a = -2 * 0.1 / 0.9 - 0.01 / 1.005
    wanted = {"mu_0": 1, "oscillation.du_z": of_a, "oscillation.u_z0": -of_a, "material.E": 0}
    assert found.elasticity("static_cof") == pytest.approx(wanted, abs=1e-9)


def test_friction_of_a_rigid_pull_is_that_of_differences_of_another_size():
    v_0 = half_speed(RIGID)
    found, h = mdr.sensitivity(RIGID, v_0), 1e-3
    for path in ("indenter.R", "oscillation.du_z", "oscillation.u_z0", "material.tau"):
        x = found.inputs[path]
        at = [mdr.cof_curve(with_value(RIGID, path, x * (1 + k * h)), v_0).cof[0] for k in (-2, -1, 1, 2)]
        beside = (at[0] - 8 * at[1] + 8 * at[2] - at[3]) / (12 * h * x)  # of fourth order
        assert found.d_cof[path] == pytest.approx(beside, abs=1e-9 * found.cof / x)


@pytest.mark.parametrize("name", CONTACTS)
def test_euler_s_relations_of_dimensionless_groups(name):
    """Friction knows no unit: its elasticities, by the exponents of a unit in the inputs, add to zero. And lengths in
    the plane and v_0, over mu_0, are what cof/mu_0 knows.
    """
    case = CONTACTS[name]
    found = mdr.sensitivity(case, half_speed(case))
    powers, missed = elasticities(found)
    assert set(powers) == set(found.inputs)
    exponents = {path: UNITS[facts_at(path).unit] for path in powers}
    for k in (1,) if name == "arms" else range(3):  # moduli and times of arms are no inputs
        total = sum(exponents[path][k] * power for path, power in powers.items())
        assert abs(total) <= sum(abs(exponents[path][k]) * error for path, error in missed.items()) + 1e-9
    wide = {"mu_0", "v_0", "shake.du_x"} & set(powers)
    assert abs(sum(powers[path] for path in wide) - 1) <= sum(missed[path] for path in wide) + 1e-9


@pytest.mark.parametrize("case", [BODY, KELVIN, LOST, BACK], ids=["body", "kelvin", "lost", "back"])
def test_derivatives_of_runs_are_those_of_runs_four_times_as_fine(case):
    """Within the error. Springs without a cut where they slip back miss several times as much as is allowed here."""
    v_0 = half_speed(case)
    fields = ["du_z", "m", "v_0"]
    found = mdr.sensitivity(case, v_0, fields)
    run = mdr.slide(case, v_0)
    fine = Resolution(4 * run.n_springs, 4 * run.steps_per_period, "full_slip", True, 0, MOST_ACCURATE, bounded=False)
    fine = fine._replace(cut=cut_of(steady(case, v_0, fine)))
    for path, x in found.inputs.items():
        h = 1e-3
        at = [
            steady(case, x * (1 + k * h), fine).cof * case.mu_0
            if path == "v_0"
            else steady(with_value(case, path, x * (1 + k * h)), v_0, fine).cof * case.mu_0
            for k in (-1, 1)
        ]
        beside = (at[1] - at[0]) / (2 * h * x)
        unit = found.cof / x
        assert abs(found.d_cof[path] - beside) <= found.error["cof"][path] + 1e-6 * unit  # of the size, h²
        assert found.error["cof"][path] <= 1e-3 * max(unit, abs(beside))


def with_value(case, path, value):
    """The case with another value of a field of a part."""
    part, field = path.split(".")
    return replace(case, **{part: replace(getattr(case, part), **{field: value})})


def test_what_a_file_gave_is_varied_in_the_place_of_what_it_sets():
    said = case_of(HORN)
    found = mdr.sensitivity(said.case, 0.01, held=said.held)
    assert {"load", "frequency", "tan_delta"} <= set(found.inputs)
    assert found.inputs["load"] == 5.0
    assert not {"oscillation.u_z0", "oscillation.omega", "material.tau"} & set(found.inputs)
    near = mdr.tolerance(said.case, 0.01, by=1e-3, fields=["load", "R"], held=said.held)
    for path, (less, more) in near.cof.items():
        low, high = near.inputs[path]
        assert found.d_cof[path] == pytest.approx((more - less) / (high - low), rel=1e-5)


def test_pulled_the_other_way_friction_and_its_slopes_turn():
    fields = ["mu_0", "du_x", "v_0"]
    one, two = (mdr.sensitivity(SHAKEN, v_0, fields) for v_0 in (1e-4, -1e-4))
    mirror = mdr.sensitivity(replace(SHAKEN, shake=replace(SHAKEN.shake, phi_x=np.pi)), 1e-4, fields)
    assert two.cof == pytest.approx(-mirror.cof, rel=1e-9)
    assert two.d_cof["v_0"] == pytest.approx(mirror.d_cof["v_0"], rel=1e-6)
    assert two.d_cof["mu_0"] == pytest.approx(-mirror.d_cof["mu_0"], rel=1e-6)
    assert set(one.d_cof) == {"mu_0", "shake.du_x", "v_0"}


def test_from_v_c_on_friction_is_mu_0_and_at_v_c_its_slope_is_zero_from_both_sides():
    """1 - cof/mu_0 grows from v_c down like the square of 1 - v_0/v_c, elastic, and like its power 3/2 on a dashpot."""
    for case, over in ((contact("cone", 10.0), 1.0), (RIGID, 1.0), (RIGID, 1.1), (BODY, 1.1), (KELVIN, 1.05)):
        v_0 = over * mdr.critical_velocity(case)
        powers = mdr.sensitivity(case, v_0, ["mu_0", "du_z", "v_0"]).elasticity()
        assert powers == pytest.approx({"mu_0": 1, "oscillation.du_z": 0, "v_0": 0}, abs=3e-4)


def test_a_corner_and_a_jump_are_told_with_both_sides():
    def bent(x):
        return abs(x - 3.0)

    def jumps(x):
        return 1.0 * (x > 3.0)

    for law, words in ((bent, "slope -1 below, 1 above, as there is a corner"), (jumps, "or a jump here")):
        found = slope(
            lambda x: x, "v_0", 3.0, 0.0, Functions.of_one(Function(lambda _, x, law=law: law(x), law(3.0), EPS))
        )
        assert np.isnan(found.value)
        assert words in found.why


@pytest.mark.parametrize(
    ("case", "v_0", "path", "words"),
    [
        (contact("cone", 10.0, nu=0.5), 1e-4, "material.nu", "below, nothing above, as nu must lie in"),
        (RIGID, 0.0, "v_0", "v_0 = 0 m/s is the limit of a pull forward"),
        (BODY, 1e-18, "v_0", "v_0 = 0 m/s is the limit of a pull forward"),
        (replace(BODY, pull=replace(BODY.pull, c_x=0.0)), 1e-4, "pull.c_x", "pull.c_x = 0 N s/m is zero: give a value"),
    ],
)
def test_what_has_no_derivative_is_said_by_name_and_is_no_number(case, v_0, path, words):
    found = mdr.sensitivity(case, v_0, [path])
    assert path not in found.d_cof
    assert path not in found.error["cof"]
    assert words in found.why["cof"][path]
    assert words in " ".join(str(found).split())
    assert path not in mdr.sensitivity(case, v_0).d_cof


def test_where_friction_falls_it_has_no_slope_at_v_c_but_in_what_v_c_does_not_know():
    """There it falls by a jump, of an elastic contact under a rigid pull, whose v_c knows neither mu_s nor u_z0."""
    rigid = contact("cone", 5.0)
    law = mdr.StaticKinetic(mu_s=0.5, mu_k=0.4)
    case = mdr.SlidingContact(rigid.indenter, rigid.material, oscillation=rigid.oscillation, friction=law)
    found = mdr.sensitivity(case, mdr.critical_velocity(case) * (1 - 5e-6), ["v_0", "mu_s", "mu_k"])
    assert set(found.d_cof) == {"mu_s"}
    assert found.d_cof["mu_s"] > 0
    assert all("as there is a corner or a jump here" in why for why in found.why["cof"].values())


def test_v_c_on_a_resonance_is_infinite_and_has_no_derivative():
    case = replace(BODY, pull=mdr.SpringPull(k_x=2e4, m=2e4 / 300.0**2))
    found = mdr.sensitivity(case, fields=["k_x"])
    assert found.v_c == np.inf
    assert found.d_v_c == {}
    assert found.elasticity("v_c") == {}
    assert found.why["v_c"] == {"pull.k_x": "it is infinite"}


def test_band_and_no_load_velocity_of_a_shaken_contact_are_those_of_differences():
    def band(case):
        held = mdr.holding_band(case)
        return held.high - held.low

    motion = mdr.NormalOscillation(u_z0=20e-6, du_z=15e-6, omega=300.0)
    case = replace(RIGID, oscillation=motion, shake=mdr.InPlaneOscillation(omega=300.0, du_x=60e-6, phi_x=1.2))
    weak = replace(case, shake=replace(case.shake, du_x=3e-6))
    drives, holds = (mdr.sensitivity(one, fields=["du_x", "mu_0", "frequency", "E"]) for one in (case, weak))
    assert (drives.band, drives.d_band) == (None, {})
    assert (holds.no_load_velocity, holds.d_no_load_velocity) == (None, {})
    assert drives.no_load_velocity == mdr.no_load_velocity(case)
    assert holds.band == band(weak)
    h = 1e-3
    for found, name, law, one in (
        (drives, "no_load_velocity", mdr.no_load_velocity, case),
        (holds, "band", band, weak),
    ):
        x = one.shake.du_x
        less, more = (law(with_value(one, "shake.du_x", x * (1 + k * h))) for k in (-1, 1))
        powers, missed = elasticities(found, name)
        beside = (more - less) / (2 * h) / getattr(found, name)
        assert powers["shake.du_x"] == pytest.approx(beside, abs=missed["shake.du_x"] + h**2)
        assert powers["material.E"] == pytest.approx(0, abs=missed["material.E"])  # of a rigid pull
    powers, missed = elasticities(drives, "no_load_velocity")  # lengths in the plane, over mu_0, are what it knows
    assert powers["shake.du_x"] + powers["mu_0"] == pytest.approx(1, abs=missed["shake.du_x"] + missed["mu_0"])


def test_bars_and_table_have_each_quantity_and_input():
    found = mdr.sensitivity(contact("cone", 10.0), 1e-4, ["E", "du_z", "mu_0", "v_0"])
    ax = found.plot()
    assert [one.get_xlabel() for one in ax.figure.axes] == ["COF [% per %]", "$v_c$ [% per %]", "static COF [% per %]"]
    assert [bar.get_width() for bar in ax.patches] == pytest.approx([*found.elasticity().values()])
    assert len(ax.get_yticks()) == 4
    alone = mdr.sensitivity(contact("cone", 10.0)).plot(plt.figure().add_subplot())
    assert alone.get_xlabel() == "$v_c$ [% per %]"
    assert len(alone.figure.axes) == 1
    head, *rows = found.table().splitlines()
    names = [f"{what} {name}" for name in ("cof", "v_c", "static_cof") for what in ("elasticity", "d", "error")]
    assert head.split(",") == ["input", "unit", "value", *names]
    of_v_0 = dict(zip(head.split(","), rows[3].split(","), strict=True))
    assert (of_v_0["input"], of_v_0["d v_c"]) == ("v_0", "")
    assert float(of_v_0["d cof"]) == found.d_cof["v_0"]


def test_it_prints_what_matters_most_first():
    found = mdr.sensitivity(contact("cone", 10.0), 1e-4, ["E", "du_z", "mu_0", "v_0"])
    lines = str(found).splitlines()
    assert lines[0] == "Sensitivity: per cent for each per cent of an input, at v_0 = 100 µm/s"
    assert [line.split()[0] for line in lines[2:]] == list(found.elasticity())
    with pytest.raises(ValueError, match="of must be one of cof, v_c, static_cof, band, no_load_velocity, got"):
        found.elasticity("load")
