#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Neovim as a client of the language server, which others wrote: neovim.lua does what a user does. Argument: mxgen."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

DOCUMENT = """<?xml version="1.0"?>
<materialx version="1.39">
  <constant name="c" type="color3"/>
  <add name="sum" type="color3"><input name="in1" type="color3" nodename="c"/>
  <input name="inn2"   type="color3" nodename="c"/></add>
  <output name="out" type="color3" nodename="sum"/>
</materialx>
"""
EXPECTED = """message: unknown-input in line 5
hover: **constant** (procedural)
completion: c
symbols: c sum out
definition: line 3
action: Change to 'in2'
messages after it: 0
formatted:     <input name="in1" type="color3" nodename="c"/>
"""

if not shutil.which("nvim"):
    skip("there is no Neovim")
    finish("lsp-neovim")
with tempfile.TemporaryDirectory() as folder:
    document = pathlib.Path(folder) / "document.mtlx"
    document.write_text(DOCUMENT, encoding="utf-8")
    environment = {**os.environ, "MXGEN": str(pathlib.Path(sys.argv[1]).resolve()), "DOCUMENT": str(document), "HOME": folder}
    try:
        run = subprocess.run(["nvim", "--headless", "-u", "NONE", "-n", "-S", str(pathlib.Path(__file__).with_suffix(".lua"))], env=environment,
                             stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60, check=False)
        check(run.stdout == EXPECTED, f"Neovim shows\n{run.stdout}{run.stderr}in place of\n{EXPECTED}")
    except subprocess.TimeoutExpired as stopped:
        check(False, f"Neovim does not end: {stopped.stdout} {stopped.stderr}")
finish("lsp-neovim")
