"""The step as a C function by its address: bit for bit that of the element, and bound to it alone."""

import copy
import ctypes
import pickle
from dataclasses import replace

import numpy as np
import pytest
from elements import ARMS, DOUBLES, ELASTIC, at, element
from numpy.testing import assert_array_equal

KIND = ctypes.CFUNCTYPE(ctypes.c_int, DOUBLES, DOUBLES, ctypes.c_double, DOUBLES, DOUBLES, DOUBLES)


# each is compiled, in some seconds
@pytest.mark.parametrize(
    ("material", "mu_s"), [(ELASTIC, None), (ARMS, None), (ELASTIC, 0.7)], ids=["elastic", "arms", "friction falls"]
)
def test_the_function_at_its_address_makes_the_steps_of_the_element(material, mu_s):
    contact = replace(element(material, n_springs=24), mu_s=mu_s)
    rng, step = np.random.default_rng(5), KIND(contact.address)
    state = own = contact.at_rest((0, 0, 20e-6))
    for k in range(12):
        u = rng.uniform((-40e-6, -40e-6, -10e-6), 40e-6)
        F, new, K = np.empty(3), np.empty_like(own), np.empty((3, 3))
        assert step(at(own), at(new), 1e-3, at(u), at(F), at(K) if k % 2 else None) == 1
        G, state, L = contact.step(state, 1e-3, u, tangent=True)
        assert_array_equal(F, G)
        assert_array_equal(new, state)
        if k % 2:
            assert_array_equal(K, L)
        own = new
    assert step(at(own), at(own), 1e-3, at(u), at(F), None) == 1  # over its own state
    assert_array_equal(own, contact.step(state, 1e-3, u)[1])
    hostile = [(1e-3, (0, np.nan, 0)), (1e-3, (0, 0, 41e-6)), (1e-3, (1.7e308, 0, 1e-6)), (-1e-3, u), (np.nan, u)]
    for dt, to in hostile + ([(0.0, u)] if material.tau or material.contact_arms else []):
        new, F = np.full(contact.n_state, 7.0), np.full(3, 7.0)
        assert step(at(own), at(new), dt, at(np.array(to, dtype=float)), at(F), None) == -1
        assert np.all(new == 7.0)
        assert np.all(F == 7.0)
    # compiled code changes nothing else about the record, and does not travel with it
    copies = pickle.loads(pickle.dumps(contact)), copy.deepcopy(contact)
    assert all(one == contact and hash(one) == hash(contact) and repr(one) == repr(contact) for one in copies)
    assert all("_c_function" not in vars(one) for one in copies)
    assert contact.address == contact.address != 0
