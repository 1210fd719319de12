"""What the book shows: a folder a chapter, in it one module a page; and in kit/ what they share.

The page pages/09-libraries.md has the module libraries/libraries.py. A drawing is a function from results to `Picture`,
decorated with `inline.responsive_picture`.
"""
