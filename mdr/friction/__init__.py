"""What runs and closed forms say of friction: curves, the measured velocity, the verdict, a fit."""
