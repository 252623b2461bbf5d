#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""script/summary.py: a test that checks nothing is never a success. Also checks the exit code of such tests, and that each test is in one
suite. Arguments: the root of the project, the build folder, a C compiler."""
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

ROOT, BUILD, COMPILER = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
SUITES = {"unit", "numbers", "tree", "golden", "programs", "device", "slow", "reach"}
SKIPPED = 77


def line(name, result, stdout="", stderr=""):
    return json.dumps({"name": name, "result": result, "stdout": stdout, "stderr": stderr})


def summary(*tests, prefix="", folder):
    """Exit code and lines of the summary of one log."""
    log = pathlib.Path(folder, "log.json")
    log.write_text("".join(test + "\n" for test in tests), encoding="utf-8")
    done = subprocess.run([sys.executable, ROOT / "script/summary.py", f"{prefix}{log}"], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout.splitlines()


def judged(what, test, code, sum_line, folder):
    """The summary of one test beside a good one: its exit code and last line."""
    got, lines = summary(line("good", "OK", "good: 3 passed, 0 failed\n"), test, folder=folder)
    check(got == code and lines[-1] == sum_line, f"{what}: exit code {got}, {lines[-1]}")
    return lines


def check_summary(folder):
    judged("a test that passes", line("t", "OK", "t: 2 passed, 0 failed, 1 skipped\n"), 0, "5 passed, 0 failed, 1 skipped", folder)
    judged("two lines of counts", line("t", "OK", "a: 2 passed, 0 failed\nb: 1 passed, 0 failed\n"), 0, "6 passed, 0 failed, 0 skipped", folder)
    judged("a check that fails", line("t", "FAIL", "t: 2 passed, 4 failed\n"), 1, "5 passed, 4 failed, 0 skipped", folder)
    judged("a failure with a good exit code", line("t", "OK", "t: 2 passed, 1 failed\n"), 1, "5 passed, 1 failed, 0 skipped", folder)
    judged("a crash after checks that passed", line("t", "FAIL", "t: 2 passed, 0 failed\n"), 1, "5 passed, 1 failed, 0 skipped", folder)
    judged("a test that runs too long", line("t", "TIMEOUT"), 1, "3 passed, 1 failed, 0 skipped", folder)
    judged("a build error", line("t", "ERROR"), 1, "3 passed, 1 failed, 0 skipped", folder)
    judged("no check", line("t", "OK", "t: 0 passed, 0 failed\n"), 1, "3 passed, 1 failed, 0 skipped", folder)
    judged("nothing but skipped checks", line("t", "OK", "t: 0 passed, 0 failed, 2 skipped\n"), 1, "3 passed, 1 failed, 2 skipped", folder)
    judged("no counts", line("t", "OK", "all is well\n"), 1, "3 passed, 1 failed, 0 skipped", folder)
    told = judged("a test that is skipped", line("t", "SKIP", "skip: no tool\n"), 0, "3 passed, 0 failed, 1 skipped", folder)
    check("not run: t: no tool" in told, f"it is named, with its reason: {told}")
    told = judged("one without a reason", line("t", "SKIP"), 0, "3 passed, 0 failed, 1 skipped", folder)
    check("not run: t: no reason given" in told, f"it is named, too: {told}")
    judged("one that failed before", line("t", "SKIP", "t: 0 passed, 2 failed, 1 skipped\n"), 1, "3 passed, 2 failed, 1 skipped", folder)
    told = judged("checks that are skipped", line("t", "OK", "skip: no device\nt: 1 passed, 0 failed, 1 skipped\n"), 0,
                  "4 passed, 0 failed, 1 skipped", folder)
    check("  skip: no device" in told, f"the reason is told: {told}")
    code, lines = summary(folder=folder)
    check(code == 1 and lines[-1] == "0 passed, 1 failed, 0 skipped", f"no test at all: {code}, {lines[-1]}")
    code, lines = summary(line("mxgen:unit / t", "OK", "t: 1 passed, 0 failed\n"), prefix="address=", folder=folder)
    check(code == 0 and lines[0] == "address/unit/t: 1 passed, 0 failed, 0 skipped", f"a prefix: {code}, {lines[0]}")


SHELL = 'set -- ; . "{root}/tests/programs/common.sh"; {body}; finish t'
PYTHON = "import sys; sys.path.append('{root}/tests'); from checks import check, finish, skip; {body}; finish('t')"
C = '#include "unit/test.h"\nint main(void) {{ {body}; return test_report("t"); }}\n'


def check_endings(folder):
    """The exit codes of tests in each language: nothing checked, something skipped, passed, failed."""
    cases = (("", "", "", SKIPPED), ("skip x", "skip('x')", None, SKIPPED), ("check x true", "check(True, 'x')", "REQUIRE(true)", 0),
             ("check x false", "check(False, 'x')", "REQUIRE(false)", 1),
             ("skip x; check x true", "skip('x'); check(True, 'x')", None, 0))
    source, program = pathlib.Path(folder, "t.c"), pathlib.Path(folder, "t")
    for shell, python, c, code in cases:
        commands = [["bash", "-c", SHELL.format(root=ROOT, body=shell or ":")], [sys.executable, "-c", PYTHON.format(root=ROOT, body=python or "0")]]
        if c is not None:
            source.write_text(C.format(body=c), encoding="utf-8")
            subprocess.run([*COMPILER, "-std=c17", f"-I{ROOT / 'tests'}", source, "-o", program], check=True)
            commands.append([program])
        for command in commands:
            got = subprocess.run(command, capture_output=True, text=True, check=False).returncode
            check(got == code, f"exit code {got} instead of {code} of {command}")
    got = subprocess.run([ROOT / "tests/absent.sh", "a tool"], capture_output=True, text=True, check=False)
    check(got.returncode == SKIPPED and "a tool" in got.stdout, "absent.sh is skipped, with its reason")


def check_suites():
    introspection = subprocess.run(["meson", "introspect", "--tests", BUILD], capture_output=True, text=True, check=True)
    for test in json.loads(introspection.stdout):
        suites = {suite.rpartition(":")[2] for suite in test["suite"]}
        check(len(suites) == 1 and suites <= SUITES, f"{test['name']} is in the suites {suites}")


check_suites()
with tempfile.TemporaryDirectory() as work:
    check_summary(work)
    check_endings(work)
finish("runner")
