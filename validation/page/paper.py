"""Equations of the paper that the report names, and full slip, from which its claims about Eq. (15) follow."""

from validation.report import Equation

PAPER = (
    Equation(
        "(1)", r"v_c = \mu_0 \omega \Delta u_z \frac{E^*}{G^*}",
        "Critical velocity of a rigid pull; κ = E*/G* = k_z,c/k_x,c below.",
    ),
    Equation(
        "(2)",
        r"v_c = \mu_0 \omega \Delta u_z \frac{k_{z,c}}{k_{x,c}} \frac{\left| k_{x,c} + k_x - m\omega^2 \right|}"
        r"{\left| k_x - m\omega^2 \right|}",
        "The same with a body on a spring, elastic: Eq. (15) without dashpots.",
    ),
    Equation("(3)", r"u_z = u_{z0} + \Delta u_z \cos \omega t", "The depth that is prescribed."),
    Equation("(4)", r"F_N = k_{z,c} u_z + \gamma_{z,c} \dot{u}_z", "Normal force of a Kelvin contact."),
    Equation(
        "(5)", r"k_{z,c} u_{z0} > \Delta u_z \sqrt{k_{z,c}^2 + \gamma_{z,c}^2 \omega^2}",
        "Contact is never lost; for α = Δu_z/u_z0 and T = ωτ this is α √(1 + T²) < 1.",
    ),
    Equation(
        "(6), (7)",
        r"\Delta F_N = \Delta u_z \sqrt{k_{z,c}^2 + \gamma_{z,c}^2 \omega^2}, \quad"
        r" F_s = \mu_0 \left( k_{z,c} u_{z0} - \Delta F_N \right)",
        "Amplitude of the normal force, and static friction: μ_0 times the least normal force.",
    ),
    Equation(
        "(8)", r"m \ddot{u}_x = k_x (v_0 t - u_x) - \mu_0 F_N", "Motion of the body in full slip.",
    ),
    Equation(
        "(9)", r"k_{x,c} (u_x - u_{x,c}) + \gamma_{x,c} (\dot{u}_x - \dot{u}_{x,c}) = \mu_0 F_N",
        "Balance at the foot of the spring, u_x,c, which slips.",
    ),
    Equation(
        "(10)",
        r"u_x = v_0 t - \mu_0 \frac{k_{z,c}}{k_x} u_{z0} + \frac{\mu_0 \Delta u_z}{m\omega^2 - k_x}"
        r" \left( k_{z,c} \cos \omega t - \gamma_{z,c} \omega \sin \omega t \right)",
        "The body.",
    ),
    Equation(
        "(11), (12)",
        r"\frac{\gamma_{x,c}}{\gamma_{z,c}} = \frac{k_{x,c}}{k_{z,c}}, \quad"
        r" u_x - u_{x,c} = \mu_0 \frac{k_{z,c}}{k_{x,c}} \left( u_{z0} + \Delta u_z \cos \omega t \right)",
        "One relaxation time both ways; the extension of the spring then follows the depth.",
    ),
    Equation(
        "(13), (14)",
        r"u_{x,c} = u_x - \mu_0 \frac{k_{z,c}}{k_{x,c}} \left( u_{z0} + \Delta u_z \cos \omega t \right), \quad"
        r" \dot{u}_{x,c} = \frac{d u_{x,c}}{d t}",
        "The foot with Eqs. (10) and (12), and its slip velocity, which at v_0 = v_c comes to zero once in a period.",
    ),
    Equation(
        "(15)",
        r"v_c = \frac{\mu_0 \Delta u_z \omega}{\left| m\omega^2 - k_x \right|} \sqrt{(\gamma_{z,c} \omega)^2 +"
        r" \left[ \kappa (m\omega^2 - k_{x,c} - k_x) \right]^2}, \quad \kappa = \frac{k_{z,c}}{k_{x,c}}",
        "Critical velocity of a body on a spring with a Kelvin contact. With a damper, k_x + iωc_x takes the place of"
        " k_x in it. With the dynamic stiffness K_z = k_z,c + iωγ_z,c and the receptance H of the body it reads"
        " v_c = μ_0 ω Δu_z |κ + K_z H|.",
    ),
    Equation(
        "",
        r"m \ddot{y} + c_x \dot{y} + k_x y = -\mu_0 F_N(t), \quad y = -\mu_0 \sum_n F_n H(n\omega) e^{i n \omega t},"
        r" \quad H(\omega) = \frac{1}{k_x - m\omega^2 + i \omega c_x}",
        "Full slip: the tangential force is μ_0 F_N(t) at any velocity, and moves the body by y = u_x − v_0 t.",
    ),
    Equation(
        "full-slip condition", r"v_c = \max_t \left( \mu_0 \kappa \dot{u}_z - \dot{y} \right)",
        "All springs in contact slip at v_0 + <i>ẏ</i> − μ_0 κ <i>u̇</i><sub>z</sub>; v_c is the velocity above which"
        " this is never zero, over the instants with contact. Any shape, amplitude, linear material and periodic depth;"
        " Eq. (15) is its case of a single harmonic.",
    ),
)  # fmt: skip

EQ_15 = next(one for one in PAPER if one.name == "(15)")
