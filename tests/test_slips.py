"""Slips that people make at a keyboard, and the words in which each is answered: what is wrong, and what to do.

`python tests/test_slips.py` prints the whole messages.
"""

import numpy as np  # noqa: F401  (in the slips)
import pytest

import mdr

BALL, RUBBER, SLED = mdr.Paraboloid(5e-3), mdr.KelvinVoigt(3e6, 0.5, 1e-3), mdr.SpringPull(2e4, 0.1, 4.0)
TAPPING = mdr.NormalOscillation(20e-6, 2e-6, 314.0)
CASE = mdr.SlidingContact(BALL, RUBBER, 0.5, TAPPING, SLED)
SOME = mdr.FrictionData([1e-4, 2e-4, 3e-4], [0.4, 0.45, 0.5])
CONE = 'mu_0 = 0.5\n[indenter]\nshape = "Cone"\n'

SLIPS = {
    # shapes
    'Paraboloid("5 mm")': "R must be a real number, got '5 mm'",
    "Paraboloid(-5e-3)": "R must be positive, got -0.005 (radius of curvature in m)",
    'Paraboloid(float("nan"))': "R must be a finite number",
    "Paraboloid(np.array([1.0, 2.0]))": "R must be a real number",
    "Paraboloid(None)": "got None",
    "Paraboloid(r=5e-3)": "Paraboloid takes no r; did you mean R?",
    "FlatPunch()": "missing 1 required positional argument: 'a'",
    "Cone(45)": "45 degrees are 0.785",
    'Cone("1°")': "theta must be a real number",
    "Profile([0, 1, 2])": "f must be a function of the radius",
    "SampledProfile([0, 1e-3], [0, 1e-5])": "at least 6 numbers",
    # materials
    "KelvinVoigt(3e6, 50, 1e-3)": "rubber is 0.5",
    "KelvinVoigt(-3e6, 0.5, 1e-3)": "E must be positive, got -3000000.0 (Young's modulus in Pa)",
    "KelvinVoigt(3e6, 0.5, -1)": "tau must not be negative, got -1.0 (relaxation time in s)",
    "KelvinVoigt(E=3e6, nu=0.5, tan_delta=0.2)": "use KelvinVoigt.from_loss_tangent",
    "KelvinVoigt(E=3e6, nu=0.5, G=1e6)": "use KelvinVoigt.from_shear",
    "Prony(3e6, (2e6, 1e-2), 0.5)": "a sequence of pairs (E_j, tau_j)",
    # motion and pull
    "NormalOscillation(2e-5, 2e-6, 0)": "omega must be positive, got 0.0 (angular frequency in rad/s)",
    "NormalOscillation(2e-5, -2e-6, 300)": "du_z must be positive",
    "NormalOscillation(-3e-6, 2e-6, 300)": "never touches; raise u_z0",
    "NormalOscillation(uz0=2e-5, du_z=2e-6, omega=3)": "did you mean u_z0?",
    "LoadOscillation(0.1, 0.2, 300)": "lower dF_z, or give m_z",
    "SpringPull(0)": "for a rigid pull use RigidPull()",
    "SpringPull(kx=2e4)": "did you mean k_x?",
    "SpringPull(2e4, -1)": "m must not be negative",
    "InPlaneOscillation(300.0, 1e-6, du_y=1e-6)": "du_y must be zero",
    'InPlaneOscillation(300.0, 1e-6, at="pulling")': 'at must be "tool"',
    # a contact
    "SlidingContact(RUBBER, BALL, 0.5, TAPPING)": "indenter must be of kind Indenter, got KelvinVoigt",
    "SlidingContact(mdr.Paraboloid, RUBBER, 0.5, TAPPING)": "write Paraboloid(...)",
    'SlidingContact(BALL, RUBBER, "0.5", TAPPING)': "mu_0 must be a real number, got '0.5'",
    "SlidingContact(BALL, RUBBER, 0, TAPPING)": "mu_0 must be positive",
    "SlidingContact(BALL, RUBBER, 0.5)": "missing 1 required positional argument: 'oscillation'",
    "SlidingContact(BALL, RUBBER, 0.5, mdr.ConstantDepth(2e-5))": "nothing oscillates",
    "SlidingContact(mdr.Sphere(1e-5), RUBBER, 0.5, mdr.NormalOscillation(1e-3, 1e-6, 300))": "press less",
    "SlidingContact(BALL, RUBBER, 0.5, TAPPING, shake=mdr.InPlaneOscillation(300.0, 1e-6))": "whole numbers up to 16",
    "critical_velocity(mdr.SlidingContact(mdr.Sphere(1e-3), RUBBER, 1, mdr.LoadOscillation(1e9, 1, 3)))": "lower it",
    "rig(BALL, RUBBER, 0.5, frequency=50, load=1, load_amplitude=0.1, k_x=2e4)": "m is missing",
    "rig(BALL, RUBBER, 0.5, frequency=50, load=1, load_amplitude=0.1, k_x=2e4, m=0.1)": "Say load_rides=True",
    # questions
    "slide(CASE)": "missing 1 required positional argument: 'v_0'",
    'slide(CASE, "fast")': "v_0 must be a real number",
    "slide(CASE, -1e-3)": "the other way is the same where nothing shakes in the plane",
    'slide(CASE, float("nan"))': "v_0 must be a finite number",
    "slide(CASE, 1e-3, n_springs=1)": "n_springs must be at least 32",
    "slide(CASE, 1e-3, n_springs=40.5)": "n_springs must be a whole number",
    "slide(CASE, 1e-3, steps_per_period=3)": "steps_per_period must be at least 32",
    'slide(CASE, 1e-3, start="Rest")': 'start must be "full_slip" or "rest"',
    "slide(CASE, 1e-3, accuracy=1e-12)": "accuracy must lie between 1e-08 and 0.001",
    'slide("case.toml", 1e-3)': "case must be a SlidingContact, got 'case.toml'",
    "cof_curve(CASE, [])": "v_0 must be a list of velocities",
    'cof_curve(CASE, [1e-3], method="closed")': 'method must be None or "march"',
    "critical_velocity(CASE, 0)": "direction must be 1 (forward) or -1",
    "verdict(CASE, within=5)": "0.01 for 1 %",
    'sweep(CASE, {"oscillation.uz0": [1e-5]})': "did you mean oscillation.u_z0?",
    "sweep(CASE, {})": "axes must name at least one path",
    'sweep(CASE, {"mu_0": [0.1]})': 'give an axis "v_0"',
    'sweep(CASE, {"mu_0": "0.1"})': "write [...]",
    'fit(CASE, SOME, ["mu0"])': "did you mean mu_0?",
    'fit(CASE, mdr.FrictionData([1e-4], [0.4]), ["mu_0", "tau"])': "2 parameters need more than 1 measurements",
    # files
    'read_case("nofile.toml")': "cannot be read: No such file",
    'parse_case("mu_0 = 0,5")': "write one number in SI",
    'parse_case("mu_0 = 0.5")': "[indenter] is missing",
    'parse_case(CONE + "theta = 1 deg")': "without unit or arithmetic",
    'parse_case(CONE + "angle = 0.1")': "angle is no key of Cone; there are shape, theta, theta_deg",
}


def message(slip):
    with pytest.raises((TypeError, ValueError)) as refused:
        eval(f"mdr.{slip}")
    return str(refused.value)


@pytest.mark.parametrize("slip", SLIPS)
def test_a_slip_is_answered_in_words(slip):
    assert SLIPS[slip] in message(slip)


if __name__ == "__main__":
    print(*(f"{slip}\n    {message(slip)}" for slip in SLIPS), sep="\n")
