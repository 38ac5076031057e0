"""Press and release of a half-space with memory after Lee and Radok (1960) and Ting (1966), without any springs.

Depth u(t) rises to its maximum and falls again. Up to the maximum the contact has the radius a(u) of the elastic one
and F = int_0^t E(t - s) d phi(u(s)), phi the elastic force over E*. Afterwards the contact radius is that of an earlier
instant t_1(t) of the rise, at which

    int_{t_1}^t E(t - s) u'(s) ds = 0,    F(t) = int_0^{t_1} E(t - s) d phi(u(s)),

until t_1 = 0, the end of contact. E(t) = E_inf + E_1 exp(-t/tau_1) + E_inf tau delta(t): the delta acts at s = t, adds
E_inf tau u'(t) to the first integral and, while the contact grows, E_inf tau d phi/dt to the force.

Quadrature: Gauss with as many nodes as half a sine needs; roots by bisection.
"""

import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(64)


class Press:
    """Half a sine of depth, u = d sin(pi t/P), on a standard solid (tau = 0) or a Kelvin body (E_1 = 0).

    phi(u) = c u^power: 4/3 sqrt(R) u^(3/2) for the paraboloid, 2 u²/(pi tan(theta)) for the cone; contact moduli.
    """

    def __init__(self, d, P, E_inf, E_1=0.0, tau_1=1.0, tau=0.0, *, c, power):
        self.d, self.P, self.E_inf, self.E_1, self.tau_1, self.tau = d, P, E_inf, E_1, tau_1, tau
        self.c, self.power = c, power

    def u(self, t):
        return self.d * np.sin(np.pi * t / self.P)

    def u_dot(self, t):
        return self.d * np.pi / self.P * np.cos(np.pi * t / self.P)

    def E(self, t):
        return self.E_inf + self.E_1 * np.exp(-t / self.tau_1)

    def phi_dot(self, t):
        return self.c * self.power * self.u(t) ** (self.power - 1) * self.u_dot(t)

    def integral(self, f, low, high):
        """Int f(s) ds, s = low + (high - low) x², which tames the root at the start."""
        x = 0.5 * (NODES + 1)
        return float(np.sum(WEIGHTS * x * (high - low) * f(low + (high - low) * x**2)))

    def balance(self, t_1, t):
        """The left side of the equation for t_1."""
        return self.integral(lambda s: self.E(t - s) * self.u_dot(s), t_1, t) + self.E_inf * self.tau * self.u_dot(t)

    def t_1(self, t):
        """The instant of the rise with the contact as wide as at t; t itself while it grows, 0 after the end."""
        if self.balance(t, t) >= 0 and self.tau > 0:
            return t  # a dashpot turns into tension before anything else, at u' = 0
        if t <= self.P / 2:
            return t
        low, high = 0.0, self.P / 2
        if self.balance(low, t) <= 0:
            return 0.0
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.balance(middle, t) > 0 else (low, middle)
        return low

    def force(self, t):
        """F(t), zero after the end of contact."""
        t_1 = self.t_1(t)
        F = self.integral(lambda s: self.E(t - s) * self.phi_dot(s), 0.0, t_1)
        return F + (self.E_inf * self.tau * self.phi_dot(t) if t_1 == t else 0.0)

    def depth_of_contact(self, t):
        """The depth u(t_1), at which the elastic contact has the radius of this one."""
        return self.u(self.t_1(t))

    def end(self):
        """The end of contact: t_1 = 0."""
        low, high = self.P / 2, self.P
        for _ in range(100):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.balance(0.0, middle) > 0 else (low, middle)
        return low
