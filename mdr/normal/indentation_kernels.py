"""The compiled march of the normal contact: one spring, all springs, one history. Arrays and floats only.

A spring at the depth g of the profile has the compression s and, for each Maxwell arm, a line load q_j:

    L[s] = E (s + tau s') + sum_j q_j,    q_j' = E_j s' - q_j/tau_j.

While the indenter is in contact s = u - g and L[s] >= 0; free, L[s] = 0, which is a linear system y' = A y for
y = (s, q_1, ...), solved by its modes. The indenter moves linearly within a step, so that both motions are sums of
exponentials, known exactly; the instants of release (L[s] = 0) and of touch (s = u - g) within a step are bisected.

Springs stand at nodes of g, in ascending order. Between two nodes b = E s + sum q_j is taken as linear in g, which
makes the elastic part of the force exact for any number of springs; the rest is extrapolated from every second node.

material = (E, eta, E_j, tau_j, rates, modes, inverse), eta = E tau; y(t) = modes exp(rates t) inverse y(0).
row = (g, x, area, power): depths, radii, int_0^x g dx, and the local exponents of x - x_0 ~ g^power.
"""

from __future__ import annotations

import numpy as np

from mdr.tools.jit import compiled

_jit = compiled(nogil=True, error_model="numpy")
_EPS = 2.220446049250313e-16
_EVENTS = 12  # releases and touches of a spring in one step, more than there ever are


# --- rows of numbers: plain loops, as slices and array expressions take seconds to compile ---------


@_jit
def total_of(x):
    """Sum of x, (n,)."""
    found = 0.0
    for i in range(x.size):
        found += x[i]
    return found


@_jit
def copy(x, to):
    """Put x into `to`, both (n,)."""
    for i in range(x.size):
        to[i] = x[i]


@_jit
def add(x, factor, to):
    """Add x times a factor to `to`, both (n,)."""
    for i in range(x.size):
        to[i] += x[i] * factor


@_jit
def lowest(s, g):
    """The least of s + g, both (n,)."""
    found = s[0] + g[0]
    for i in range(1, s.size):
        found = min(found, s[i] + g[i])
    return found


@_jit
def any_of(x):
    """Whether a number of x, (n,), is not zero."""
    found = False
    for i in range(x.size):
        found = found or x[i] != 0.0
    return found


# --- one spring -----------------------------------------------------------------------------------


@_jit
def load(theta, s, q, v, material):
    """L[s] of a spring in contact, a time theta later: its value and its rate."""
    E, eta, E_j, tau_j = material[0], material[1], material[2], material[3]
    value = E * (s + v * theta) + eta * v
    rate = E * v
    for j in range(E_j.size):
        kept = np.exp(-theta / tau_j[j])
        value += q[j] * kept - E_j[j] * v * tau_j[j] * np.expm1(-theta / tau_j[j])
        rate += (E_j[j] * v - q[j] / tau_j[j]) * kept
    return value, rate


@_jit
def height(theta, s, q, material):
    """Compression of a free spring, a time theta later: its value and its rate."""
    rates, modes, inverse = material[4], material[5], material[6]
    value, rate = 0.0, 0.0
    for k in range(rates.size):
        share = inverse[k, 0] * s
        for j in range(q.size):
            share += inverse[k, j + 1] * q[j]
        share *= modes[0, k] * np.exp(rates[k] * theta)
        value += share
        rate += rates[k] * share
    return value, rate


@_jit
def margin(contact, theta, s, q, g, u, v, material):
    """What must stay positive, and its rate: L[s] in contact, the gap to the indenter when free."""
    if contact:
        return load(theta, s, q, v, material)
    value, rate = height(theta, s, q, material)
    return value - (u + v * theta - g), rate - v


@_jit
def next_event(contact, left, s, q, g, u, v, material):
    """Time to the release or touch within the time left, or -1 if there is none."""
    scale = abs(s) + abs(u) + abs(v * left) + g  # of what rounding there is in a depth
    if contact:
        scale = (material[0] + total_of(material[2])) * scale + material[1] * abs(v)
        for j in range(q.size):
            scale += abs(q[j])
    least = -16 * _EPS * scale
    at_start, rate = margin(contact, 0.0, s, q, g, u, v, material)
    if at_start < least:
        return 0.0
    at_end, rate_at_end = margin(contact, left, s, q, g, u, v, material)
    high = left
    if at_end >= least:
        if rate >= 0.0 or rate_at_end <= 0.0:
            return -1.0
        low = 0.0  # it falls at first and rises in the end: is its lowest value below zero?
        for _ in range(60):
            middle = 0.5 * (low + high)
            if margin(contact, middle, s, q, g, u, v, material)[1] < 0.0:
                low = middle
            else:
                high = middle
        if margin(contact, high, s, q, g, u, v, material)[0] >= least:
            return -1.0
    low = 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        if margin(contact, middle, s, q, g, u, v, material)[0] >= 0.0:
            low = middle
        else:
            high = middle
    return high


