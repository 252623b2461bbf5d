# SPDX-License-Identifier: Apache-2.0
"""Shared by the tests in Python: `check` counts, `skip` reports an omission, `finish` prints the line that script/test sums up
and ends the program, with 77 (skipped) if nothing was checked. `run` runs a program, `count_instructions` counts its work."""
import os
import re
import shutil
import subprocess
import sys

_passed, _failures, _skipped = 0, [], 0


def check(good, what):
    """Counts a check; prints `what` if it fails."""
    global _passed
    if good:
        _passed += 1
    else:
        _failures.append(what)


def check_fault(what, fault):
    """As check; `fault` is None where all is well."""
    check(not fault, f"{what}: {fault}")


def skip(why):
    global _skipped
    _skipped += 1
    print(f"skip: {why}")


def finish(name):
    print("\n".join(dict.fromkeys(_failures)))
    print(f"{name}: {_passed} passed, {len(_failures)} failed, {_skipped} skipped")
    sys.exit(1 if _failures else 0 if _passed else 77)


def run(*command):
    """A run of a program, with what it says as text."""
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)


def counts_instructions():
    """False after a skip: no instructions can be counted."""
    if shutil.which("valgrind") and not os.environ.get("SANITIZER"):
        return True
    skip("valgrind is not installed, or a sanitizer is in the program: no instructions are counted")
    return False


def count_instructions(*command):
    """The instructions of a run, 0 if none are counted, and the run."""
    counter = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    done = subprocess.run(counter + [str(word) for word in command], capture_output=True, check=False)
    found = re.findall(rb"I +refs: +([\d,]+)", done.stderr)
    return int(found[-1].replace(b",", b"")) if found else 0, done
