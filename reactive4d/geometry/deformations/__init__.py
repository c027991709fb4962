"""Deformations of space: immutable values, each of which knows its pointwise map, its extent and its derivative."""
