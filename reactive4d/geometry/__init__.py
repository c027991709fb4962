"""Shapes as immutable values, and the pure functions that make, measure and bend them: no time and no engine."""
