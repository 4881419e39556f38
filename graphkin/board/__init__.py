"""The drawing board as a page: ``graphkin open``, and `open_board` in a notebook.

The page shows the text of a scene, a form of it, and the figures; every change of one shows in the others.  Nothing is
computed in the browser: each message is a question that `graphkin.board.answers.answer` answers from the scene's text
alone.  ``web`` holds the sources of the page, ``static`` what is served, built by ``npm run build`` in ``web``.
"""
