#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The names of the public functions follow the grammar of CONTRIBUTING.md, and their parameters and results follow the names. Argument:
the root of the project."""
import pathlib
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent))
from checks import check, finish

ROOT = pathlib.Path(sys.argv[1])
COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
FUNCTION = re.compile(r"MXG_API\s+([\w\s]+?[\s*]+)(mxg_\w+)\(((?:[^()]|\([^()]*\))*)\);")
OBJECT = re.compile(r"typedef struct (mxg_\w+) \1;")
MEMBER = re.compile(r"\b(num_\w+)\b[^;()]*;")

# The makers of objects, and the verbs. A verb of the third list also stands alone: it then acts on the object itself.
MAKERS = "create load parse import builtin ref".split()
VERBS = "add connect copy move pack remove rename report require set write".split()
ALONE = "commit destroy format ref set unref write".split()
# Verbs of no object: they take a context and make a result.
ACTIONS = "generate inspect rewrite translate validate".split()
# Functions without an object: a catalogue of all that a version of mxgen has, and values.
CATALOGUE = "catalogue"
VALUES = {"color": ["difference"], "slot": ["decode", "encode"], "status": ["string"], "version": ["string"]}
# Numbers of things that no getter gives, and things of two numbers: inputs and outputs.
COUNTS = {"mxg_bindings_num_resolved_primitives", "mxg_diagnostics_num_errors"}
PARTS = {"port"}


class Function:
    def __init__(self, result, name, parameters):
        self.result, self.name = " ".join(result.replace("*", " * ").split()), name
        parts = re.split(r",(?![^()]*\))", parameters)
        self.parameters = [] if parts == ["void"] else [" ".join(part.replace("*", " * ").split()) for part in parts]

    def takes(self, place, pattern):
        return bool(self.parameters) and re.fullmatch(pattern, self.parameters[place]) is not None

    def check(self, good, fault):
        check(good, f"{self.name}: {fault}")


def declarations():
    """The text of the headers, and their functions by name."""
    headers = sorted((ROOT / "include/mxgen").glob("*.h"))
    text = COMMENT.sub("", "\n".join(header.read_text(encoding="utf-8") for header in headers))
    functions = {name: Function(result, name, parameters) for result, name, parameters in FUNCTION.findall(text)}
    return text, functions


def singular(nouns):
    for ending, other in ("ies", "y"), ("sses", "ss"), ("s", ""):
        if nouns.endswith(ending):
            return nouns.removesuffix(ending) + other
    return None


def split_name(name, objects):
    """The object of a function, and the words behind it."""
    words = name.split("_")[1:]
    return (words[0], words[1:]) if words[0] in objects else (None, words)


def check_maker(function, kind, verb):
    if function.result == f"mxg_{kind} *":
        function.check(verb in ("builtin", "ref"), "a maker returns mxg_status")
        return
    made = function.parameters[-1] if function.parameters else ""
    function.check(function.result == "mxg_status" and re.fullmatch(r"mxg_(\w+) \* \* out_\1", made), "a maker gives the object last")


def check_count(function, kind, nouns, functions, members):
    noun = singular(nouns)
    getter = f"mxg_{kind}_{noun}"
    function.check(function.result == "uint32_t", "a number of things is a uint32_t")
    found = any(name == getter or name.startswith(f"{getter}_") for name in functions)
    function.check(noun and (found or function.name in COUNTS), f"there is no {getter}")


def check_getter(function, kind, words, functions, members):
    """A getter by index has a number of things: a function, or a member of a struct."""
    noun = "_".join(words)
    if any(re.fullmatch(r"uint32_t index", parameter) for parameter in function.parameters):
        counts = [name for name in functions if name.startswith(f"mxg_{kind}_num_") and noun.startswith(singular(name.split("_num_")[1]))]
        counts += [name for name in members if noun.startswith(singular(name[4:]) or " ") or noun.endswith(singular(name[4:]) or " ")]
        function.check(counts or noun in PARTS, "nothing gives the number of these")
    fills = function.takes(-1, r"mxg_\w+ \* out")
    function.check(not fills or function.result == "mxg_status" or kind == "build", "a getter of a struct returns mxg_status")


def check_object(function, kind, words, functions, members):
    verb, nouns = words[0], "_".join(words[1:])
    if verb in MAKERS and (not nouns) and not (verb == "ref"):
        check_maker(function, kind, verb)
        return
    if words == ["desc", "error"]:
        function.check(function.takes(0, rf"const mxg_{kind}_desc \* desc"), "the first parameter is the description")
        return
    if kind != CATALOGUE:
        function.check(function.takes(0, rf"(const )?mxg_{kind} \* \w+"), f"the first parameter is the {kind}")
    else:
        function.check(not any(re.match(r"(const )?mxg_(context|library|document|result) ", p) for p in function.parameters), "the catalogue needs no object")
    if verb == "num":
        check_count(function, kind, nouns, functions, members)
    elif verb == "has":
        function.check(function.result == "bool", "it answers with a bool")
    elif verb in VERBS or verb in ALONE:
        function.check(nouns or verb in ALONE, f"'{verb}' what?")
    elif verb == "find":
        function.check(function.result in ("uint32_t", "mxg_element"), "it gives a number")
    else:
        check_getter(function, kind, words, functions, members)


def check_text(function):
    """A text that is made for the call goes to the caller's buffer."""
    if any(re.fullmatch(r"char \* \w+", parameter) for parameter in function.parameters):
        function.check(function.parameters[-2:] == ["char * buffer", "size_t capacity"] and function.result == "size_t",
                       "buffer and capacity stand last, and the result is the length")
    if function.name.endswith("_error") and function.name.count("_") == 2:
        function.check("char * buffer" in function.parameters, "the reason goes to a buffer")


