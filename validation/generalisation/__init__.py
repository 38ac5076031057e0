"""Eq. (15) for general contacts: one statement, a module for each range over which it is tested.

In full slip all springs slip at one velocity, so they reach the stick limit together and one v_c serves the array, at
any amplitude. What Eq. (15) needs besides is a normal force with a single harmonic. So it is exact where there is one,
or where the force does not move the pull: for a flat punch that keeps contact and for a rigid pull. Else it is the
limit of small amplitude.
"""

from validation.generalisation import catalogue, finite_amplitude, indentation, motions, rheology, shapes
from validation.report import Claim, told


def claim(effort: str) -> Claim:
    """Eq. (15) holds for general contacts

    How: Test the statement part by part.

    Quote: Note that the critical velocity depends on the oscillation amplitude but not on the average indentation. […]
    the existence an equivalent model with uncoupled spring elements, together with the indentation-independence of Eq.
    (15), implies that the obtained result in Eq. (15) is valid not only for the simple considered model with a single
    spring-damper combination, but also for quite general contacts (so long as the amplitude of oscillation remains
    small). — Section 2, after Eq. (15)

    Range: Shape, depth, rheology, drive and amplitude, each in a part below.

    Measured: Eq. (15), with the contact stiffness at the mean depth, is exact for a rigid pull, unless the contact is
    open at the moment of fastest approach, and for a flat punch that keeps contact (except under an undamped body with
    ω_0 = nω, n ≥ 2). For every other contact under a body it is the limit of small amplitude, and how small depends on
    the body. What then takes its place, at any amplitude, is full slip with all harmonics of the normal force.

    Verdict: holds if the pull is rigid, or the contact a flat punch that is kept, or the amplitude small

    Sentence: Eq. (15) is exact for a rigid pull and for a flat punch that keeps contact (except under an undamped body
    with ω_0 = nω, n ≥ 2), and the limit of small amplitude for all other shapes and drives.
    """
    parts = tuple(one.part(effort) for one in (shapes, catalogue, indentation, rheology, motions, finite_amplitude))
    return Claim(**told(claim, locals()), parts=parts)
