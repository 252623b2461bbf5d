#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sums the tests of meson's logs. Arguments: the logs; PREFIX=LOG puts PREFIX before the names of a log's tests.

A test prints lines "name: N passed, N failed[, N skipped]", and a line "skip: …" with the reason for each thing that it leaves out.
A test that checks nothing ends with the exit code 77 and counts as skipped; if it ends well, it counts as failed. The output of tests that
failed is shown. The last line is the sum, the lines before it name the tests that were skipped whole; exit 1 where a check failed."""
import json
import re
import sys

COUNTS = re.compile(r"^\S+: (\d+) passed, (\d+) failed(?:, (\d+) skipped)?$")


def read_log(argument):
    """The tests of a log by name, sorted."""
    prefix, is_given, path = argument.rpartition("=")
    with open(path, encoding="utf-8") as log:
        tests = [json.loads(line) for line in log]
    for test in tests:
        name = test["name"].rpartition(":")[2].replace(" / ", "/") # "mxgen:unit / base": project, suite and test
        test["name"] = f"{prefix}/{name}" if is_given else name
    return sorted(tests, key=lambda test: test["name"])


def count(test):
    """Checks that passed, failed and were skipped, and what is wrong with the test itself: '' for nothing."""
    matches = [match for match in map(COUNTS.match, (test.get("stdout") or "").splitlines()) if match]
    passed, failed, skipped = (sum(int(match[i] or 0) for match in matches) for i in (1, 2, 3))
    if test["result"] == "SKIP":
        return (passed, failed, max(skipped, 1)), ""
    if test["result"] != "OK": # crashed, or ran too long, whatever it counted before
        return (passed, max(failed, 1), skipped), test["result"]
    if passed + failed == 0:
        return (0, 1, skipped), "ends well, though it checked nothing"
    return (passed, failed, skipped), ""


def reasons(test):
    return [line for line in (test.get("stdout") or "").splitlines() if line.startswith("skip")]


def main(arguments):
    total, skipped_tests = [0, 0, 0], []
    tests = [test for argument in arguments for test in read_log(argument)]
    for test in tests:
        counts, fault = count(test)
        print("{}: {} passed, {} failed, {} skipped".format(test["name"], *counts))
        if counts[1]:
            print(test.get("stdout") or "", test.get("stderr") or "", fault, sep="\n")
        else:
            sys.stdout.writelines(f"  {line}\n" for line in reasons(test))
        if test["result"] == "SKIP":
            skipped_tests.append(test)
        total = [a + b for a, b in zip(total, counts)]
    if not tests:
        total[1] = 1
        print("no test was run")
    for test in skipped_tests:
        print(f"not run: {test['name']}: {'; '.join(line.removeprefix('skip: ') for line in reasons(test)) or 'no reason given'}")
    print("{} passed, {} failed, {} skipped".format(*total))
    return 1 if total[1] else 0


sys.exit(main(sys.argv[1:]))
