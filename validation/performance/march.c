/* The march of springs under a rigid pull, rule by rule as mdr/march/kernels.py has it, for loops.py.

   e (n,): extensions; e_next: of Kelvin springs, in two places by turns. s, s_next: their compressions. gap, w (n,). z, zd
   (n_z + 1,): normal motion over a period and its rate. spans (2, n_z): the springs before the
   first number press throughout a step, those from the second on are free throughout it. S (n_steps,): sum of w e after
   each step, with what the paths to it add to the mean. The compiler may reorder sums, so that a spring in contact is ahead of the indenter by a rounding: 1e-12
   tells it from one that is free. With an even number of steps the last state is in e and s. */

#include <math.h>

#define VECTOR 16

static inline double most(double a, double b) { return a > b ? a : b; }
static inline double least(double a, double b) { return a < b ? a : b; }

static inline double after_change(double D_0, double D_1, double h, double rate)
{
    double lead = most(D_1, 0.0);
    return 0.5 * h * lead * lead / (lead + most(-D_0, 0.0) + 0.5 * rate * h * lead + 1e-300);
}

static inline double bend_of(double closing_0, double closing_1)
{
    double mean = fabs(closing_0 + closing_1) + 1e-300;
    return least(most((closing_1 - closing_0) / mean, -0.5), 0.5);
}

static inline double kelvin_friction(double s, double trial, double travelled, double lead_0, double lead_1, double h,
                                     double rate, double s_free, double lag_free, double lag_rate, double lag_end)
{
    double D_0 = lead_0 + lag_rate, held = rate * most(s - trial, 0.0);
    int sticks = D_0 > 0.0;
    double D_1 = lead_1 + (sticks ? held : lag_end), turn = sticks ? -1.0 : 1.0;
    double change = after_change(turn * D_0, turn * D_1, h, rate), forward = s - lag_free;
    double first = least((sticks ? trial : forward) - travelled * change, forward);
    return most(first, s_free + s_free - lag_free - s);
}

/* of an elastic spring that lets go within a step */
static inline double end_of_touch(double e, double s, double du, double opened)
{
    double share = s / (s + opened + 1e-300);
    double ahead = most(s + share * du, 1e-300), behind = most(s - share * du, 1e-300);
    double slips = share * least(least((s - e) / ahead, (s + e) / behind), 1.0);
    double met = e + du * slips, jump = (s + opened) / 12.0;
    return 0.5 * (e * (slips - 1.0) + met * share) + (met >= 0.0 ? jump : -jump);
}

/* of an elastic spring that touches for the last share of the step */
static inline double first_touch(double x, double travelled)
{
    return travelled > 0.0 ? x * (1.0 / (12.0 * most(travelled, 1e-9)) - 0.5 * (1.0 - travelled)) : 0.0;
}

static inline void span_of(const long *spans, long k, long n, long n_z, long *n_in, long *n_out)
{
    long high = (spans[n_z + k] + VECTOR - 1) / VECTOR * VECTOR;
    *n_in = spans[k] / VECTOR * VECTOR;
    *n_out = high < n ? high : n;
}

/* what the end of stick adds, of a spring `left` from slip that closes at this pace: the path, and the sum over nodes */
static inline double end_of_stick(double left, double pace)
{
    double more = left * (pace - left);
    return more > 0.0 ? 0.5 * more / pace - pace / 12.0 : 0.0;
}

