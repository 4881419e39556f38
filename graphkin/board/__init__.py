"""The drawing board as a page: ``graphkin open``, and `open_board` in a notebook.

The page shows the text of a scene, a form of it, and the figures; every change of one shows in the others.  Nothing is
computed in the browser: each message is a question that `graphkin.board.answers.answer` answers from the scene's text
alone.  ``static`` holds the served files: page and style, and the script, which ``npm run build`` in ``web`` makes of
the sources there.
"""
