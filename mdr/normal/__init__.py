"""Normal contact: springs and their forces, the depth under a load, indentation; and partial slip at a fixed depth."""
