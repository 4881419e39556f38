"""Files of a drawing: SVG, PDF, PNG, DXF, all from the same primitives."""
