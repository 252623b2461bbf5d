#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mxgen check on a terminal: it shows how far it is, in one line that does not stay. Arguments: mxgen, the worker of fake_worker.c."""
import fcntl
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish


def run_on_terminal(command, folder, columns=60, term="xterm"):
    """All that a terminal receives."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    with subprocess.Popen(command, cwd=folder, stdin=theirs, stdout=theirs, stderr=theirs, env={**os.environ, "TERM": term}) as process:
        os.close(theirs)
        received = b""
        try:
            while piece := os.read(ours, 4096):
                received += piece
        except OSError: # the end of a terminal
            pass
        code = process.wait()
    os.close(ours)
    return code, received.decode()


def screen(received):
    """The lines that stay: an erased line is empty."""
    return [re.split(r"\r\x1b\[K", line)[-1] for line in received.replace("\r\n", "\n").split("\n")]


def main(mxgen, worker):
    with tempfile.TemporaryDirectory() as work:
        root = pathlib.Path(work)
        shutil.copy(mxgen, root / "mxgen")
        shutil.copy(worker, root / "mxgen-check")
        folder = root / "a folder with a long name" / "and another one that does not fit into a line"
        folder.mkdir(parents=True)
        for number in range(8):
            (folder / f"{number}_slow.mtlx").touch()
        (folder / "5_dies_slow.mtlx").touch()
        command = [root / "mxgen", "check", folder.relative_to(root), "-j1"]
        code, received = run_on_terminal(command, root)
        shown = re.findall(r"\r\x1b\[K((\d+) checked, (\d+) failed: [^\r\n]*)", received)
        check(code == 1, f"a document fails: {code}")
        check(len(shown) >= 4, f"progress is shown: {received!r}")
        counts = [int(count) for _, count, _ in shown]
        check(counts == sorted(counts) and counts[-1] > counts[0], f"and goes on: {counts}")
        check([failed for _, _, failed in shown][-1] == "1", "failures are counted")
        check(all(len(line) < 60 for line, _, _ in shown), "the line fits")
        check(all(line.endswith(".mtlx") for line, _, _ in shown), "and ends with the document")
        lines = screen(received)
        check(not any("checked," in line for line in lines), f"nothing of it stays: {lines}")
        piped = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
        check([line for line in lines if line] == piped.stdout.splitlines(), "what stays is what a pipe receives")
        check("checked," not in piped.stdout + piped.stderr, "a pipe receives no progress")
        check("\x1b" not in run_on_terminal(command, root, term="dumb")[1], "nor does a terminal that cannot erase")
        check("\x1b" not in run_on_terminal([*command, "--quiet"], root)[1], "nor anything with --quiet")


main(*sys.argv[1:])
finish("check-terminal")
