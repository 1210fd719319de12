"""What callgrind counts: compiled laws called with a number of sweeps and with twice as many, and nothing else.

Run by its path in a bare interpreter that imports neither numba nor numpy: under valgrind that takes seconds, not
minutes. Given on the command line: where llvmlite is, the folder of machine code, the sweeps, the states' width, and
then file and symbol of every law. callgrind writes a file of totals before each os.getpgid: 4 of them a law. The first
law is called twice.

Fails: where a function that machine code asks for is neither C's, mathematics' nor one of numba's, loading ends it.
"""

import ctypes
import os
import re
import sys
from pathlib import Path

KP, KV = 100.0, 20.0
"""Gains; numbers like any other to a law."""

POINTER, WORD, NUMBER = ctypes.c_void_p, ctypes.c_int64, ctypes.c_double
ARRAY = (POINTER, POINTER, WORD, WORD, POINTER, WORD, WORD, WORD, WORD)
"""A matrix as numba passes it: owner, parent, items, size of one, where, rows, columns, and their strides."""

LOOP = ctypes.CFUNCTYPE(ctypes.c_int, POINTER, POINTER, *ARRAY, NUMBER, NUMBER, WORD)
"""Where the result goes, where an error would; the states; kp, kv; sweeps."""

NUMBAS = re.compile(rb"(?:NRT|numba)_\w+")


def main(llvmlite: str, folder: str, sweeps: str, width: str, *laws: str) -> None:
    """Load each law and call it, with a mark before and after each call."""
    sys.path.append(llvmlite)
    from llvmlite import binding

    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    binding.load_library_permanently("libm.so.6")
    unused = ctypes.cast(ctypes.CDLL(None).abort, POINTER).value  # numba's own functions: a loop without objects
    raw = Path(folder, "states").read_bytes()
    states, columns = ctypes.create_string_buffer(raw, len(raw)), int(width)
    items = len(raw) // 8
    matrix = (None, None, items, 8, ctypes.addressof(states), items // columns, columns, 8 * columns, 8)
    result, error = ctypes.c_double(), ctypes.c_void_p()
    given = (ctypes.addressof(result), ctypes.addressof(error), *matrix, KP, KV)
    named = list(zip(laws[::2], laws[1::2], strict=True))
    for file, symbol in (named[0], *named):  # what happens only the first time, happens to none that is counted
        code = Path(folder, file).read_bytes()
        for name in set(NUMBAS.findall(code)):
            binding.add_symbol(name.decode(), unused)
        machine = binding.Target.from_default_triple().create_target_machine()
        engine = binding.create_mcjit_compiler(binding.parse_assembly(""), machine)
        engine.add_object_file(binding.ObjectFileRef.from_data(code))
        engine.finalize_object()
        loop = LOOP(engine.get_function_address(symbol))
        loop(*given, 1)
        for count in (int(sweeps), 2 * int(sweeps)):
            os.getpgid(0)
            loop(*given, count)
            os.getpgid(0)


if __name__ == "__main__":
    main(*sys.argv[1:])