@_jit
def move(contact, theta, s, q, v, material):
    """Carry a spring on by theta, in its mode: new compression; its arms q change in place."""
    E_j, tau_j, rates, modes, inverse = material[2], material[3], material[4], material[5], material[6]
    if contact:
        for j in range(q.size):
            kept = np.exp(-theta / tau_j[j])
            q[j] = q[j] * kept - E_j[j] * v * tau_j[j] * np.expm1(-theta / tau_j[j])
        return s + v * theta
    y = np.zeros(rates.size)
    for k in range(rates.size):
        share = inverse[k, 0] * s
        for j in range(q.size):
            share += inverse[k, j + 1] * q[j]
        share *= np.exp(rates[k] * theta)
        for i in range(rates.size):
            y[i] += modes[i, k] * share
    for j in range(q.size):
        q[j] = y[j + 1]
    return y[0]


@_jit
def spring_step(contact, dt, s, q, g, u, v, material):
    """One spring over one step: new mode and compression; its arms q change in place."""
    left = dt
    for _ in range(_EVENTS):
        theta = next_event(contact, left, s, q, g, u, v, material)
        if theta < 0.0:
            break
        s = move(contact, theta, s, q, v, material)
        left -= theta
        u += v * theta
        contact = not contact
        if contact:
            s = u - g
            if material[1] == 0.0 and q.size:  # no load yet: roundings of a long flight would pass for tension
                add(material[2], -(material[0] * s + total_of(q)) / total_of(material[2]), q)
    return contact, move(contact, left, s, q, v, material)


@_jit
def spring_jump(contact, s, q, g, u, du, material):
    """One spring in a sudden change of depth by du to u: new mode and compression; its arms q change in place."""
    E, eta, E_j = material[0], material[1], material[2]
    ds = du if contact else u - g - s
    if not contact and ds <= 0.0:
        return False, s
    if contact and du < 0.0:
        if eta > 0.0:  # the dashpot does not follow
            return False, s
        b = E * s + total_of(q)
        glassy = E + total_of(E_j)
        if b + glassy * du < 0.0:
            contact, ds = False, -b / glassy
        s_new = s + ds
        add(E_j, ds, q)
        return contact, s_new
    add(E_j, ds, q)
    return True, s + ds


# --- all springs ----------------------------------------------------------------------------------


@_jit
def step(s, q, c, dt, u, v, row, material):
    """All springs over one step, in place; the indenter moves from u with velocity v.

    Every exponential is monotonic: where the sum of their least values is positive there is no release and no touch.
    """
    E, eta, E_j, tau_j, rates, modes, inverse = material
    g = row[0]
    m = E_j.size
    kept, gain, faded, shares = np.empty(m), np.empty(m), np.empty(m + 1), np.zeros(m + 1)
    for j in range(m):
        kept[j] = np.exp(-dt / tau_j[j])
        gain[j] = -E_j[j] * v * tau_j[j] * np.expm1(-dt / tau_j[j])
    for k in range(m + 1):
        faded[k] = np.exp(rates[k] * dt)
    u_1 = u + v * dt
    for i in range(g.size):
        if c[i]:
            least = E * (min(u, u_1) - g[i]) + eta * v
            for j in range(m):
                least += min(q[i, j], q[i, j] * kept[j] + gain[j])
            if least > 0.0:
                for j in range(m):
                    q[i, j] = q[i, j] * kept[j] + gain[j]
                s[i] = u_1 - g[i]
                continue
        else:
            if max(u, u_1) <= g[i] and s[i] == 0.0 and not any_of(q[i]):
                continue  # never touched, nor now
            least = g[i] - max(u, u_1)
            for k in range(m + 1):
                share = inverse[k, 0] * s[i]
                for j in range(m):
                    share += inverse[k, j + 1] * q[i, j]
                least += min(modes[0, k] * share, modes[0, k] * share * faded[k])
                shares[k] = share * faded[k]
            if least > 0.0:
                s[i] = 0.0
                for j in range(m):
                    q[i, j] = 0.0
                for k in range(m + 1):
                    s[i] += modes[0, k] * shares[k]
                    for j in range(m):
                        q[i, j] += modes[j + 1, k] * shares[k]
                continue
        contact, s[i] = spring_step(c[i] > 0, dt, s[i], q[i], g[i], u, v, material)
        c[i] = contact
        if contact:
            s[i] = u_1 - g[i]


