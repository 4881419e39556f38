"""What a sheet tells: the letters of a convention; the sentence, reason and sums of each step; what is written."""
