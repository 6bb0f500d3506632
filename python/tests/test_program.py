"""``python -m bagnold`` is the program."""

import subprocess
import sys

import bagnold


def program(*words):
    return subprocess.run([sys.executable, "-m", "bagnold", *words], capture_output=True, text=True, check=False)


def test_the_program_is_there_with_its_exit_codes():
    listed = program("list")
    assert listed.returncode == 0 and len(listed.stdout.splitlines()) == len(bagnold.cases())
    assert program("--help").returncode == 0 and "Exit codes" in program("--help").stdout
    refused = program("run", "flim")
    assert refused.returncode == 2 and "did you mean `film`?" in refused.stderr
    unknown = program("fly")
    assert unknown.returncode == 2 and "unrecognized subcommand" in unknown.stderr
