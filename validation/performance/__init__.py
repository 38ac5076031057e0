"""What is timed, apart from the claims: `python -m validation.performance`."""
