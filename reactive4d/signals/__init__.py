"""Signals: values that depend on where one asks, and know over which interval of time each answer holds."""
