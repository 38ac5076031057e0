"""The recipes of docs/hosts: derivatives in JAX and PyTorch are those of differences, where these are installed."""

from importlib import util
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import mdr

FOLDER = Path(__file__).parents[2] / "docs" / "hosts"
ELEMENT = mdr.ContactElement(mdr.Paraboloid(R=5e-3), mdr.Elastic(E=3e6, nu=0.4), 0.5, u_z_max=40e-6, n_springs=32)
U, DT = np.array([[3e-6, 1e-6, 2.1e-5], [6e-6, -2e-6, 1.9e-5]]), 1e-3
STATE = ELEMENT.at_rest((0.0, 0.0, 20e-6))
INPUTS, X, V_0 = ["oscillation.du_z", "material.E", "mu_0"], np.array([4e-6, 3e6, 0.5]), 1e-3


def recipe(name):
    """The module in_<name>.py."""
    spec = util.spec_from_file_location(f"in_{name}", FOLDER / f"in_{name}.py")
    module = util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def make(du_z, E, mu_0):
    """The contact of these inputs."""
    vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=du_z, omega=600.0)
    pull = mdr.SpringPull(k_x=1e4, m=0.01, c_x=2.0)
    return mdr.SlidingContact(mdr.FlatPunch(1e-3), mdr.Elastic(E=E, nu=0.4), mu_0, vibration, pull)


def cof(x):
    """Friction of a run whose springs and steps do not follow the inputs."""
    return mdr.slide(make(*x), V_0, n_springs=32, steps_per_period=1024).cof


def slopes(of, x, share=1e-4):
    """Central differences of a function, each input moved by this share of it."""
    sides = [[np.asarray(of(x + side * share * one)) for side in (-1, 1)] for one in np.diag(x)]
    return np.array([(high - low) / (2 * share * value) for (low, high), value in zip(sides, x, strict=True)])


def in_x(u):
    """F_x [N] at the end of a step."""
    return ELEMENT.step(STATE, DT, u)[0][0]


def test_in_jax():
    jax = pytest.importorskip("jax", reason="jax is not installed")
    hosts = recipe("jax")
    step = hosts.stepped(ELEMENT, DT)
    first = jax.jit(jax.grad(lambda u, state: step(u, state)[0][0]))
    for u in U:
        assert_allclose(step(u, STATE)[1], ELEMENT.step(STATE, DT, u)[1])
        assert_allclose(first(u, STATE), slopes(in_x, u), rtol=1e-5, atol=1e-2)
    many = jax.vmap(lambda u: jax.jacfwd(lambda one: step(one, STATE)[0])(u))(U)
    assert_allclose(many, [ELEMENT.step(STATE, DT, u, tangent=True)[2] for u in U])

    def twice(u, keep):
        state = step(u, STATE)[1]
        return step(1.2 * u, state if keep else jax.lax.stop_gradient(state))[0][0]

    with pytest.raises(NotImplementedError, match="through the memory"):
        jax.grad(twice)(U[0], True)
    assert np.isfinite(jax.grad(twice)(U[0], False)).all()
    friction = hosts.friction(make, INPUTS, V_0)
    assert_allclose(jax.grad(friction)(X) * X, slopes(cof, X) * X, rtol=1e-4, atol=1e-6)
    with pytest.raises(Exception, match="nu must lie in"):
        jax.grad(hosts.friction(incompressible, ["material.nu"], V_0))(np.array([0.5]))


def test_in_torch():
    torch = pytest.importorskip("torch", reason="torch")
    hosts = recipe("torch")
    us, state = torch.tensor(U, requires_grad=True), torch.tensor(STATE)
    states = state.expand(len(U), -1)
    F, _ = hosts.Step.apply(us, states, ELEMENT, DT)
    F[:, 0].sum().backward()
    for grad, u in zip(us.grad, U, strict=True):
        assert_allclose(grad, slopes(in_x, u), rtol=1e-5, atol=1e-2)
    u = us[0].detach().requires_grad_()
    for keep in (True, False):
        _, after = hosts.Step.apply(u, state, ELEMENT, DT)
        F, _ = hosts.Step.apply(1.2 * u, after if keep else after.detach(), ELEMENT, DT)
        if keep:
            with pytest.raises(RuntimeError, match="through the memory"):
                F[0].backward()
        else:
            F[0].backward()
    x = torch.tensor(X, requires_grad=True)
    hosts.Friction.apply(x, make, INPUTS, V_0).backward()
    assert_allclose(x.grad.numpy() * X, slopes(cof, X) * X, rtol=1e-4, atol=1e-6)
    with pytest.raises(ValueError, match="nu must lie in"):
        hosts.Friction.apply(torch.tensor([0.5]), incompressible, ["material.nu"], V_0)


def incompressible(nu):
    """A contact whose Poisson's ratio is an input."""
    vibration = mdr.NormalOscillation(u_z0=20e-6, du_z=4e-6, omega=600.0)
    return mdr.SlidingContact(mdr.FlatPunch(1e-3), mdr.Elastic(E=3e6, nu=nu), 0.5, vibration)
