#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Documentation: every link has a target, README.md links to every page, its commands run and its program compiles. Documentation,
comments and messages: every file and folder that they name exists.
Arguments: the root of the project, the program, a C compiler."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish, skip

ROOT, MXGEN, COMPILER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3:]
LINK = re.compile(r"\]\(([^)\s]+)\)")
DRAWS = re.compile(r" render | bake | export | import | --pictures")


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


FOLDERS = [path.name for path in ROOT.iterdir() if path.is_dir() and not path.name.startswith((".", "build"))]
ROOMS = [path.name for path in (ROOT / "src").iterdir()]
# "src/ir/ops.def", "tree/tree.h", "tests/fuzz/regression"; not what stands in another path, an address or a placeholder.
PATH = re.compile(rf"(?<![\w./<>$*{{}}-])((?:{'|'.join(FOLDERS + ROOMS)})/[\w./-]*\w)(?![\w/<>*{{}}…])")
# A source file in a folder that is there no more.
OLD_PATH = re.compile(r"(?<![\w./<>$*{}%@\"-])((?:\w+/)+\w+\.(?:c|h|cpp|def|sh|py|md))\b")
FILE = re.compile(r"(?<![\w./<>$*%@\"-])(\w+\.(?:c|h|def))\b(?!\.)")
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
# The first comment line of a block without a subject: what does "the same" mean to someone who reads it alone?
FRAGMENT = re.compile(r"(?:^|\n)[ \t]*(?:/\*[\s*]*|//\s*|#\s*|<!--\s*)((?:What|The same|Of) [^\n]*)")
MARKED = (".c", ".h", ".cpp", ".def", ".glsl", ".inline", ".osl", ".mtlx", ".html", ".css", ".js", ".mjs", ".ts", ".py", ".sh", ".build", "")
# The title of a check, which a reader sees when it fails: check 'a folder can be checked' …
TITLE = re.compile(r"^[ \t]*check (['\"])(.+?)\1", re.MULTILINE)
TEXTS = (".c", ".h", ".cpp", ".def", ".glsl", ".mtlx", ".py", ".sh", ".build", ".md", ".txt", "")
# Where a path of a comment may begin, beside the folder of the file itself.
PLACES = [ROOT, ROOT / "src", ROOT / "include", ROOT / "tests", ROOT / "libraries"]
NOT_OURS = {"stdosl.h"}


def sources():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in TEXTS and path.is_file() and not {"__pycache__", "node_modules"} & set(path.parts):
                yield path


def check_references():
    names = {path.name for path in sources()}
    for path in [*sources(), ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "meson.build"]:
        text = path.read_text(encoding="utf-8", errors="replace")
        if path.suffix == ".sh" or not path.suffix: # what their commands name may be made by them
            text = "".join(line if line.startswith("#") else "\n" for line in text.splitlines(keepends=True))
        where = path.relative_to(ROOT)
        for found in PATH.finditer(text):
            exists = any((place / f"{found[1]}{program}").exists() for place in [*PLACES, path.parent] for program in ("", ".c"))
            check(exists or found[1].startswith("build/"), f"{where}:{text.count(chr(10), 0, found.start()) + 1}: there is no {found[1]}")
        prose = [text] if path.suffix == ".md" else COMMENT.findall(text) if path.suffix in (".c", ".h", ".cpp", ".def") else []
        for found in OLD_PATH.findall("\n".join(prose)):
            check(any((place / found).exists() for place in [*PLACES, path.parent]), f"{where}: there is no {found}")
        if path.suffix in (".c", ".h", ".cpp", ".def"):
            for comment in COMMENT.finditer(text):
                for name in FILE.findall(comment[0]):
                    check(name in names | NOT_OURS, f"{where}:{text.count(chr(10), 0, comment.start()) + 1}: there is no {name}")
        check(not re.search(r"design[\s*]+section|section \d+ of the design", text), f"{where}: a section of a design that is not here")


