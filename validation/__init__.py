"""What the paper claims, one claim a module, each measured with the springs of `mdr`.

A module has `claim(effort) -> Claim` with effort "quick", "full" or "long" and is listed here, in the
order of the report. `python -m validation` runs them all and writes the page.
"""

CLAIMS = (
    "mapping",
    "full_slip_motion",
    "static_cof",
    "rigid_pull",
    "spring_pull",
    "generalisation",
    "resolution",
    "energy",
)