@_jit
def jump(s, q, c, u, du, row, material):
    """All springs in a sudden change of depth by du to u, in place."""
    g = row[0]
    for i in range(g.size):
        contact, s[i] = spring_jump(c[i] > 0, s[i], q[i], g[i], u, du, material)
        c[i] = contact


@_jit
def edge(s, q, c, u, v, row, material):
    """The outermost spring in contact (-1: none), the depth of the profile at the edge, and b = E s + sum q there.

    An advancing edge is where the gap outside closes, a receding one where the load L[s] inside vanishes.
    """
    E, eta = material[0], material[1]
    g = row[0]
    n = g.size
    i = n - 1
    while i >= 0 and not c[i]:
        i -= 1
    if i < 0:
        return -1, 0.0, 0.0
    b = E * s[i] + total_of(q[i])
    if i == n - 1:
        return i, g[i], b
    o = i + 1
    b_out = E * s[o] + total_of(q[o]) if eta > 0.0 else 0.0
    if v > height(0.0, s[o], q[o], material)[1]:  # advancing
        gap = s[o] - (u - g[o])
        slope, b_slope = 1.0, 0.0
        if o + 1 < n:
            step_out = g[o + 1] - g[o]
            slope = (s[o + 1] - s[o]) / step_out + 1.0
            b_slope = (E * s[o + 1] + total_of(q[o + 1]) - b_out) / step_out if eta > 0.0 else 0.0
        g_e = g[o] - gap / slope if slope > 0.0 else g[i]
        g_e = min(max(g_e, g[i]), g[o])
        return i, g_e, b_out + b_slope * (g_e - g[o])
    rest = b + eta * v
    fall = (E + total_of(material[2])) if i == 0 else (E * s[i - 1] + total_of(q[i - 1]) - b) / (g[i] - g[i - 1])
    g_e = g[i] + rest / fall if fall > 0.0 else g[o]
    return i, min(max(g_e, g[i]), g[o]), -eta * v


@_jit
def at_depth(i, g_e, row):
    """Radius and int_0^x g dx where the profile has the depth g_e, between nodes i and i + 1."""
    g, x, area, power = row
    if i == g.size - 1 or g_e <= g[i]:
        return x[i], area[i]
    base = max(i, 1)
    p = power[i]
    out = (x[base] - x[0]) * (g_e / g[base]) ** p
    return x[0] + out, area[i] + p / (1.0 + p) * (g_e * out - g[i] * (x[i] - x[0]))


@_jit
def cell(b_0, b_1, g_0, g_1, x_0, x_1, area_0, area_1):
    """Int b dx from x_0 to x_1 for b linear in g."""
    if g_1 <= g_0:
        return b_0 * (x_1 - x_0)
    rise = (area_1 - area_0 - g_0 * (x_1 - x_0)) / (g_1 - g_0)
    return b_0 * (x_1 - x_0) + (b_1 - b_0) * rise


@_jit
def total(s, q, c, u, v, row, material):
    """2 int b dx over the contact, its radius, and int_0^a g dx."""
    E = material[0]
    g, x, area, _ = row
    i, g_e, b_e = edge(s, q, c, u, v, row, material)
    if i < 0:
        return 0.0, 0.0, 0.0
    a, area_e = at_depth(i, g_e, row)
    b = np.zeros(i + 1)
    n_free = 0
    for k in range(i + 1):
        n_free += not c[k]
        b[k] = E * s[k] + total_of(q[k]) if c[k] else 0.0
    fine = b[0] * x[0]
    for k in range(i):
        fine += cell(b[k], b[k + 1], g[k], g[k + 1], x[k], x[k + 1], area[k], area[k + 1])
    fine += cell(b[i], b_e, g[i], g_e, x[i], a, area[i], area_e)
    bent = 0.0
    if not n_free:  # a ring is no smooth row
        for k in range(0, i - 1, 2):
            bent += bend(k, b, g, x, area)
    return 2.0 * (fine + bent / 3.0), a, area_e


