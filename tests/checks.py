# SPDX-License-Identifier: Apache-2.0
"""Shared by the tests in Python: `check` counts, `skip` reports an omission, `finish` prints the line that script/test sums up
and ends the program, with 77 (skipped) if nothing was checked."""
import sys

_passed, _failures, _skipped = 0, [], 0


def check(good, what):
    """Counts a check; prints `what` if it fails."""
    global _passed
    if good:
        _passed += 1
    else:
        _failures.append(what)


def skip(why):
    global _skipped
    _skipped += 1
    print(f"skip: {why}")


def finish(name):
    print("\n".join(dict.fromkeys(_failures)))
    print(f"{name}: {_passed} passed, {len(_failures)} failed, {_skipped} skipped")
    sys.exit(1 if _failures else 0 if _passed else 77)
