"""The contact modes of a spring; step.py says what each of them is."""

FREE, STICK, SLIP, SLIP_BACK = 0, 1, 2, 3
