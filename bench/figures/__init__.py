"""What the report shows: one module per figure, and how all of them look.

=============  ==========================================================================================
style          colours, markers and lines of every regulator and outcome; the paper style of matplotlib
inline         a drawn figure becomes inline SVG that follows the page's light and dark, with words for it
html           what is not a drawing: verdict badges, tables, tiles, the card of a law, the canvas of a ball
=============  ==========================================================================================

Every other module holds one figure: a function from results to `Picture`, decorated with `inline.picture`.
"""
