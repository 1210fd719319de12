"""What the report shows: a folder a chapter, in it one module per figure; and in kit/ how all of them look.

=============  ==========================================================================================
kit.style      colours, markers and lines of every regulator and outcome; the paper style of matplotlib
kit.inline     a drawn figure becomes inline SVG that follows the page's light and dark, with words for it
kit.html       what is not a drawing: verdict badges, tables, tiles, the card of a law, the canvas of a ball
=============  ==========================================================================================

A module of a chapter holds one figure: a function from results to `Picture`, decorated with `inline.picture`.
"""