def check_sentences():
    num_comments = num_titles = 0
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            where = path.relative_to(ROOT)
            if path.suffix not in MARKED or not path.is_file() or {"__pycache__", "node_modules"} & set(path.parts) or "golden" in where.parts and path.suffix == ".osl":
                continue
            text = path.read_text(encoding="utf-8", errors="replace")
            text = re.sub(r"^([ \t]*(?://|#)[^\n]*)\n(?=[ \t]*(?://|#))", r"\1 ", text, flags=re.MULTILINE) # lines of one comment
            for found in FRAGMENT.findall(text):
                check(False, f"{where}: a comment without a subject: {found}")
            num_comments += len(re.findall(r"/\*|//|#|<!--", text))
            for _, title in TITLE.findall(text) if path.suffix == ".sh" else ():
                num_titles += 1
                check(len(title.split()) > 2, f"{where}: the title of a check is no sentence: {title}")
    check(num_comments > 10000 and num_titles > 2000, f"{num_comments} comments and {num_titles} titles were found only")


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
    skip(f"{sum(bool(DRAWS.search(command)) for command in commands)} commands of README.md draw: tests/programs/render.sh, bake.sh and export.sh do")


def check_program():
    for block in blocks("c"):
        result = subprocess.run([*COMPILER, "-std=c17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{ROOT / 'include'}", "-xc", "-"],
                                input=block, capture_output=True, text=True, check=False)
        check(result.returncode == 0, f"README.md: the program does not compile: {result.stderr}")


def check_embedding():
    """The code of docs/embedding.md and docs/nodes.md is that of programs, which the tests run."""
    check_excerpts("docs/embedding.md", "examples/embedding.c", 10)
    check_excerpts("docs/nodes.md", "examples/nodes/studio.c", 5)


def check_excerpts(page, source, least):
    program = text_of(ROOT / source)
    excerpts = re.findall(r"^```c\n(.*?)^```", text_of(ROOT / page), re.MULTILINE | re.DOTALL)
    check(len(excerpts) >= least, f"{page} has {len(excerpts)} excerpts only")
    for excerpt in excerpts:
        check(excerpt in program, f"{page}: {source} does not have\n{excerpt}")


SEMANTIC = re.compile(r'^SEMANTIC\((\w+), "([^"]*)", "([^"]*)", "([^"]*)"\)$', re.MULTILINE)


def check_semantics():
    """The table of docs/reflection.md is that of semantics.def, which has every row of streams.def."""
    rows = SEMANTIC.findall(text_of(ROOT / "src/shader/semantics.def"))
    names = {block: "".join(word.capitalize() for word in block.split("_")) for block, *_ in rows}
    wanted = [f"| `{names[block]}` | `{semantic}` | {f'`{kind}` ' if kind else ''}| {meaning} |" for block, semantic, kind, meaning in rows]
    table = re.search(r"<!-- semantics -->\n(.*?)<!-- end -->", text_of(ROOT / "docs/reflection.md"), re.DOTALL)
    check(table and table[1].splitlines()[2:] == wanted, "docs/reflection.md: the table of semantics differs from src/shader/semantics.def")
    known = {semantic for _, semantic, *_ in rows}
    streams = text_of(ROOT / "src/shader/streams.def")
    for name in re.findall(r"^UNIFORM\((\w+)", streams, re.MULTILINE):
        check(name in known, f"semantics.def: there is no {name}")
    for name in re.findall(r"^MATRICES\((\w+)\)", streams, re.MULTILINE):
        check({f"{name}Matrix", f"{name}*Matrix"} <= known, f"semantics.def: there is no {name}Matrix")
    for name in re.findall(r'^FAMILY\("(\w+)_"', streams, re.MULTILINE):
        check(f"{name}:*" in known, f"semantics.def: there is no {name}:*")
    for name in re.findall(r"^STREAM\((\w+)", streams, re.MULTILINE):
        semantic = re.sub(r"(World|Object)$", lambda space: f":{space[0].lower()}", name)
        check(semantic in known, f"semantics.def: there is no {semantic}")


