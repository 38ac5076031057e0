"""What users are promised: the names, how they are called, and that importing them is light."""

import ast
import inspect
import re
import runpy
import subprocess
import sys
from dataclasses import fields
from importlib import metadata
from operator import attrgetter
from pathlib import Path

import pytest

import mdr

ROOT = Path(__file__).parents[1]

SIGNATURES = {
    "FlatPunch": "a",
    "Cone": "theta",
    "Paraboloid": "R",
    "PowerLaw": "n, c",
    "Sphere": "R",
    "Ellipsoid": "R, k",
    "Hyperboloid": "h, c",
    "TruncatedCone": "b, theta",
    "TruncatedParaboloid": "b, R",
    "RoundedPunch": "b, R",
    "RoughFace": "l_e, a_0",
    "CappedCone": "b, theta",
    "CappedParaboloid": "R1, R2, b",
    "ConstantPressure": "a_0, d_0",
    "ConcavePunch": "a, R",
    "Profile": "f, *, kinks=(), r_max=None, name=None",
    "SampledProfile": "r, f, ...",
    "FromForce": "d, F, E_star, ...",
    "indent": "indenter, material, t, u_z=None, *, F_z=None, ...",
    "Indenter.profile_3d": "r",
    "Indenter.profile_1d": "x",
    "Indenter.contact_radius": "d",
    "Indenter.force": "d, E_star",
    "Indenter.stiffness": "d, E_star",
    "Indenter.pressure": "r, d, E_star",
    "Elastic": "E, nu",
    "KelvinVoigt": "E, nu, tau",
    "ElasticPair": "E_1, nu_1, E_2, nu_2",
    "StandardLinearSolid": "E_inf, E_1, tau_1, nu",
    "Prony": "E_inf, arms, nu, tau=0.0",
    "Material.dynamic_modulus": "omega",
    "KelvinVoigt.from_shear": "*, G, eta, nu",
    "KelvinVoigt.from_loss_tangent": "*, E, nu, tan_delta, omega",
    "NormalOscillation": "u_z0, du_z, omega",
    "PeriodicMotion": "omega, u_z0, cos=(), sin=()",
    "PeriodicMotion.from_acceleration": "t, a, *, u_z0, frequency=None",
    "PeriodicMotion.from_velocity": "t, v, *, u_z0, frequency=None",
    "PeriodicMotion.from_displacement": "t, u, *, u_z0, frequency=None",
    "displacement_of": "t, a, *, high_pass, order=2",
    "read_record": "path, *, units=None, columns=None, skip=None, table=None, rate=None, sensitivity=None",
    "LoadOscillation": "F_z0, dF_z, omega, m_z=0.0",
    "ConstantDepth": "u_z0",
    "ConstantLoad": "F_z0",
    "InPlaneOscillation": 'omega, du_x=0.0, phi_x=0.0, du_y=0.0, phi_y=0.0, at="tool"',
    "InPlaneMotion": 'omega, x_cos=(), x_sin=(), y_cos=(), y_sin=(), at="tool"',
    "RigidPull": "",
    "SpringPull": "k_x, m=0.0, c_x=0.0, k_y=None, c_y=None",
    "SlidingContact": "indenter, material, mu_0=None, oscillation=None, pull=RigidPull(), shake=None, tau_0=0.0, "
    "friction=None, *, mu_s=None",
    "Coulomb": "mu_0",
    "ShearStrength": "mu_0, tau_0",
    "StaticKinetic": "mu_s, mu_k",
    "partial_slip": "indenter, material, mu_0, u_z0, u_x",
    "critical_velocity": "case, direction=1",
    "full_slip_critical_velocity": "case, direction=1",
    "static_cof": "case",
    "holding_band": "case",
    "blocked_cof": "case",
    "no_load_velocity": "case",
    "slide": "case, v_0, *, n_springs=None, steps_per_period=None, n_periods=None, "
    'start="full_slip", record=0, lump=True, limit_s=None, accuracy=1e-05',
    "ContactElement": "indenter, material, mu_0, *, u_z_max, n_springs=256, mu_s=None",
    "ContactElement.step": "state, dt, u, tangent=False",
    "slide_record": "indenter, material, mu_0, t, u_x, u_y=None, u_z=None, *, F_z=None, n_springs=None, mu_s=None",
    "random_cof": "case, spectrum, v_0, *, n_realisations=64, seed=0, n_springs=None",
    "Spectrum": "f, density",
    "Spectrum.band": "rms, f_low, f_high",
    "cof_curve": "case, v_0, *, method=None, n_springs=None, steps_per_period=None, accuracy=1e-05",
    "find": "case, path, *, v_0=None, cof=None, share=None, v_c=None, smooth=False, within=None, held=None",
    "least_velocity": "case, v_0",
    "tolerance": "case, v_0, by=0.1, fields=None, *, held=None",
    "sensitivity": "case, v_0=None, fields=None, *, held=None, accuracy=1e-05",
    "propagate": "case, spread, v_0=None, *, held=None, samples=1000, seed=0, accuracy=1e-05",
    "sweep": 'case, axes, store=None, executor=None, quantities=("cof",), *, chunk_seconds=5.0, shard=None, '
    "n_springs=None, steps_per_period=None, accuracy=1e-05, held=None",
    "read_study": "path",
    "Study.select": "values",
    "Study.to_netcdf": "path",
    "Study.to_csv": "path",
    "Study.to_xarray": "",
    "Quantity": 'name, unit, of, meaning="", *, per_velocity=False',
    "measure_critical_velocity": 'case, direction=1, *, start="full_slip", limit_s=None, accuracy=1e-05',
    "verdict": "case, *, within=0.01, limit_s=None, accuracy=1e-05, three_dimensions=False",
    "laws.waveform_loss": "w, beta",
    "laws.steepest_waveform": "n_harmonics",
    "waveforms.sawtooth": "u_z0, du_z, omega, *, n_harmonics, falling=False",
    "waveforms.square": "u_z0, du_z, omega, *, n_harmonics",
    "waveforms.pulse": "u_z0, du_z, omega, *, n_harmonics, width",
    "half_space.slide": "case, v_0, *, cells=None, steps_per_period=None, n_periods=None, coupled=True, "
    'start="full_slip", limit_s=None',
    "half_space.curve": "case, v_0, *, cells=None, steps_per_period=None, n_periods=None, coupled=True, "
    'start="full_slip", limit_s=None',
}
RECORDS = {
    "SlidingRun": "cof cof_error settled kind why stick_share mean_F_x mean_F_z energy_balance t u_x F_x F_z x state",
    "normal.indentation.Indentation": "t u_z F_z contact_radius",
    "normal.partial_slip.PartialSlip": "F_x F_z stick_radius",
    "SlideRecord": "t u_z F_x F_y F_z cof cof_error running_cof energy_balance",
    "RandomCof": "v_0 cof standard_error cof_error realisations",
    "CofCurve": "v_0 cof cof_error settled stick_share v_c",
    "friction.find.Found": "path values why cases",
    "friction.sensitivity.Sensitivity": (
        "v_0 inputs cof d_cof v_c d_v_c static_cof d_static_cof band d_band no_load_velocity d_no_load_velocity "
        "error why"
    ),
    "studies.propagate.Propagated": "v_0 inputs spread cof cof_sd cof_share v_c v_c_sd v_c_share samples why",
    "friction.tolerance.Tolerance": "by v_0 base_cof base_v_c inputs cof v_c warnings",
    "friction.measured_velocity.MeasuredVelocity": "v_c low high kind why",
    "friction.shaken.HoldingBand": "low high",
    "half_space.HalfSpaceRun": "cof cof_y cof_error grid_error step_error cycle_error settled kind why stick_share "
    "mean_F_x mean_F_y mean_F_z v_0 mu_0 coupled cells steps_per_period n_periods x y t pressure q_x q_y stick",
    "half_space.HalfSpaceCurve": "v_0 cof cof_y cof_error grid_error step_error cycle_error settled",
    "friction.verdict.Verdict": "eq_15 full_slip measured deviation holds why within",
}


