"""Springs without Maxwell arms that stick, slip or fly for all of a step, as most of them do in most steps.

One loop without branches, which is vectorised, works out stick, slip and flight for every spring, and keeps the one
that surely lasts for all of the step. A spring of which none does is not handled here: line.py and disc.py follow it
from event to event.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

import numpy as np

from mdr.spring.contact import Answer
from mdr.spring.dragged import (
    EVEN,
    NO_PHI,
    TINY,
    area_and_moment,
    force_and_rates,
    is_short,
    point,
    scaled,
    slid,
    yielded,
)
from mdr.spring.law import phi_of
from mdr.spring.path import FAST, FAST_IN_PLANE, LENT, ROUNDING, Cubic, along, area_on_parabola, at, size_of, slope
from mdr.tools.jit import inner

TOUCHING = 1e-7  #: part of a step: a spring that has touched for less has a force along its motion


@inner(forceinline=True, error_model="numpy", fastmath=FAST, **LENT)
def whole_on_line(s, e, gap, w, path, zd, xd, h, T, modes, lumped, made):
    """The springs that do one thing for all of a step h along a line: their Answer.

    s, e (n,): compressions and extensions, updated. Of made the first n are filled with one, or with zero for a spring
    that is not handled. zd, xd: true rates of the top at the end of the step. lumped: as of `row`; theirs is added.

    A parabola lies below the line through its ends by no more than h²/8 of its curvature.
    """
    rate, fallen, z_1, z_2, x_1, x_2 = 0.0, 0.0, path.z_1, path.z_2, path.x_1, path.x_2
    if modes is not None:
        rate, fallen = modes.mu[0], np.exp(-modes.mu[0] * h)
    sink, go, z_end, x_end = h * (z_1 + h * z_2), h * (x_1 + h * x_2), z_1 + 2.0 * z_2 * h, x_1 + 2.0 * x_2 * h
    highest = max(path.z_0, path.z_0 + sink)
    if z_2 < 0.0 and 0.0 < -0.5 * z_1 / z_2 < h:
        highest = path.z_0 - 0.25 * z_1 * z_1 / z_2
    eighth = 0.125 * h * h
    dip, dip_ahead, dip_behind = max(z_2, 0.0), max(z_2 - x_2, 0.0), max(z_2 + x_2, 0.0)
    dip, dip_ahead, dip_behind = 2.0 * eighth * dip, 2.0 * eighth * dip_ahead, 2.0 * eighth * dip_behind
    dip_of_rate = eighth * rate * rate * rate
    # of the margins R - f and R + f that a force f has to slip forward and back, R its limit
    rate_ahead, rate_behind = z_1 - x_1 + 2.0 * T * (z_2 - x_2), z_1 + x_1 + 2.0 * T * (z_2 + x_2)
    area = moment = end = sticking = back = normal_area = normal_moment = normal_end = pressed = of_lumped = 0.0
    for i in range(gap.size):
        tol, z_0, s_0, e_0, w_i = ROUNDING * (1.0 + abs(gap[i])), path.z_0 - gap[i], s[i], e[i], w[i]
        R, R_1, f, f_1 = z_0 + T * z_1, z_0 + sink + T * z_end, e_0 + T * x_1, e_0 + go + T * x_end
        ahead, ahead_1, behind, behind_1 = R - f, R_1 - f_1, R + f, R_1 + f_1
        presses = (s_0 <= z_0 + tol) & (min(R, R_1) - dip > tol)
        flies = (s_0 > z_0 + tol) & (min(s_0, fallen * s_0) > highest - gap[i])
        sticks = presses & (min(ahead, ahead_1) - dip_ahead > tol) & (min(behind, behind_1) - dip_behind > tol)
        # slip, forward and back: s - e, and s + e, which relax as in flight; a lower bound of the slip velocity
        lag, lead = z_0 - e_0, z_0 + e_0
        vel = min(x_1 - z_1 - rate * lag, x_end - z_end - rate * fallen * lag) - dip_of_rate * max(-lag, 0.0)
        vel_back = min(-x_1 - z_1 - rate * lead, -x_end - z_end - rate * fallen * lead) - dip_of_rate * max(-lead, 0.0)
        begins = (ahead < -tol) | ((ahead <= tol) & (rate_ahead < 0.0))
        begins_back = (behind < -tol) | ((behind <= tol) & (rate_behind < 0.0))
        slips = presses & begins & (behind > tol) & (vel > 0.0)
        slips_back = presses & begins_back & (ahead > tol) & (vel_back > 0.0)
        # areas and moments of both forces
        normal, lever = area_on_parabola(z_0, z_1, z_2, T, h)
        held, held_lever = area_on_parabola(e_0, x_1, x_2, T, h)
        s_1, sign, slides = z_0 + sink, 1.0 if slips else -1.0, slips | slips_back
        e_1 = e_0 + go if sticks else (s_1 - fallen * lag if slips else fallen * lead - s_1)
        R, f = max(s_1 + T * zd, 0.0), e_0 + go + T * xd
        area += w_i * (held if sticks else (sign * normal if slides else 0.0))
        moment += w_i * (held_lever if sticks else (sign * lever if slides else 0.0))
        end += w_i * (max(min(f, R), -R) if sticks else (sign * R if slides else 0.0))
        sticking += w_i if sticks else 0.0
        back += w_i if slips_back else 0.0
        bears = w_i if sticks | slides else 0.0
        pressed += bears if R > 0.0 else 0.0
        normal_area += bears * normal
        normal_moment += bears * lever
        normal_end += bears * R
        of_lumped += w_i * (e_1 - s_1 if sticks else (-2.0 * s_1 if slips_back else 0.0))
        s[i] = fallen * s_0 if flies else (s_1 if sticks | slides else s_0)
        e[i] = fallen * e_0 if flies else (e_1 if sticks | slides else e_0)
        made[i] = 1.0 if sticks | slides | flies else 0.0
    if lumped is not None:
        lumped[0, 0] += of_lumped
    stuck = h * sticking
    return Answer(
        area, moment, end, stuck, 0.5 * h * stuck, sticking, back, normal_area, normal_moment, normal_end, pressed
    )


@inner(forceinline=True, error_model="numpy", fastmath=FAST_IN_PLANE, **LENT)
def whole_in_plane(s, e, gap, w, path, zd, xd, h, T, modes, each, made):
    """The springs that do one thing for all of a step h in the plane: their Answer.

    s, e (n,): compressions and extensions, which stay. made (4 n,): of each spring the new s, both parts of the new e,
    and one; or zero in the last place for a spring that is not handled, and then the others mean nothing. One array and
    steady strides, or else the loop is not vectorised. zd, xd: true rates of the top at the end of the step.
    """
    viscous, z_1, z_2 = modes is not None, path.z_1, path.z_2
    if not viscous:
        T = 0.0
    p, q = path.x_1, path.x_2
    v = Cubic(complex(p.real + 2.0 * T * q.real, p.imag + 2.0 * T * q.imag), scaled(2.0, q), 0.0j, 0.0j)
    last, fast = point(v, h), size_of(v.a)
    phi = phi_of(h / T) if viscous else NO_PHI
    base = Cubic(path.z_0 + T * z_1, z_1 + 2.0 * T * z_2, z_2, 0.0)
    R_dot, middle = slope(base, h), -0.5 * base.b / z_2 if z_2 > 0.0 else 0.0
    lowest = min(base.a, at(base, h))
    if 0.0 < middle < h:
        lowest = min(lowest, at(base, middle))
    fallen = np.exp(-h / T) if viscous else 0.0
    highest = max(path.z_0, path.z_0 + h * (z_1 + h * z_2))
    if z_2 < 0.0 and 0.0 < -0.5 * z_1 / z_2 < h:
        highest = path.z_0 - 0.25 * z_1 * z_1 / z_2
    bulge = 0.25 * h * h * (size_of(q) + max(z_2, 0.0))  # by which a force may come nearer to the rim than at both ends
    sink, go, top = h * (z_1 + h * z_2), scaled(h, p) + scaled(h * h, q), p + scaled(2.0 * h, q)
    area_x = area_y = moment_x = moment_y = end_x = end_y = sticking = 0.0
    normal_area = normal_moment = normal_end = pressed = 0.0
    for i in range(gap.size):
        tol, z_0, e_0 = ROUNDING * (1.0 + abs(gap[i])), path.z_0 - gap[i], e[i]
        R = Cubic(base.a - gap[i], base.b, base.c, 0.0)
        R_1 = at(R, h)
        g, f = e_0 + scaled(T, p), e_0 + go + scaled(T, top)
        rho = size_of(g)
        out, out_1 = rho - R.a, size_of(f) - R_1
        s_0, touches = s[i], (s[i] <= z_0 + tol) & (lowest - gap[i] > 0.0)
        flies = (s_0 > z_0 + tol) & (min(s_0, fallen * s_0) > highest - gap[i])
        sticks = touches & (max(out, out_1) + bulge < -tol)
        # slip
        n = scaled(1.0 / rho, g)
        ahead = along(v.a, n) - R.b
        vel = max(out, 0.0) / T if viscous else max(ahead, 0.0)
        n_1, l_1 = slid(n, vel, h, v, R, T, 1.0, phi, viscous, True, True)
        f_0 = force_and_rates(n, vel, v.a, v.b, R.a, R.b, 2.0 * z_2, T, 1.0)
        f_1 = force_and_rates(n_1, l_1, last, v.b, R_1, R_dot, 2.0 * z_2, T, 1.0)
        area, moment = area_and_moment(f_0, f_1, h)
        begins = ((out >= -tol) & (ahead > 0.0)) | (viscous & (out > tol))
        short = is_short(v.a, R.a + T * vel, h) & is_short(last, R_1, h)
        even = EVEN * (lowest - gap[i] + T * vel) >= max(R.a, R_1) + T * vel
        slips = touches & begins & (l_1 >= 0.0) & short & even & (rho > TOUCHING * h * fast)
        # stick
        held = scaled(h, e_0 + scaled(0.5 * h, p) + scaled(h * h / 3.0, q)) + scaled(T, go)
        lever = scaled(h * h, scaled(0.5, e_0) + scaled(h / 3.0, p) + scaled(0.25 * h * h, q))
        lever += scaled(T * h, e_0 + go) - scaled(T, held - scaled(T, go))
        w_i = w[i]
        area_x += w_i * (held.real if sticks else (area.real if slips else 0.0))
        area_y += w_i * (held.imag if sticks else (area.imag if slips else 0.0))
        moment_x += w_i * (lever.real if sticks else (moment.real if slips else 0.0))
        moment_y += w_i * (lever.imag if sticks else (moment.imag if slips else 0.0))
        R_end, f_end = max(z_0 + sink + T * zd, 0.0), e_0 + go + scaled(T, xd)  # by the true rates
        f_end = scaled(min(1.0, R_end / max(size_of(f_end), TINY)), f_end) if sticks else scaled(R_end, n_1)
        end_x += w_i * (f_end.real if sticks | slips else 0.0)
        end_y += w_i * (f_end.imag if sticks | slips else 0.0)
        sticking += w_i if sticks else 0.0
        bears = w_i if sticks | slips else 0.0
        pressed += bears if R_end > 0.0 else 0.0
        normal_area += bears * h * (R.a + h * (0.5 * R.b + h / 3.0 * R.c))
        normal_moment += bears * h * h * (0.5 * R.a + h * (R.b / 3.0 + 0.25 * h * R.c))
        normal_end += bears * R_end
        if each is not None:
            each.pressed_for[i], each.f_z[i] = (1.0, R_end) if sticks | slips else (0.0, 0.0)
            each.f[i] = f_end if sticks | slips else 0.0j
        e_1 = scaled(R_1 + T * l_1, n_1) - scaled(T, top)
        if viscous:
            e_1 = yielded(e_0, f_0[0], f_1[0], area, moment, h, T, phi) if h < T else e_1
        e_1 = e_0 + go if sticks else e_1
        made[4 * i + 0] = fallen * s_0 if flies else z_0 + sink
        made[4 * i + 1] = fallen * e_0.real if flies else e_1.real
        made[4 * i + 2] = fallen * e_0.imag if flies else e_1.imag
        made[4 * i + 3] = 1.0 if sticks | slips | flies else 0.0
    area, moment, end = complex(area_x, area_y), complex(moment_x, moment_y), complex(end_x, end_y)
    stuck = h * sticking
    return Answer(
        area, moment, end, stuck, 0.5 * h * stuck, sticking, 0.0, normal_area, normal_moment, normal_end, pressed
    )