def rows_of_roles():
    """A row for each role and reason, with the options of the tasks that the role lacks for it."""
    options = re.findall(r'^OPTION\(\w+, "([\w-]+)", \w+, \w+, (\w+),', text_of(ROOT / "src/api/options.def"), re.MULTILINE)
    roles = text_of(ROOT / "src/spell/roles.def").partition("---- Roles that no option")[0]
    storage = re.search(r"#define LACKS_STORAGE(.*?)\n\n", roles, re.DOTALL)[1]
    for name, traits in re.findall(r"^ROLE\((\w+),(.*?)\)$", roles, re.MULTILINE | re.DOTALL):
        lacks = dict(re.findall(r'\[TASK_(\w+)\] = "([^"]*)"', traits.replace("LACKS_STORAGE", storage)))
        reasons = {}
        for key, task in options:
            if task in lacks:
                reasons.setdefault(lacks[task], []).append(f"`{key}`")
        yield from (f"| `role={name}` | {', '.join(keys)} | {why} |" for why, keys in reasons.items())


def check_combinations():
    """The table of options that mean nothing together has the rows of roles.def and combinations.def."""
    values = text_of(ROOT / "src/api/combinations.def")
    pairs = [("role", *row) for row in re.findall(r'^ROLE_VALUE\((\w+), (\w+), "([^"]*)", "([^"]*)"\)', values, re.MULTILINE)]
    pairs += re.findall(r'^COMBINATION\((\w+), "([^"]*)", (\w+), (?:"([^"]*)"|NULL),\s+"([^"]*)"\)', values, re.MULTILINE)
    key = lambda option: option.replace("_", "-")
    wanted = [*rows_of_roles(), *(f"| `{key(a)}={value}` | `{key(b)}{other and f'={other}'}` | {why} |" for a, value, b, other, why in pairs)]
    section = text_of(ROOT / "docs/deferred.md").partition("## Roles and options")[2].partition("\n## ")[0]
    check(len(wanted) > 20 and re.findall(r"^\| `.*$", section, re.MULTILINE) == wanted,
          "docs/deferred.md: the table of combinations differs from roles.def and combinations.def")


def check_pictures():
    """The tables of how near deferred pictures are have a row for each row of pictures.def."""
    rows = re.findall(r'^[A-Z]+\((?:"[^"]*"|\d+), "([^"]*)", ([\d, ]+)\)$', text_of(ROOT / "tests/deferred/pictures.def"), re.MULTILINE)
    wanted = [f"| {name} |" + "".join(f" {db} dB |" if db != "0" else " |" for db in numbers.split(", ")) for name, numbers in rows]
    section = text_of(ROOT / "docs/deferred.md").partition("## Measured")[2]
    check(len(wanted) > 30 and re.findall(r"^\| .* dB \|.*$", section, re.MULTILINE) == wanted,
          "docs/deferred.md: the tables of pictures differ from tests/deferred/pictures.def")


def check_papers():
    """Each row of docs/papers.md names tests that are there, or says what is missing. The build's folder has the list of tests."""
    tests = {test["name"] for test in json.loads(text_of(MXGEN.parent / "meson-info/intro-tests.json"))}
    page = text_of(ROOT / "docs/papers.md").replace("\\|", "/")
    rows = [[cell.strip() for cell in row.split("|")] for row in re.findall(r"^\|(.*)\|$", page, re.MULTILINE)]
    rows = [row for row in rows if row[0] not in ("section", "chapter") and set(row[0]) != {"-"}]
    check(len(rows) > 100, f"docs/papers.md has {len(rows)} rows only")
    for row in rows:
        check(len(row) == 5 and (row[3] or row[4]), f"docs/papers.md: a row without a test does not say what is missing: {row}")
        for name in re.findall(r"`([^`]+)`", row[3]):
            check(name in tests, f"docs/papers.md: there is no test {name}")


pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "examples" / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
for page in pages:
    check_links(page)
for page in set(pages) - reached(ROOT / "README.md"):
    check(False, f"no link leads from README.md to {page.relative_to(ROOT)}")
check_references()
check_sentences()
check_commands()
check_program()
check_semantics()
check_combinations()
check_pictures()
check_embedding()
check_papers()
finish("docs")
