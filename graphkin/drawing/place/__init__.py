"""Places on a figure: labels and dimensions among what is drawn there."""
