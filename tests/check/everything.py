#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks real documents (shared/materials/README.md) in one run: no crash, an explanation for each failure, and exactly the errors of
../materials/expected.tsv. Repeats the run from the cache, and with fifty times as many names of the same files in the memory of one run.
Arguments: mxgen, the folder shared/materials."""
import csv
import ctypes
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

NO_HUGE_PAGES = 41  # PR_SET_THP_DISABLE of prctl(2)
MXGEN, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2])


def peak(*command):
    """Exit code, and the peak memory of the process itself in KiB, which is looked at until it ends."""
    process, most = subprocess.Popen(command, stdout=subprocess.DEVNULL), 0
    while process.poll() is None:
        try:
            with open(f"/proc/{process.pid}/status", encoding="utf-8") as status:
                most = max([most] + [int(line.split()[1]) for line in status if line.startswith("VmHWM")])
            process.wait(0.02)
        except (OSError, subprocess.TimeoutExpired):
            pass
    return process.returncode, most


def check_documents(folder):
    report = f"{folder}/report.json"
    run = [MXGEN, "check", ROOT, "--no-compile", "-q", "--max-errors", "1000", "--cache", f"{folder}/cache"]
    code = subprocess.run([*run, "--json", report], stdout=subprocess.DEVNULL, check=False).returncode
    check(code == 1, "exit code 1: there are faulty documents")
    with open(report, encoding="utf-8") as file:
        documents = {os.path.relpath(document["file"], ROOT): document for document in json.load(file)["documents"]}
    check(set(documents) == {str(path.relative_to(ROOT)) for path in ROOT.rglob("*.mtlx") if path.is_file()}, "every document is told")
    for name, document in documents.items():
        errors = [message for message in document["messages"] if message["severity"] == "error"]
        check(document.get("failure") not in ("crash", "timeout"), f"{name}: {document.get('failure')}")
        check((document["status"] == "failed") == bool(errors), f"{name}: what fails says why")
        check(all(message.get("file") for message in errors), f"{name}: errors have a place")
    with open(pathlib.Path(__file__).parent.parent / "materials" / "expected.tsv", encoding="utf-8") as table:
        for row in csv.DictReader(table, delimiter="\t"):
            told = {message["id"] for message in documents[row["document"]]["messages"] if message["severity"] == "error"}
            expected = {name for name in row["errors"].split(",") if name not in ("-", "", "shader-invalid")}
            check(expected <= told, f"{row['document']}: {expected - told} of the table is not told")
    again = subprocess.run([*run, "--json", f"{folder}/again.json"], stdout=subprocess.PIPE, text=True, check=False)
    check(f"{len(documents) - 1} documents unchanged" in again.stdout or f"{len(documents)} documents unchanged" in again.stdout,
          "the cache has all that can be read")
    check(pathlib.Path(report).read_bytes() == pathlib.Path(f"{folder}/again.json").read_bytes(), "and tells the same")


def check_memory(folder):
    """The documents of the smallest examples, as links in many folders: 100, then 5,000 names. Huge pages are off, since whether the heap
    meets one (2 MiB) depends on its address."""
    ctypes.CDLL(None).prctl(NO_HUGE_PAGES, 1, 0, 0, 0)
    source = ROOT / "resources/Materials/Examples/StandardSurface/standard_surface_default.mtlx"
    for number in range(5000):
        path = pathlib.Path(folder, "many", f"{number // 100:02}", f"{number}.mtlx")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.symlink_to(source.resolve())
    reports = [f"--{kind}={folder}/many.{kind}" for kind in ("json", "sarif", "junit", "html")]
    code, few = peak(MXGEN, "check", f"{folder}/many/00", "--no-compile", *reports)
    more_code, many = peak(MXGEN, "check", f"{folder}/many", "--no-compile", *reports)
    check(code == 0 and more_code == 0, "links are documents too")
    check((many - few) * 1024 < 4900 * 256, f"memory grows from {few} to {many} KiB: a name takes less than 256 bytes")


if not ROOT.is_dir():
    skip(f"there is no folder {ROOT}")
    finish("check-everything")
with tempfile.TemporaryDirectory() as work:
    check_documents(work)
    if os.environ.get("SANITIZER"):
        skip("memory is not measured, since a sanitizer keeps what was freed")
    else:
        check_memory(work)
finish("check-everything")
