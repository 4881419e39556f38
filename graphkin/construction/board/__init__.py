"""The board and its instruments: steps, strokes, scales, and what a hand divides."""