def check_action(function, words):
    function.check(words[0] in ACTIONS, f"'{words[0]}' is neither an object nor an action")
    good = function.takes(0, r"mxg_context \* context") and function.takes(-1, r"mxg_result \* \* out_result")
    function.check(good and function.result == "mxg_status", "an action takes a context and makes a result")


def check_layout():
    """A declaration stays on its line: a comment that is too long for it stands above, or the formatter breaks behind the type."""
    for header in sorted((ROOT / "include/mxgen").glob("*.h")):
        broken = re.search(r"^ +(?:const )?(?:struct |enum )?\w+(?: \*)*$", COMMENT.sub("", header.read_text(encoding="utf-8")), re.MULTILINE)
        check(not broken, f"{header.name}: '{broken and broken.group().strip()}' is alone on a line; put the comment above the declaration")


def check_user_interface():
    """The data of an input for user interfaces is a table, src/shader/ui.def; languages that cannot include it have the same rows."""
    def text(path):
        return COMMENT.sub("", (ROOT / path).read_text(encoding="utf-8"))

    def block(path, begin, end):
        return re.search(rf"{begin}(.*?){end}", (ROOT / path).read_text(encoding="utf-8"), re.DOTALL).group(1)

    rows = re.findall(r"^UI\((\w+), (\w+), ", text("src/shader/ui.def"), re.MULTILINE)
    members, attributes = [row[0] for row in rows], [row[1] for row in rows]
    check(len(rows) > 8, "src/shader/ui.def has rows")
    camel = [re.sub(r"_(\w)", lambda found: found[1].upper(), member) for member in members]
    page = block("js/mxgen/index.d.ts", r"interface UserInterface \{", r"\n\}")
    python = block("python/mxgen/definition.py", r"class UserInterface:", r"@dataclass")
    for path, names, found in [
        ("js/mxgen/index.d.ts", camel, re.findall(r"^ +(\w+): string;", page, re.MULTILINE)),
        ("python/mxgen/definition.py", members, re.findall(r"^    (\w+): str$", python, re.MULTILINE)),
    ]:
        check(sorted(names) == sorted(found), f"{path}: UserInterface has {sorted(set(names) ^ set(found))} more or less than src/shader/ui.def")
    for struct in "mxg_variable", "mxg_port", "mxg_compiled_input":
        header = "library.h" if struct == "mxg_port" else "reflection.h"
        body = block(f"include/mxgen/{header}", rf"typedef struct {struct} \{{", rf"\}} {struct};")
        missing = [member for member in members if not re.search(rf"\b{member}\b", body)]
        check(not missing, f"include/mxgen/{header}: {struct} has no {missing}")
    for path, quote in ("lsp/attributes.def", '"'), ("src/document/attributes.def", ""):
        known = set(re.findall(rf"^ATTRIBUTE\({quote}(\w+){quote}, ", text(path), re.MULTILINE))
        check(not set(attributes) - known, f"{path} has no {sorted(set(attributes) - known)}")


def check_room(functions):
    """The room api defines all of them: who reads it has seen what a host can call."""
    defined = {}
    for path in sorted((ROOT / "src").rglob("*.c")):
        for name in re.findall(r"^[a-z][^;=\n]*?\b(mxg_\w+)\((?=[^;{]*\)\s*\{)", path.read_text(encoding="utf-8"), re.MULTILINE):
            defined[name] = path.relative_to(ROOT)
    for name, path in defined.items():
        check(name not in functions or path.parts[:2] == ("src", "api"), f"{name} is a function of hosts: it belongs to src/api, not to {path}")
    missing = functions.keys() - defined.keys()
    check(not missing, f"no definition was found of {sorted(missing)}")


def main():
    text, functions = declarations()
    members = set(MEMBER.findall(text))
    objects = {name[4:] for name in OBJECT.findall(text)} | {CATALOGUE}
    for function in functions.values():
        kind, words = split_name(function.name, objects)
        check_text(function)
        if words[0] in VALUES and kind is None:
            function.check(words[1:] and words[1] in VALUES[words[0]], "unknown word of a value")
        elif kind is None:
            check_action(function, words)
        else:
            function.check(bool(words), "an object alone says nothing")
            if words:
                check_object(function, kind, words, functions, members)
    check(len(functions) > 150, f"the headers declare {len(functions)} functions only")
    check_layout()
    check_room(functions)
    check_user_interface()
    print(f"{len(functions)} functions of {len(objects)} objects")
    finish("grammar")


main()
