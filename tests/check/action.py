#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The GitHub action as its runner sees it: the steps of action.yml with its inputs, the annotations, outputs and summary. Arguments: mxgen,
the root of the project."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

try:
    import yaml
except ImportError:
    skip("python3-yaml is not installed")
    finish("check-action")

MXGEN, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:])
ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
GOLD = (ROOT / "examples/gold.mtlx").read_text(encoding="utf-8")


def run(folder, inputs, path=MXGEN.parent):
    """Runs the steps; returns the exit code, what they print, the outputs and the summary."""
    check(not set(inputs) - set(ACTION["inputs"]), f"action.yml has the inputs {sorted(inputs)}")
    values = {name: str(inputs.get(name, about.get("default", ""))) for name, about in ACTION["inputs"].items()}
    files = {name: folder / name.lower() for name in ("GITHUB_OUTPUT", "GITHUB_STEP_SUMMARY", "GITHUB_PATH")}
    for file in files.values():
        file.write_text("", encoding="utf-8")
    code, text = 0, ""
    for step in ACTION["runs"]["steps"]:
        check(step["shell"] == "bash", "a composite action names the shell")
        given = {name: re.sub(r"\$\{\{ *inputs\.(\w+) *\}\}", lambda found: values[found[1]], value) for name, value in step.get("env", {}).items()}
        environment = {**os.environ, **given, **{name: str(file) for name, file in files.items()}, "GITHUB_ACTION_PATH": str(ROOT),
                       "RUNNER_TEMP": str(folder), "PATH": f"{path}:{os.environ['PATH']}"}
        done = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", step["run"]], cwd=folder, env=environment, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        code, text = done.returncode, text + done.stdout
        if code:
            break
    outputs = dict(line.split("=", 1) for line in files["GITHUB_OUTPUT"].read_text(encoding="utf-8").splitlines())
    return code, text, outputs, files["GITHUB_STEP_SUMMARY"].read_text(encoding="utf-8")


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "good").mkdir()
        (folder / "good/gold.mtlx").write_text(GOLD, encoding="utf-8")
        code, text, outputs, summary = run(folder, {"paths": "good", "options": "--no-compile"})
        check(code == 0 and "::error" not in text, f"good documents pass: {text}")
        check(sorted(outputs) == ["html", "json", "sarif"] and all(pathlib.Path(file).stat().st_size for file in outputs.values()), f"{outputs}")
        check(set(outputs) == set(ACTION["outputs"]), "action.yml has the outputs of the step")
        check("1 documents, 0 failed" in summary, summary)

        broken = GOLD.replace('type="color3" value="', 'type="color3" value="red ')
        (folder / "bad, 100%.mtlx").write_text(broken, encoding="utf-8")
        code, text, _, summary = run(folder, {"paths": "good\nbad, 100%.mtlx\n", "targets": "essl,osl", "options": "--no-compile\n--max-errors\n5"})
        check(code == 1, f"a bad document fails: {code}")
        line, col = next((number, one.index('"red ') + 2) for number, one in enumerate(broken.splitlines(), 1) if '"red ' in one)
        check(re.search(rf"^::error file=bad%2C 100%25\.mtlx,line={line},col={col},title=mxgen bad-value::'red 1", text, re.MULTILINE), f"annotation: {text}")
        check("2 documents, 1 failed" in summary and "| `bad, 100%.mtlx` | failed |" in summary, summary)

        code, _, _, _ = run(folder, {"paths": "good", "options": "--no-compile\n--update-baseline", "baseline": "base.json"})
        check(code == 0 and (folder / "base.json").exists(), "a baseline is written")
        code, text, _, _ = run(folder, {"paths": "good", "options": "--no-compile", "baseline": "base.json"})
        check(code == 0, f"no change since the baseline: {text}")

        code, text, _, _ = run(folder, {"paths": " \n"})
        check(code == 2 and "::error title=mxgen::the input 'paths' is empty" in text, text)
        code, text, outputs, _ = run(folder, {"paths": "none.mtlx", "options": "--no-compile"})
        check(code != 0, f"a missing document: {code}")
        code, text, _, _ = run(folder, {"paths": "good", "targets": "cobol"})
        check(code == 2, f"an unknown target: {code} {text}")
        code, text, _, _ = run(folder, {"paths": "$(touch pwned); `touch pwned`", "options": "--no-compile"})
        check(code != 0 and not (folder / "pwned").exists(), "inputs are no commands")

    packages = set(re.findall(r"^[a-z][\w+.-]*$", (ROOT / "script/packages.txt").read_text(encoding="utf-8"), re.MULTILINE))
    installed = re.search(r"packages=\(([^)]*)\)", (ROOT / "action/install.sh").read_text(encoding="utf-8"))[1].split()
    check(not set(installed) - packages, f"script/packages.txt lists {sorted(set(installed) - packages)}")
    finish("check-action")


main()
