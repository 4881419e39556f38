"""The formulas of a structure as programs: written, compiled, run over many driver values."""
