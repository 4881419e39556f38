"""The account of a sheet: the letters of a convention; the sentence, reason, sums and lines of each step."""
