"""Places of labels and dimensions among the strokes of a figure."""
