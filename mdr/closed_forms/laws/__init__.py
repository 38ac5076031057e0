"""Laws that the paper does not have: where Eq. (1) and Eq. (15) end, how large their error is, what v_c is beyond, and
what becomes of friction where the contact is shaken in the plane, or at random.

They were derived here, and each is tested beside runs or beside the full-slip condition by a claim of the report
(`python -m validation`), named in brackets at its end. "Eq. (n)" alone is the paper, see mdr/closed_forms/paper.py.

Symbols: alpha = du_z/u_z0 [-], T = omega tau [-], the loss tangent of a Kelvin material (0 if elastic), phi = omega t
phase of the oscillation, v_1 = mu_0 kappa omega du_z velocity of Eq. (1) [m/s], kappa = E*/G* [-], k_zc, k_xc contact
stiffness at the mean depth [N/m], F_N normal force [N], H receptance of the pull [m/N], omega_0 natural frequency of
the body [rad/s], n power of a shape f ~ r^n, infinite for a flat punch.

Rigid pull, contact lost
    In full slip every spring in contact slips at v_0 - v_1 (-sin phi). So v_c = v_1 if any spring touches at phi =
    -pi/2, where the depth grows fastest. The centre touches longest. Its surface, once left, relaxes like
    exp(-theta/T), so it is back at the phase phi_c given by `touch_depth`, and v_c = v_1 sin|phi_c| if that is late.

Rigid pull, springs that stick for d in each period T
    What another velocity adds to the way of a spring in stick, slip forgets; the instants at which a stick begins and
    ends are those at which the velocity of slip is zero and the force is continuous, so that they add nothing. The
    slope of the mean force is that of k_x (t - t_1) over d, k_x d²/2T; of a slow motion see `stick_impedance`.

Body, flat punch that has just been lost
    With alpha sqrt(1 + T²) = 1 + eps contact is lost around the phase pi - arctan T, where the punch would press by
    k_zc u_z0 (x² - a²)/2, a² = 2 eps, x the phase from there. Elastic: a pull lasting from -a to a is missing, an
    impulse of k_zc u_z0 times (4 sqrt(2)/3) eps^(3/2). Kelvin: the spring stays off until its relaxed surface is met,
    where the integral of the force times exp(x/T) vanishes, at x = 2 a: what was missing as a pull is missing again as
    pressure. What remains is a doublet, with the impulse and the first moment k_zc u_z0 (9/2) eps² times 1/T and -1.
    The body passes these on by its free oscillation.

Body, slow material, T >> 1
    The surface hardly recovers while it is left. A spring of stiffness k whose greatest compression is d loses
    2 pi d/T of it in a period, and is pressed back through as much from the phase -delta to the deepest point, so
    du_z delta²/2 = 2 pi d/T. It presses like a dashpot, by k T du_z times the phase that is left: a blow, whose impulse
    is that of k d over the whole period. The blows of all springs end together, at the deepest point.

Face with a shear strength, abs(tau) <= tau_0 + mu_0 p
    A spring that the edge of contact has just reached has a limit that grows like the root of time, faster than any
    pull: it sticks at any velocity, until v_0 t has come to it. So a curved elastic face has no critical velocity; what
    is lost falls like v_0^-3 by springs. It falls exponentially on a half-space, where a ring at the edge sticks whose
    width is 32 a exp(-pi G* v_0/(2 tau_0 a')).

Friction that falls, mu_s > mu_k
    A spring that keeps contact slips throughout above Eq. (1) with mu_k, and does not know mu_s. Below it sticks until
    its force, on a straight line, has come to mu_s f_z. So friction overshoots, and falls by a jump at v_c
    (`falling_friction`). A body on a spring does stick-slip without vibration (`stick_slip`), unless a damper ends it
    (`stick_slip_end`), or a vibration (`dither_force`).

Body, finite amplitude
    A curved contact grows and shrinks within the period. With s = d ln k_zc/d ln d the normal force is, to second order
    in du_z, F(u_z0) + k_zc du_z [p + alpha s q], p = cos(phi) - T sin(phi), q = (2 e p - e²)/2, where u_z0 + du_z e is
    the depth at the edge of the contact. The receptance turns each harmonic of q into a motion of the body.
"""

from mdr.closed_forms.across import held_across
from mdr.closed_forms.coupling import coupled_critical_velocity, coupling_loss, radial_rub
from mdr.closed_forms.laws.across import excess_across, lost_across, rigid_across, steered_across, stiffened_by_coupling
from mdr.closed_forms.laws.bodies import (
    LeastOverDepth,
    blow,
    depth_sensitivity,
    first_order,
    half_a_blow,
    harmonic_share,
    least_over_depth,
    load_error,
    lock_in,
    onset,
    resonance_residue,
    stiffness_exponent,
)
from mdr.closed_forms.laws.falling import FallingFriction, falling_friction
from mdr.closed_forms.laws.limit_cycle import StickSlip, dither_force, stick_slip, stick_slip_end
from mdr.closed_forms.laws.random import random_end, random_friction, random_loss, slow_random_loss
from mdr.closed_forms.laws.rigid_pull import (
    amplitude_limit,
    edge_band,
    late_return,
    rise_of_lost_punch,
    slow_limit,
    stick_impedance,
    touch_depth,
)
from mdr.closed_forms.laws.shaken import EllipticDrive, elliptic_drive, held_under_shake, lost_under_shake, rigid_shake
from mdr.closed_forms.laws.strength import full_slip_of_half_space, lost_at_the_edge, velocity_of_share
from mdr.closed_forms.laws.waveform import best_waveform, steepest_waveform, waveform_critical, waveform_loss

__all__ = [
    "EllipticDrive", "FallingFriction", "LeastOverDepth", "StickSlip", "amplitude_limit", "best_waveform", "blow",
    "coupled_critical_velocity", "coupling_loss", "depth_sensitivity", "dither_force", "edge_band", "elliptic_drive",
    "excess_across", "falling_friction", "first_order", "full_slip_of_half_space", "half_a_blow", "harmonic_share",
    "held_across", "held_under_shake", "late_return", "least_over_depth", "load_error", "lock_in", "lost_across",
    "lost_at_the_edge", "lost_under_shake", "onset", "radial_rub", "random_end", "random_friction", "random_loss",
    "resonance_residue", "rigid_across", "rigid_shake", "rise_of_lost_punch", "slow_limit", "slow_random_loss",
    "steepest_waveform", "steered_across", "stick_impedance", "stick_slip", "stick_slip_end",
    "stiffened_by_coupling", "stiffness_exponent", "touch_depth", "velocity_of_share", "waveform_critical",
    "waveform_loss",
]  # fmt: skip
