"""What the author later held true of friction under vibration in general, judged part by part.

M. Popov, The influence of vibration on friction: a contact-mechanical perspective (Front. Mech. Eng. 6:69, 2020): one
spring without mass, Amontons' law, motion given, in three directions: normal, along the slide, across. Equation numbers
in this package are those of that paper.
"""

from validation.report import Claim, told
from validation.sequel import at_rest, energy, full_slip, waveform


def claim(effort: str) -> Claim:
    """The author's later paper: what is general in it, and what is not

    How: Test the statements part by part.

    Range: Statements at rest, in full slip, on waveforms and on energy, each in a part below; elastic and Kelvin, flat
    punch, paraboloid, cone and r^4, rigid pull and a body on a spring. M. Popov, Front. Mech. Eng. 6:69 (2020).

    Measured: In terms of forces Eqs. (4) and (6) hold for every shape and waveform tried. Eq. (8), for a shake across,
    does not: it is right for a flat face alone. In full slip friction is μ_0 for a normal and a longitudinal
    oscillation, and never across, Eq. (12). What is said of waveforms holds. What is said of energy holds for elastic
    contacts. On viscous ones a normal oscillation takes power, from ωτ of about 0.1 on more than one along.

    Verdict: fails when a curved contact is shaken across, and in the order of efficiency when ωτ > 0.1

    Sentence: Eqs. (4), (6), (12) of the later paper and those on waveforms hold; (8) only for a flat face. Normal
    vibration costs least power if elastic; from ωτ of 0.1 on one along does.
    """
    parts = tuple(one.part(effort) for one in (at_rest, full_slip, waveform, energy))
    return Claim(**told(claim, locals()), parts=parts)
