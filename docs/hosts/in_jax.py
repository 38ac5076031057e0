"""A contact and its friction in JAX, with their derivatives. Tried with jax 0.10.2 on a CPU, beside differences."""

import jax
import numpy as np
from jax.custom_derivatives import SymbolicZero

import mdr

jax.config.update("jax_enable_x64", True)  # single precision has too few digits for steps of nanometres


def stepped(element, dt):
    """The step of an element: step(u, state) gives F and the new state. Its derivative is dF/du, in one step."""
    shapes = [jax.ShapeDtypeStruct(of, float) for of in ((3,), (element.n_state,), (3, 3))]

    def host(u, state):
        return element.step(state, dt, u, tangent=True)

    def known(u, state):
        return jax.pure_callback(host, shapes, u, state, vmap_method="broadcast_all")

    def rule(at, along):
        if not isinstance(along[1], SymbolicZero):
            raise NotImplementedError("no derivative through the memory of a contact: stop_gradient(state)")
        F, new, K = known(*at)
        return (F, new), (K @ along[0], 0 * along[0][0] * new)  # no constant: it is seen by a further step

    step = jax.custom_jvp(lambda u, state: tuple(known(u, state)[:2]))
    step.defjvp(rule, symbolic_zeros=True)
    return step


def friction(make, inputs, v_0):
    """The COF of the contact make(*x) as cof(x), x being the values of its inputs, such as "oscillation.du_z"."""

    def host(x):
        found = mdr.sensitivity(make(*np.asarray(x).tolist()), v_0, inputs)
        for reason in found.why["cof"].values():
            raise ValueError(reason)
        return np.array(found.cof), np.array([*found.d_cof.values()])

    def known(x):
        shapes = [jax.ShapeDtypeStruct(of, float) for of in ((), (len(inputs),))]
        return jax.pure_callback(host, shapes, x, vmap_method="sequential")

    def rule(at, along):
        cof, slopes = known(*at)
        return cof, slopes @ along[0]

    cof = jax.custom_jvp(lambda x: known(x)[0])
    cof.defjvp(rule)
    return cof
