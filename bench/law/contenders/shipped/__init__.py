"""Controllers as their authors ship them, one file each; the file's name is the word.

A TOML file declares one whose error is made of those in `bench.law.shipped`; a module with one constant SHIPPED has an
error of its own. Each states what its source at the named commit does to a rotation, in its order and with its gains;
none of their code is here. `python -P -m bench.studies.restated` holds each to its source by a file of the same name in
its sources/. Not read, and so not here: placo, and the controllers of UR, KUKA and ABB, whose source is closed.
"""

from bench.law.shipped import read_shipped as read

__all__ = ["read"]
