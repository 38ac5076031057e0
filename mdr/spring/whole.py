"""Springs without arms that stick, slip or fly for all of a step: most of them in most steps.

What turning.py follows from event to event is here the case that nothing happens. One loop without branches, which is
vectorised, works out all modes for every spring, keeps the one that surely holds, and leaves the other springs alone.
"""

# mypy: disallow-untyped-defs=false, disallow-untyped-calls=false
from __future__ import annotations

import numpy as np

from mdr.spring.contact import Answer
from mdr.spring.dragged import EVEN, NO_PHI, area_and_moment, force_and_rates, is_short, point, scaled, slid, yielded
from mdr.spring.law import phi_of
from mdr.spring.path import FAST, LENT, ROUNDING, Cubic, along, at, size_of, slope
from mdr.tools.jit import inner

TOUCHING = 1e-7  #: part of a step for which a spring has touched whose force has the direction of its motion


@inner(error_model="numpy", fastmath=FAST, **LENT)
def whole(s, e, gap, w, path, h, T, modes, each, made):
    """The springs that do one thing for all of a step h: their Answer.

    s, e (n,): compressions and extensions. made (4 n,) is filled with what these come to, and then one; or with
    zero for a spring that is left alone. One array and steady strides, or else the loop is not vectorised.
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
    share = pressed = pressed_moment = pressed_end = 0.0
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
        end_x += w_i * (f.real if sticks else (f_1[0].real if slips else 0.0))
        end_y += w_i * (f.imag if sticks else (f_1[0].imag if slips else 0.0))
        sticking += w_i if sticks else 0.0
        bears = w_i if sticks | slips else 0.0
        share += bears
        pressed += bears * h * (R.a + h * (0.5 * R.b + h / 3.0 * R.c))
        pressed_moment += bears * h * h * (0.5 * R.a + h * (R.b / 3.0 + 0.25 * h * R.c))
        pressed_end += bears * R_1
        if each is not None:
            each.pressed_for[i], each.f_z[i] = (1.0, R_1) if sticks | slips else (0.0, 0.0)
            each.f[i] = f if sticks else f_1[0] if slips else 0.0j
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
    return Answer(area, moment, end, stuck, 0.5 * h * stuck, sticking, 0.0, pressed, pressed_moment, pressed_end, share)
