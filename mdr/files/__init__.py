"""Cases and materials in files."""
