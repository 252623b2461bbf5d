#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs mxgen check for the GitHub action: MXGEN_PATHS, MXGEN_TARGETS, MXGEN_BASELINE and MXGEN_OPTIONS are the inputs of action.yml. Prints
faults as annotations, writes a summary and the places of the reports, and ends with the exit code of mxgen check."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

KINDS = {"error": "error", "warning": "warning", "note": "notice"}
MAX_ANNOTATIONS = 50 # GitHub shows no more for a step


def words(name):
    return [line.strip() for line in os.environ.get(name, "").splitlines() if line.strip()]


def escape(text, is_property=False):
    """Text for a workflow command."""
    text = text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
    return text.replace(":", "%3A").replace(",", "%2C") if is_property else text


def annotation(message):
    place = {"file": message.get("file"), "line": message.get("line"), "col": message.get("column"), "title": f"mxgen {message['id']}"}
    properties = ",".join(f"{name}={escape(str(value), True)}" for name, value in place.items() if value)
    return f"::{KINDS[message['severity']]} {properties}::{escape(message['message'])}"


def append(variable, text):
    """Adds text to a file of the runner."""
    if os.environ.get(variable):
        with open(os.environ[variable], "a", encoding="utf-8") as file:
            file.write(text)


def summary_of(report):
    """The table of the page of a run. A report lists a document that failed with its status."""
    rows = [f"| `{document['name']}` | {document['status']} | {len(document.get('messages', []))} |" for document in report["documents"]
            if document["status"] != "passed"]
    total = report["summary"]
    lines = [f"### mxgen check: {total['documents']} documents, {total.get('failed', 0)} failed", ""]
    if rows:
        lines += ["| document | status | messages |", "| --- | --- | --- |", *rows[:200], ""]
    return "\n".join(lines) + "\n"


def main():
    paths = words("MXGEN_PATHS")
    if not paths:
        print("::error title=mxgen::the input 'paths' is empty")
        return 2
    folder = pathlib.Path(tempfile.mkdtemp(prefix="mxgen-", dir=os.environ.get("RUNNER_TEMP")))
    reports = {kind: folder / f"report.{kind}" for kind in ("json", "sarif", "html")}
    command = ["mxgen", "check", *words("MXGEN_OPTIONS"), "--target", os.environ.get("MXGEN_TARGETS") or "glsl"]
    if os.environ.get("MXGEN_BASELINE"):
        command += ["--baseline", os.environ["MXGEN_BASELINE"]]
    for kind, path in reports.items():
        command += [f"--{kind}", str(path)]
    try:
        status = subprocess.run([*command, "--", *paths], check=False).returncode
    except FileNotFoundError:
        print("::error title=mxgen::the program mxgen is not installed")
        return 2
    append("GITHUB_OUTPUT", "".join(f"{kind}={path}\n" for kind, path in reports.items() if path.exists()))
    if reports["json"].exists():
        report = json.loads(reports["json"].read_text(encoding="utf-8"))
        found = [message for document in report["documents"] for message in document.get("messages", [])]
        found.sort(key=lambda message: list(KINDS).index(message["severity"]))
        print("\n".join(annotation(message) for message in found[:MAX_ANNOTATIONS]), flush=True)
        append("GITHUB_STEP_SUMMARY", summary_of(report))
    return status


sys.exit(main())