@_jit
def bend(k, b, g, x, area):
    """What two cells from node k on add to one that spans both: a third of it is what two equal cells still miss."""
    i, j = k + 1, k + 2
    one = cell(b[k], b[j], g[k], g[j], x[k], x[j], area[k], area[j])
    inner = cell(b[k], b[i], g[k], g[i], x[k], x[i], area[k], area[i])
    return inner + cell(b[i], b[j], g[i], g[j], x[i], x[j], area[i], area[j]) - one


# --- one history ----------------------------------------------------------------------------------


@_jit
def follow_depth(t, u, row, material, record):
    """Force, contact radius and, on record, compressions and line loads, for depths u at instants t.

    A dashpot answers to the velocity, which changes at a sample: the answer there is the mean of both sides.
    """
    g, E, eta = row[0], material[0], material[1]
    n, n_t = g.size, t.size
    s, q, c = np.zeros(n), np.zeros((n, material[2].size)), np.zeros(n, np.uint8)
    F, radius = np.zeros(n_t), np.zeros(n_t)
    size = n_t if record else 0
    compressions, loads = np.zeros((size, n)), np.zeros((size, n))
    for k in range(n_t):
        sudden = k == 0 or t[k] == t[k - 1]
        rise = u[k] - (u[k - 1] if k else 0.0)
        ends = k + 1 == n_t or t[k + 1] == t[k]
        v_next = 0.0 if ends else (u[k + 1] - u[k]) / (t[k + 1] - t[k])
        if sudden:
            jump(s, q, c, u[k], rise, row, material)
            v = v_next
            way = v if eta > 0.0 else rise
        else:
            v = rise / (t[k] - t[k - 1])
            way = v
            step(s, q, c, t[k] - t[k - 1], u[k - 1], v, row, material)
        if eta > 0.0 and sudden:
            step(s, q, c, 0.0, u[k], v, row, material)  # what the motion that begins here releases at once
        B, a, _ = total(s, q, c, u[k], way, row, material)
        F[k], radius[k] = max(B + 2.0 * eta * v * a, 0.0), a
        if eta > 0.0 and not sudden and not ends:
            step(s, q, c, 0.0, u[k], v_next, row, material)
            B, a, _ = total(s, q, c, u[k], v_next, row, material)
            F[k] = 0.5 * (F[k] + max(B + 2.0 * eta * v_next * a, 0.0))
            radius[k] = 0.5 * (radius[k] + a)
            v = 0.5 * (v + v_next)
        if record:
            copy(s, compressions[k])
            for i in range(n):
                loads[k, i] = max(E * s[i] + total_of(q[i]) + eta * v, 0.0) if c[i] else 0.0
    return F, radius, compressions, loads


@_jit
def solve_depth(u_0, guess, dt, aim, scale, stride, old, new, row, material):
    """Depth at the end of a step (dt = 0: of a jump) at which the springs carry the force `aim`.

    Widens a bracket, then secants inside it; new holds the springs there. A dashpot acts with the mean velocity.
    """
    eta = material[1]
    s, q, c = new
    u = guess
    low, high, f_low, f_high = 0.0, 0.0, 1.0, -1.0  # no bracket yet
    kept = 0
    for turn in range(400):
        for i in range(s.size):
            s[i], c[i] = old[0][i], old[2][i]
            copy(old[1][i], q[i])
        v = u - u_0
        if dt == 0.0:
            jump(s, q, c, u, v, row, material)
        else:
            v /= dt
            step(s, q, c, dt, u_0, v, row, material)
        B, a, _ = total(s, q, c, u, v, row, material)
        f = B - aim + (2.0 * eta * v * a if dt > 0.0 else 0.0)
        if abs(f) <= 1e-12 * scale:
            break
        if f > 0.0:
            f_low *= 0.5 if kept == 1 else 1.0
            high, f_high, kept = u, f, 1
        else:
            f_high *= 0.5 if kept == -1 else 1.0
            low, f_low, kept = u, f, -1
        if f_low > 0.0:
            u, kept = u - stride, 0
            stride *= 2.0
        elif f_high < 0.0:
            u, kept = u + stride, 0
            stride *= 2.0
        else:
            if high - low <= 4.0 * _EPS * (abs(high) + abs(low)):
                break
            u = high - f_high * (high - low) / (f_high - f_low)
            if turn % 5 == 4 or not low < u < high:
                u = 0.5 * (low + high)
    return u


