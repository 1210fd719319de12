"""What every build measured, a JSON line a benchmark, and where in it something changed.

record     one benchmark of one build, and its JSON
log        the file of all lines: read with line numbers in its errors, appended to whole or not at all
series     lines as series: what is counted across machines, what is timed on each
steps      where a series changes, by a stated rule
"""
