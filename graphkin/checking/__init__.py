"""Readings off a drawing, their comparison with exact values, and the judging of values that others state."""
