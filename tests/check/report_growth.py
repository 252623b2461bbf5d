#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reports grow in proportion to the document, in size and in work: messages, elements and changes of one document are many at once.
Argument: mxgen."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

MXGEN = pathlib.Path(sys.argv[1]).resolve()
REPORTS = "html", "junit", "sarif", "json"
COUNTER = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
MOST = 2.2  # times the size and the work at twice the number


def document(count):
    """Each node of the graph is unused, and each output outside is an element with a warning of its own."""
    nodes = "".join(f"<constant name='c{i}' type='float'/>\n" for i in range(count))
    outputs = "".join(f"<output name='p{i}' type='float' nodegraph='N'/>\n" for i in range(count))
    return ("<materialx version='1.39'><nodegraph name='N'>\n" + nodes + "<output name='l' type='float' nodename='c0'/></nodegraph>\n" + outputs
            + "</materialx>\n")


def run(folder, *arguments, counter=()):
    result = subprocess.run([*counter, MXGEN, "check", *arguments], cwd=folder, capture_output=True, check=False)
    check(result.returncode in (0, 1), f"{arguments}: exit code {result.returncode}: {result.stderr[-200:]}")
    return result


def reports(folder, kind):
    return [word for report in REPORTS for word in (f"--{report}", f"{kind}.{report}")]


def measure(folder, count):
    """The sizes of the reports of a run and of a merge, which all changes of the baseline fail, and the work of the merge."""
    (folder / "a.mtlx").write_text(document(count), encoding="utf-8")
    run(folder, "a.mtlx", "--no-compile", "--root", ".", *reports(folder, "run"))
    report = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    message = dict(report["documents"][0]["messages"][0])
    for element in report["documents"][0]["elements"]:
        report["documents"][0]["messages"].append(
            {**message, "message": f"of {element['path']}", "rendered": f"of {element['path']}", "element": element["path"]})
    (folder / "part.json").write_text(json.dumps(report), encoding="utf-8")
    report["documents"][0]["messages"] = []
    for element in report["documents"][0]["elements"]:
        element["shaders"][0]["topology"] = "0"
    (folder / "before.json").write_text(json.dumps(report), encoding="utf-8")
    run(folder, "merge", "before.json", "--baseline", "base.json", "--update-baseline")
    merge = "merge", "part.json", "--baseline", "base.json", "--fail-on", "all", *reports(folder, "merged")
    counter = COUNTER if shutil.which("valgrind") else ()
    found = re.findall(rb"I +refs: +([\d,]+)", run(folder, *merge, counter=counter).stderr)
    return {f"{kind} {report}": (folder / f"{kind}.{report}").stat().st_size for kind in ("run", "merged") for report in REPORTS} | (
        {"instructions of a merge": int(found[-1].replace(b",", b""))} if found else {})


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        few, many = measure(folder, 500), measure(folder, 1000)
        if "instructions of a merge" not in few:
            skip("valgrind is not installed: no instructions are counted")
        for what, size in few.items():
            check(many[what] < MOST * size, f"{what}: {size} at 500, {many[what]} at 1000")
        page = (folder / "run.html").read_text(encoding="utf-8")
        check(page.count("nothing uses &#39;c7&#39;") == 1, "a message of the document stands once")
        merged = (folder / "merged.html").read_text(encoding="utf-8")
        check(len(re.findall("of p7<", merged)) == 1, "a message of an element stands once")


main()
finish("check-growth")
