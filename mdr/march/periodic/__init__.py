"""The periodic state of a march: searched for, or waited for, and held to the theorems on friction."""