def bare(signature):
    """A signature without its annotations, as it is called."""
    parameters = [
        p.replace(annotation=inspect.Parameter.empty) for p in signature.parameters.values() if p.name != "self"
    ]
    return str(inspect.Signature(parameters)).replace("'", '"').replace("<factory>", "RigidPull()")


@pytest.mark.parametrize("name", SIGNATURES)
def test_names_are_called_as_promised(name):
    called, first, rest = bare(inspect.signature(attrgetter(name)(mdr))), *SIGNATURES[name].partition("...")[:2]
    assert called.startswith(f"({first}") if rest else called == f"({first})"


@pytest.mark.parametrize("name", RECORDS)
def test_results_carry_what_was_promised(name):
    assert set(RECORDS[name].split()) <= {field.name for field in fields(attrgetter(name)(mdr))}


def test_modes_have_their_names():
    assert [mode.name for mode in mdr.State] == ["FREE", "STICK", "SLIP", "SLIP_BACK"]


def test_the_list_of_names_is_whole():
    assert len(set(mdr.__all__)) == len(mdr.__all__)
    assert [name for name in mdr.__all__ if not hasattr(mdr, name)] == []
    promised = {name.partition(".")[0] for name in SIGNATURES} | {name for name in RECORDS if "." not in name}
    assert promised | {"State"} <= set(mdr.__all__)


