"""What is not physics: checks, records, messages, compiled functions, progress, files that are whole."""
