"""The program ``bagnold``, as ``python -m bagnold``."""

import sys

from ._native import Refused, command


def main() -> int:
    """Does what the words on the command line ask for and returns the exit code."""
    try:
        code, text = command(sys.argv[1:])
    except Refused as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("interrupted: the same command resumes from the last checkpoints", file=sys.stderr)
        return 130
    print(text, end="", file=sys.stderr if code == 2 else sys.stdout)
    return code


if __name__ == "__main__":
    sys.exit(main())
