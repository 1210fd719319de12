"""Run the command line: `bench`, which the installation makes, or `python -m bench` in the checkout."""

import io
import os
import sys


def main() -> int:
    """Return the command line; imported late, so that importing this module costs nothing.

    A sign that the terminal's encoding lacks, as ° in ASCII, is printed as a question mark.
    """
    os.environ["PYTHONSAFEPATH"] = "1"  # nor does a process of Dask or multiprocessing import from the working folder
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        from bench.cli import main as command_line
    except KeyboardInterrupt:
        return 130
    except ModuleNotFoundError as error:
        if (error.name or "bench").partition(".")[0] in ("bench", "tasks"):
            raise
        print(f"error: the package {error.name} is not installed (try: make setup)", file=sys.stderr)
        return 2

    return command_line()


if __name__ == "__main__":
    sys.exit(main())
