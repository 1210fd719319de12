"""`python -m bench`."""

import sys


def main() -> int:
    """The command line; imported late, so that importing this module costs nothing."""
    try:
        from bench.cli import main as command_line
    except KeyboardInterrupt:
        return 130

    return command_line()


if __name__ == "__main__":
    sys.exit(main())