void elastic_march(double *restrict e, const double *restrict gap, const double *restrict w, const double *z,
                   const double *zd, const long *spans, double v, double h, long n, long n_z, long n_steps, double *S)
{
    double du = v * h;
    long n_at_rest = n;
    for (long j = 0; j < n_steps; j++) {
        long k = j % n_z, n_in, n_out;
        span_of(spans, k, n, n_z, &n_in, &n_out);
        double z_1 = z[k + 1], inverse_dz = z[k + 1] > z[k] ? 1.0 / (z[k + 1] - z[k]) : 1e300;
        double bend = bend_of(zd[k], zd[k + 1]), total = 0.0;
        double late = zd[k] < v ? after_change(zd[k] - v, zd[k + 1] - v, h, 0.0) : 0.0;
        double z_0 = z[k], pace = most(du - (z_1 - z_0), 0.0), pace_back = most(-du - (z_1 - z_0), 0.0);
        for (long i = 0; i < n_in; i++) {
            double s = z_1 - gap[i], left = z_0 - gap[i] - e[i], left_back = z_0 - gap[i] + e[i];
            double more = end_of_stick(left, pace) - end_of_stick(left_back, pace_back);
            e[i] = most(least(e[i] + du, s - late), -s);
            total += w[i] * (e[i] + more);
        }
        for (long i = n_in; i < n_out; i++) {
            double above = z_0 - gap[i], pressed = z_1 - gap[i], e_0 = e[i], left = above - e_0, left_back = above + e_0;
            double s = most(pressed, 0.0), way = least(s * inverse_dz, 1.0);
            double travelled = way * ((1.0 - bend) + bend * way), more;
            e[i] = most(least(e_0 + travelled * du, s - travelled * late), -s);
            if (above <= 0.0)
                more = first_touch(e[i], travelled);
            else if (pressed <= 0.0)
                more = end_of_touch(e_0, above, du, -pressed);
            else
                more = end_of_stick(left, pace) - end_of_stick(left_back, pace_back);
            total += w[i] * (e[i] + more);
        }
        for (long i = n_out; i < n_at_rest; i++)
            e[i] = 0.0;
        n_at_rest = n_out;
        S[j] = total;
    }
}

void kelvin_march(double *restrict e, double *restrict e_next, double *restrict s, double *restrict s_next,
                  const double *restrict gap, const double *restrict w, const double *z, const double *zd,
                  const long *spans, double v, double h, double rate, double decay, long n, long n_z, long n_steps,
                  double *S)
{
    double du = v * h;
    for (long j = 0; j < n_steps; j++) {
        long k = j % n_z, n_in, n_out;
        span_of(spans, k, n, n_z, &n_in, &n_out);
        double z_0 = z[k], z_1 = z[k + 1], zd_0 = zd[k], zd_1 = zd[k + 1], total = 0.0;
        double *restrict a = j % 2 ? e_next : e, *restrict b = j % 2 ? e : e_next;
        double *restrict p = j % 2 ? s_next : s, *restrict q = j % 2 ? s : s_next;
        for (long i = 0; i < n_in; i++) {
            double pressed = z_1 - gap[i], lag = p[i] - a[i];
            q[i] = pressed;
            b[i] = kelvin_friction(pressed, a[i] + du, 1.0, zd_0 - v, zd_1 - v, h, rate, p[i] * decay, lag * decay,
                                   lag * rate, lag * decay * rate);
            total += w[i] * b[i];
        }
        for (long i = n_in; i < n_out; i++) {
            double lag = p[i] - a[i], s_free = p[i] * decay, lag_free = lag * decay, pressed = z_1 - gap[i];
            double ahead = p[i] - (z_0 - gap[i]);
            double leaving = after_change(-(zd_0 + p[i] * rate), -(zd_1 + rate * pressed), h, rate);
            double now = most(pressed + (ahead <= 1e-12 ? leaving : 0.0), s_free), rise = now - s_free;
            double way = rise / (rise + most(ahead, 0.0) + 1e-300);
            double travelled = way * (1.0 - bend_of(zd_0 + p[i] * rate, zd_1 + s_free * rate) * (1.0 - way));
            double trial = a[i] + (1.0 - travelled) * (s_free - lag_free - a[i]) + travelled * du;
            q[i] = now;
            b[i] = kelvin_friction(now, trial, travelled, zd_0 - v, zd_1 - v, h, rate, s_free, lag_free, lag * rate,
                                   lag_free * rate);
            total += w[i] * b[i];
        }
        for (long i = n_out; i < n; i++) {
            b[i] = a[i] * decay;
            q[i] = p[i] * decay;
            total += w[i] * b[i];
        }
        S[j] = total;
    }
}
