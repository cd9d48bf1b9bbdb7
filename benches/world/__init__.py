"""A second world for `helixlock diagnose`: machines, physics and logs written apart from the program."""
