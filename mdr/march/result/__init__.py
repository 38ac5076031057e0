"""Runs in SI units: as accurate as is asked for, at one velocity or many."""
