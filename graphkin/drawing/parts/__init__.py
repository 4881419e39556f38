"""Parts of figures: the mechanism and its dimensions, trial marks, polygons, centres, insets, free bodies."""
