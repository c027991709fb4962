"""The kinds of objects that come with the package, one module for each family."""
