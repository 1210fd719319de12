"""What the book shows: a folder a chapter, in it one module a page; and in kit/ what they share.

==========  ============================================================================================
kit.page    pastes a page's facts(run), tables(run) and figures(run); says what is not in the run
kit.tables  plain tables, declared
kit.style   colours, markers and lines of every regulator and outcome; the paper style of matplotlib
kit.inline  a drawn figure becomes inline SVG that follows the page's light and dark, with words for it
kit.html    what is not a drawing: verdict badges, tables, the card of a law
==========  ============================================================================================

The page pages/08-libraries.md has the module libraries/libraries.py. A drawing is a function from results to `Picture`,
decorated with `inline.responsive_picture`.
"""
