"""Run the command line: `bench`, which the installation makes, or `python -m bench` in the checkout.

Only what is needed to say so is imported before Ctrl-C is caught: in the first tenths of a second it ends nothing but
imports.
"""

import sys

OBJECTS = 100_000
"""New objects after which Python looks for cycles of unused ones: some 10 MB."""

SETTINGS = {
    # Threads of OpenBLAS wait at full speed when NumPy is imported; no command has matrices of a size for them.
    "OPENBLAS_NUM_THREADS": "1",
    # No command draws. MuJoCo would look for a library of windows when it is imported, in processes of their own.
    "MUJOCO_GL": "disable",
}
"""Variables of the environment, unless the user has set them."""


def main() -> int:
    """Return the command line; imported late, so that importing this module costs nothing.

    A sign that the terminal's encoding lacks is spelled: 180° in ASCII is 180 deg.
    """
    try:
        import gc
        import os

        # Looking for cycles of unused objects after every 700 new ones takes a tenth of a command that reads tables.
        gc.set_threshold(OBJECTS)
        for name, value in SETTINGS.items():
            os.environ.setdefault(name, value)
        os.environ["PYTHONSAFEPATH"] = "1"  # nor does a process of Dask or multiprocessing import from this folder
        from bench.base.signs import spell_where_needed

        spell_where_needed(sys.stdout, sys.stderr)
        from bench.cli import main as command_line
    except KeyboardInterrupt:
        print("stopped; nothing was begun", file=sys.stderr)
        return 130
    except ModuleNotFoundError as error:
        if (error.name or "bench").partition(".")[0] in ("bench", "tasks"):
            raise
        print(f"error: the package {error.name} is not installed (try: make setup)", file=sys.stderr)
        return 2

    code = command_line()
    gc.freeze()  # nor does Python look for them at its end, when all memory goes
    return code


if __name__ == "__main__":
    sys.exit(main())
