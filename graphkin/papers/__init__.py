"""Papers: problem sheet, worked solution and answer key, as HTML and typeset PDF, in one language or two."""
