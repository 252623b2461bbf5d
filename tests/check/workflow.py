#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs examples/check/github.yml like GitHub Actions: the steps of each job of the matrix in a separate folder. Copies of files simulate
the actions. The second run uses the caches of the first, and finds a new fault. Arguments: mxgen, the workflow, a document."""
import fnmatch
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

try:
    import yaml
except ImportError:
    skip("python3-yaml is not installed")
    finish("check-workflow")

MXGEN, WORKFLOW, DOCUMENT = (pathlib.Path(word).resolve() for word in sys.argv[1:])


def insert(value, context):
    """"${{ matrix.shard }}" by its value; an expression that the context does not know is a fault of the workflow."""
    return re.sub(r"\$\{\{ *([\w.]+) *\}\}", lambda found: str(context[found[1]]), str(value))


class Runner:
    """What lasts from job to job: caches, artifacts, reports that were uploaded."""

    def __init__(self, folder):
        self.folder, self.caches, self.reports, self.restored = folder, {}, [], []
        self.artifacts = folder / "artifacts"

    def action(self, name, inputs, workspace):
        name, at, version = name.partition("@")
        check(at and re.fullmatch(r"v\d+", version), f"{name} has a version")
        run = {"actions/checkout": self.checkout, "actions/cache": self.cache, "actions/upload-artifact": self.upload,
               "actions/download-artifact": self.download, "github/codeql-action/upload-sarif": self.sarif}.get(name)
        check(run, f"the action {name} is known")
        if run:
            run(inputs, workspace)

    def checkout(self, _, workspace):
        shutil.copytree(self.folder / "shots", workspace, dirs_exist_ok=True)

    def cache(self, inputs, workspace):
        """The newest one whose key begins as asked; what is there at the end of the job is kept."""
        found = [key for prefix in [inputs["key"], *inputs["restore-keys"].split()] for key in self.caches if key.startswith(prefix)]
        if found:
            shutil.copytree(self.caches[found[-1]], workspace / inputs["path"])
        self.restored.append(bool(found))
        self.caches[inputs["key"]] = workspace / inputs["path"]

    def upload(self, inputs, workspace):
        (self.artifacts / inputs["name"]).mkdir(parents=True)
        shutil.copy(workspace / inputs["path"], self.artifacts / inputs["name"])

    def download(self, inputs, workspace):
        check(inputs["merge-multiple"] is True or inputs["merge-multiple"] == "True", "artifacts come into one folder")
        for artifact in self.artifacts.iterdir():
            if fnmatch.fnmatch(artifact.name, inputs["pattern"]):
                shutil.copytree(artifact, workspace, dirs_exist_ok=True)

    def sarif(self, inputs, workspace):
        self.reports.append(json.loads((workspace / inputs["sarif_file"]).read_text(encoding="utf-8")))

    def job(self, name, job, context):
        """Runs the steps; returns the output of its programs and whether all went well, as a step after a fault runs only if always()."""
        workspace = self.folder / name
        workspace.mkdir()
        output, good = "", True
        for step in job["steps"]:
            check(("uses" in step) != ("run" in step), f"{name}: a step runs or uses something")
            if not good and step.get("if") != "always()":
                continue
            if "uses" in step:
                self.action(step["uses"], {key: insert(value, context) for key, value in step.get("with", {}).items()}, workspace)
                continue
            result = subprocess.run(["bash", "-e", "-c", insert(step["run"], context)], cwd=workspace, capture_output=True, text=True,
                                    check=False, env={**os.environ, "PATH": f"{MXGEN.parent}:{os.environ['PATH']}"})
            output += result.stdout + result.stderr
            good = good and result.returncode == 0
        return output, good, workspace


def run_workflow(runner, workflow, commit):
    """Jobs after those that they need; of a matrix one for each value."""
    done, ends = set(), {}
    shutil.rmtree(runner.artifacts, ignore_errors=True)
    for name, job in workflow["jobs"].items():
        check(job.get("needs", name) in done | {name}, f"{name} stands behind what it needs")
        matrix = job.get("strategy", {}).get("matrix", {"": [""]})
        (key, values), = matrix.items()
        ends[name] = [runner.job(f"{commit}-{name}{value}", job, {f"matrix.{key}": value, "github.sha": commit}) for value in values]
        done.add(name)
    return ends


def make_tree(folder):
    """Twenty materials, one with a fault that the baseline has."""
    text = DOCUMENT.read_text(encoding="utf-8")
    (folder / "shots/materials").mkdir(parents=True)
    for number in range(20):
        path = folder / f"shots/materials/{number:02}.mtlx"
        path.write_text(text if number != 7 else re.sub(r'value="0\.', 'value="x.', text), encoding="utf-8")
        os.utime(path, (1, 1))
    command = re.search(r"^# +mxgen (check .*--update-baseline)$", WORKFLOW.read_text(encoding="utf-8"), re.M)
    check(command, "the workflow says how to write the baseline")
    result = subprocess.run([MXGEN, *command[1].split()], cwd=folder / "shots", capture_output=True, text=True, check=False)
    check(result.returncode == 0, f"which works: {result.stderr}")


with tempfile.TemporaryDirectory() as work:
    root = pathlib.Path(work)
    make_tree(root)
    with open(WORKFLOW, encoding="utf-8") as file:
        parsed = yaml.safe_load(file)
    check({"push", "pull_request"} <= set(parsed[True]), "it runs at a push and for a request") # "on" is a truth of YAML 1.1
    actions = Runner(root)
    for commit in "first", "second":
        if commit == "second": # which has a new fault
            materials = root / "shots/materials"
            (materials / "03.mtlx").write_text((materials / "07.mtlx").read_text(encoding="utf-8"), encoding="utf-8")
            os.utime(materials / "03.mtlx", (1, 1))
        whole = subprocess.run([MXGEN, "check", "materials", "--target", "glsl,vulkan", "--baseline", "materials/baseline.json", "--fail-on",
                                "new-warnings,gone", "--junit", root / "whole.xml"], cwd=root / "shots", capture_output=True, text=True,
                               check=False)
        check(whole.returncode == (commit == "second"), "a known fault passes, a new one does not")
        jobs = run_workflow(actions, parsed, commit)
        check(len(jobs["check"]) == 8, "eight shards")
        check(all(good for _, good, _ in jobs["check"]), "a shard with a fault does not stop the others")
        (said, passed, place), = jobs["report"]
        check(passed == (commit == "first"), f"the report's job fails as the run does: {said}")
        check(("19 passed, 1 failed" if passed else "18 passed, 2 failed") in said, f"it tells of all: {said}")
        check(("no change" if passed else "1 document fails (fails 1, new-errors 1)") in said, f"it compares: {said}")
        check((place / "report.xml").read_bytes() == (root / "whole.xml").read_bytes(), "the report is that of one run")
        check("<article" in (place / "report.html").read_text(encoding="utf-8"), "the gallery is there")
    check(len(actions.reports) == 2 and actions.reports[0]["runs"][0]["results"], "SARIF is uploaded though the job failed")
    check(actions.restored == [False] * 8 + [True] * 8, "the second run has caches")
    states = [{result["baselineState"] for result in report["runs"][0]["results"]} for report in actions.reports]
    check(states == [{"unchanged"}, {"new", "unchanged"}], f"SARIF says what is new: {states}")
    unchanged = sum(int(count) for text, _, _ in jobs["check"] for count in re.findall(r"(\d+) documents? unchanged", text))
    check(unchanged == 19, f"and checks only what has changed again: {unchanged}")
finish("check-workflow")