def test_completion_offers_public_names_alone():
    assert set(dir(mdr)) == {*mdr.__all__, "__version__"}


def test_version_is_that_of_the_distribution():
    assert mdr.__version__ == metadata.version("mdr-friction")


def test_a_folder_that_was_never_installed_has_no_version(monkeypatch):
    def unknown(name):
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", unknown)
    assert runpy.run_path(ROOT / "mdr" / "tools" / "version.py")["__version__"] == "0+unknown"


def test_import_is_light():
    heavy = ["matplotlib", "tqdm", "scipy.optimize", "scipy.integrate", "scipy.fft", "scipy.io", "dask", "xarray"]
    heavy += ["mdr.plots", "mdr.__main__", "numba"]
    code = f"""
import sys, mdr
assert not [name for name in {heavy!r} if name in sys.modules]
from contextlib import suppress
from mdr.__main__ import main
for words in (["--help"], ["help"], ["velcity"], ["velocity", {str(ROOT / "docs" / "example.toml")!r}]):
    with suppress(SystemExit):
        main(words)
assert "numba" not in sys.modules
import mdr.plots
assert "matplotlib" not in sys.modules
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_what_type_checkers_see_is_what_is_imported_later():
    tree = ast.parse((ROOT / "mdr" / "__init__.py").read_text(encoding="utf-8"))
    block = next(one for one in tree.body if isinstance(one, ast.If))
    seen = {alias.name: f"{one.module}.{alias.name}" for one in block.body for alias in one.names}
    later = {name: f"{home}.{name}" for home, names in mdr._LATER.items() for name in names}
    modules = {"laws": "mdr.closed_forms.laws", "studies": "mdr.studies", "half_space": "mdr.half_space"}
    assert seen | {name: f"{home}.{name}" for name, home in modules.items()} == later
    for name in later:
        assert getattr(mdr, name) is not None
    with pytest.raises(AttributeError, match="module 'mdr' has no attribute 'slid'"):
        _ = mdr.slid


def test_the_example_file_is_the_case_of_the_readme():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    script = re.search(r"```python\n(.*?)```", text, re.DOTALL)[1]
    names = {}
    exec(script[: script.index("run =")], names)
    assert mdr.read_case(ROOT / "docs" / "example.toml") == names["case"]


def test_the_supported_pythons_are_those_of_the_workflow():
    told = re.findall(r"Python :: (3\.\d+)", (ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    workflow = (ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8")
    (run,) = re.findall(r"python: \[(.*)\]", workflow)
    assert re.findall(r"3\.\d+", run) == told
    assert set(re.findall(r'python: "(.*?)"', workflow)) == {told[0], told[-1]}
    assert ".ci/run" in workflow
