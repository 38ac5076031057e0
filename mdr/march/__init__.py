"""The march: springs and body step by step, to a settled run."""
