"""Parts of figures: the mechanism and its dimensions, polygons, centres, insets."""
