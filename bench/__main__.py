"""Run the command line: `bench`, which the installation makes, or `python -m bench` in the checkout.

Only what is needed to say so is imported before Ctrl-C is caught: in the first tenths of a second it ends nothing but
imports.
"""

import sys


def main() -> int:
    """Return the command line; imported late, so that importing this module costs nothing.

    A sign that the terminal's encoding lacks is spelled: 180° in ASCII is 180 deg.
    """
    try:
        import os

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

    return command_line()


if __name__ == "__main__":
    sys.exit(main())
