#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the documentation says of the project itself: links lead somewhere, every page can be reached from README.md, its commands run as they
stand there and its program compiles. Arguments: the root of the project, the program, a C compiler."""
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

ROOT, MXGEN, COMPILER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3:]
LINK = re.compile(r"\]\(([^)\s]+)\)")
DRAWS = re.compile(r" render | --pictures")


def text_of(page):
    return page.read_text(encoding="utf-8")


def anchors(page):
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", text_of(page), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def targets(page):
    """Where the links of a page lead: file and anchor."""
    prose = re.sub(r"^```.*?^```", "", text_of(page), flags=re.MULTILINE | re.DOTALL)
    for link in LINK.findall(prose):
        if "://" in link:
            continue
        path, _, anchor = link.partition("#")
        yield link, (page.parent / path).resolve() if path else page, anchor


def check_links(page):
    for link, target, anchor in targets(page):
        check(target.exists(), f"{page.relative_to(ROOT)}: there is no {link}")
        if anchor and target.suffix == ".md" and target.exists():
            check(anchor in anchors(target), f"{page.relative_to(ROOT)}: there is no heading for {link}")


def reached(page):
    """Every page that links lead to, from one on."""
    found, ahead = set(), [page]
    while ahead:
        page = ahead.pop()
        if page in found:
            continue
        found.add(page)
        ahead += [target for _, target, _ in targets(page) if target.suffix == ".md" and target.exists()]
    return found


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```", text_of(ROOT / "README.md"), re.MULTILINE | re.DOTALL)


def check_commands():
    commands = [line.split("#")[0].strip() for block in blocks("sh") for line in block.splitlines() if line.startswith("build/mxgen")]
    check(len(commands) >= 10, f"README.md has {len(commands)} commands only")
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "build").symlink_to(MXGEN.parent)
        (pathlib.Path(folder) / "examples").symlink_to(ROOT / "examples")
        for command in commands:
            if DRAWS.search(command):
                continue
            result = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True, check=False)
            check(result.returncode == 0, f"README.md: `{command}` gives {result.returncode}: {result.stderr}")
    skip(f"{sum(bool(DRAWS.search(command)) for command in commands)} commands of README.md draw: tests/programs/render.sh does")


def check_program():
    for block in blocks("c"):
        result = subprocess.run([*COMPILER, "-std=c17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{ROOT / 'include'}", "-xc", "-"],
                                input=block, capture_output=True, text=True, check=False)
        check(result.returncode == 0, f"README.md: the program does not compile: {result.stderr}")


pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "examples" / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
for page in pages:
    check_links(page)
for page in set(pages) - reached(ROOT / "README.md"):
    check(False, f"no link leads from README.md to {page.relative_to(ROOT)}")
check_commands()
check_program()
finish("docs")
