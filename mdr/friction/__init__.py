"""Friction from runs and closed forms: curve, measured critical velocity, verdict, fit to data, surface fields."""
