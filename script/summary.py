#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sums the tests of a meson log. A test prints lines "name: N passed, N failed[, N skipped]"; a test without such a line counts as one
check. Prints the output of failed tests and the reasons of skipped checks; the last line is the sum. Exits with 1 if a test failed."""
import json
import re
import sys

COUNTS = re.compile(r"^\S+: (\d+) passed, (\d+) failed(?:, (\d+) skipped)?$")
total = [0, 0, 0]
with open(sys.argv[1], encoding="utf-8") as log:
    tests = [json.loads(line) for line in log]
for test in sorted(tests, key=lambda test: test["name"]):
    output = test.get("stdout") or ""
    lines = [match for match in map(COUNTS.match, output.splitlines()) if match]
    counts = [sum(int(match[i] or 0) for match in lines) for i in (1, 2, 3)]
    if test["result"] == "SKIP" and not lines:
        counts[2] = 1
    elif test["result"] not in ("OK", "SKIP") and counts[1] == 0:
        counts[1] = 1 # crashed, or ran too long, whatever it counted before
    elif not lines:
        counts[0] = 1
    print(f"{test['name']}: {counts[0]} passed, {counts[1]} failed, {counts[2]} skipped")
    if counts[1]:
        print(output, test.get("stderr") or "", test["result"], sep="\n")
    else:
        sys.stdout.writelines(f"  {line}\n" for line in output.splitlines() if line.startswith("skip"))
    total = [a + b for a, b in zip(total, counts)]
if not tests:
    total[1] = 1
    print("no test was run")
print(f"{total[0]} passed, {total[1]} failed, {total[2]} skipped")
sys.exit(1 if total[1] else 0)
