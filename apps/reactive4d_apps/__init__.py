"""What is run rather than imported: the command line, and later the served and the baked pages."""