@_jit
def pressed(loads, F, now, row, material):
    """Line loads under the force F: dashpots, all with the same velocity, take up what the rest does not carry."""
    s, q, c = now
    E, eta = material[0], material[1]
    x = row[1]
    b = np.empty(s.size)
    low, high = 0.0, 0.0
    for i in range(s.size):
        b[i] = E * s[i] + total_of(q[i])
        high = max(high, abs(b[i]))
    if eta > 0.0:
        high += F / x[-1]
        low = -high
    else:
        high = 0.0
    for _ in range(60 if eta > 0.0 else 1):
        push = 0.5 * (low + high)
        for i in range(s.size):
            loads[i] = max(b[i] + push, 0.0) if c[i] else 0.0
        B = 2.0 * loads[0] * x[0]
        for k in range(x.size - 1):
            B += (loads[k] + loads[k + 1]) * (x[k + 1] - x[k])
        if B < F:
            low = push
        else:
            high = push


@_jit
def follow_force(t, F, known, row, material, record):
    """Depth, contact radius and, at the instants on record, compressions and line loads, for normal forces F at t.

    known: the depths at the first instants, while the contact has only grown.
    """
    g, E, eta, E_j = row[0], material[0], material[1], material[2]
    n, n_t = g.size, t.size
    old = (np.zeros(n), np.zeros((n, E_j.size)), np.zeros(n, np.uint8))
    new = (np.zeros(n), np.zeros((n, E_j.size)), np.zeros(n, np.uint8))
    depth, radius = np.zeros(n_t), np.zeros(n_t)
    compressions, loads = np.zeros((record.size, n)), np.zeros((record.size, n))
    at = 0  # next on record
    most = 1e-300
    for k in range(n_t):
        most = max(most, F[k])
    u, a, v = 0.0, 0.0, 0.0
    for k in range(n_t):
        dt = t[k] - t[k - 1] if k else 0.0
        before = F[k - 1] if k else 0.0
        was = u
        if k < known.size:
            u = known[k]
            if dt > 0.0:
                step(old[0], old[1], old[2], dt, was, (u - was) / dt, row, material)
            elif u > was:
                jump(old[0], old[1], old[2], u, u - was, row, material)
        elif before == 0.0 and F[k] == 0.0:  # loose: every spring relaxes for itself
            for i in range(n):
                old[2][i] = 0
                if old[0][i] != 0.0 or any_of(old[1][i]):
                    old[0][i] = move(False, dt, old[0][i], old[1][i], 0.0, material)
            u = lowest(old[0], g)
        elif dt > 0.0 or (F[k] != before and eta == 0.0):
            stiffness = (E + total_of(E_j) + (eta / dt if dt > 0.0 else 0.0)) * 2.0 * max(a, 1e-6 * row[1][-1])
            stride = max(
                1e-9 * g[-1], 1e-3 * abs(v * dt), 1e-3 * abs(F[k] - before) / stiffness, 1e-12 * most / stiffness
            )
            aim = max(F[k], 1e-11 * most)
            u = solve_depth(was, was + v * dt, dt, aim, most, stride, old, new, row, material)
            for i in range(n):
                old[0][i], old[2][i] = new[0][i], new[2][i]
                copy(new[1][i], old[1][i])
            if F[k] == 0.0:
                for i in range(n):
                    if old[2][i] and eta == 0.0:  # what little was left of the load
                        rise = -(E * old[0][i] + total_of(old[1][i])) / (E + total_of(E_j))
                        old[0][i] += rise
                        add(E_j, rise, old[1][i])
                    old[2][i] = 0
                u = lowest(old[0], g)
        if dt > 0.0:
            v = (u - was) / dt
        a = total(old[0], old[1], old[2], u, v if dt > 0.0 else u - was, row, material)[1] if F[k] > 0.0 else 0.0
        depth[k], radius[k] = u, a
        if at < record.size and record[at] == k:
            copy(old[0], compressions[at])
            if F[k] > 0.0:
                pressed(loads[at], F[k], old, row, material)
            at += 1
    return depth, radius, compressions, loads
