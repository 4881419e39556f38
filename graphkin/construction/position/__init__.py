"""The mechanism on paper: links, groups, and their limit positions."""
