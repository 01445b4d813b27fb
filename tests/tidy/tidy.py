#!/usr/bin/env python3
"""Holds the rules of the tree: layer order, sizes, names, one library a folder.

usage: tidy.py TREE        prints PLACE: what is wrong, one a line; exit 1 when there is any
"""

import ast
import fnmatch
import os
import re
import sys
from pathlib import Path

# Layers, top to bottom: a file includes only its own folder and folders above it.
CORE = """base codegen numerics spatial laws topology flexible model kinematics closures forces
          dynamics simulation""".split()
STUDY = """record design config metrics evaluate schedule tune converge calibrate
           sensitivity store report kinematics session plan queue page cli""".split()
LAYERS = [f"core/{name}" for name in CORE] + [f"study/{name}" for name in STUDY]

# Headers of a library, and the only places of core/ and study/ that include them.
LIBRARIES = [
    (r"toml(\+\+|plusplus)?[./]", ["study/config/"]),
    (r"mpi\.h$", ["study/schedule/", "study/cli/main.cpp"]),
    (r"(hdf5\w*|H5\w*)\.h$", ["study/store/"]),
    (r"nlopt\.", ["study/tune/", "study/calibrate/"]),
    (r"boost/numeric/odeint", ["core/numerics/"]),
    (r"boost/program_options", ["study/cli/"]),
    (r"spdlog/", ["study/session/"]),
    (r"openssl/", ["study/record/"]),
    (r"xbyak/", ["core/codegen/"]),
    (r"(\w*intrin\.h|experimental/simd)$", ["core/base/"]),
    (r"(fstream|filesystem|iostream|fmt/.*)$", ["study/"]),  # core/ is silent and has no files
]

TOP_LEVEL = {"CMakeLists.txt", "core", "study", "configs", "jobs", "tests", "README.md",
             ".ci", ".clang-format", ".gitignore"}
LINE_WIDTH = 100
FUNCTION_LINES = 70
FILE_LINES = 500
CODE = {".h", ".cpp", ".py", ".sh"}
TEXT = CODE | {".toml", ".txt", ".md", ".sbatch", ""}
NAMES = re.compile(r"[a-z0-9_]+(\.[a-z0-9_]+)*$")
OTHER_NAMES = {"README.md", "CMakeLists.txt"}

# In parts, so that this file does not find itself.
MARKS = re.compile(r"\b(" + "|".join(["TO" + "DO", "FIX" + "ME", "XX" + "X", "HA" + "CK"]) + r")\b"
                   + r"|^(<{7}|>{7}|={7})( |$)")
FOLDERS = ["home", "root", "work", "mnt", "media", "Users", "scratch"]
MACHINE_PATH = re.compile(r"(?<![\w./})\]*])/(" + "|".join(FOLDERS) + r")/")


def find_files(tree):
    """Every file of the tree as a path relative to it, without what .gitignore leaves out."""
    ignored = [".git"]
    if (tree / ".gitignore").exists():
        ignored += [line.rstrip("/") for line in (tree / ".gitignore").read_text().split()]

    def is_kept(name):
        return not any(fnmatch.fnmatch(name, pattern) for pattern in ignored)

    for folder, folders, names in os.walk(tree):
        folders[:] = sorted(name for name in folders if is_kept(name))
        for name in sorted(filter(is_kept, names)):
            yield (Path(folder) / name).relative_to(tree)


def layer_of(path):
    """Rank of the layer a file of core/ or study/ belongs to; None for a folder of no layer."""
    folder = "/".join(Path(path).parts[:2])
    return LAYERS.index(folder) if folder in LAYERS else None


def includes_of(text):
    """(line number, path, whether in quotes) of every include."""
    for number, line in enumerate(text.splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
        if found:
            yield number, found[2], found[1] == '"'


def check_layers(path, text):
    if path.parts[0] not in ("core", "study") or path.suffix not in (".h", ".cpp"):
        return
    own = layer_of(path)
    if own is None:
        yield 1, f"'{path.parent}' is no layer of the architecture"
        return
    for number, included, is_ours in includes_of(text):
        other = layer_of(included)
        if is_ours and other is None:
            yield number, f"include by the path from the top of the tree, got '{included}'"
        elif is_ours and other > own:
            yield number, f"'{LAYERS[own]}' includes '{included}', which is below it"


def check_libraries(path, text):
    if path.parts[0] not in ("core", "study"):
        return
    for number, included, is_ours in includes_of(text):
        for pattern, places in LIBRARIES:
            at_home = any(path.as_posix().startswith(place) for place in places)
            if not is_ours and re.match(pattern, included) and not at_home:
                yield number, f"<{included}> belongs in {' and '.join(places)} only"


def check_silence(path, text):
    if path.parts[0] != "core":
        return
    for number, line in enumerate(text.splitlines(), 1):
        if re.search(r"\b(f?printf|f?puts|fopen)\s*\(|\bstd::(cout|cerr|clog)\b", line):
            yield number, "core/ prints nothing and opens no files"


def check_header(path, text):
    if path.suffix != ".h":
        return
    if not text.startswith("//"):
        yield 1, "a header opens with what it computes"
    if "\n#pragma once\n" not in text:
        yield 1, "a header has #pragma once"


def check_lines(path, text):
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        if len(line) > LINE_WIDTH and path.suffix != ".md":
            yield number, f"line of {len(line)} characters, at most {LINE_WIDTH}"
        if MARKS.search(line):
            yield number, "mark left over"
        if MACHINE_PATH.search(line):
            yield number, "absolute path of a machine"
    if len(lines) > FILE_LINES and path.suffix in CODE:
        yield FILE_LINES, f"file of {len(lines)} lines, at most {FILE_LINES}"


def blank(match):
    return re.sub(r"[^\n]", " ", match[0])


TOKENS = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'
                    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"
                    r"|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE)
SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")
ACCESS = re.compile(r"\s*(public|private|protected)\s*:(?!:)")


def kind_of_brace(head):
    """What a brace opens, by the declaration before it; a blank stands before a body."""
    if re.search(r"(=\s*|[\w>\])}])$", head):
        return "initialiser"
    head = re.sub(r"^\s*template\s*<[^{}]*>\s*(?=(class|struct|union)\b)", "", head)
    if SCOPE.search(head) and "(" not in head:
        return "scope"
    return "function" if "(" in head else "other"


def functions_of(text):
    """(first line, last line) of every function of C++ text; lambdas count with theirs."""
    text = TOKENS.sub(blank, text)
    braces = []  # of every open one: (kind, line where its declaration begins)
    start = 0    # where the declaration under way begins
    for at, char in enumerate(text):
        outside = all(kind == "scope" for kind, _ in braces)
        if char == "{":
            access = ACCESS.match(text, start, at)
            begin = access.end() if access and outside else start
            head = text[begin:at]
            kind = kind_of_brace(head) if outside else "other"
            begin += len(head) - len(head.lstrip())
            braces.append((kind, text.count("\n", 0, begin) + 1))
        elif char == "}" and braces:
            kind, line = braces.pop()
            if kind == "function":
                yield line, text.count("\n", 0, at) + 1
            if kind == "initialiser":
                continue
        if char in ";{}" and all(kind == "scope" for kind, _ in braces):
            start = at + 1


def raw_strings_of(text):
    """(first line, last line) of every raw string: data, which counts as one line of a function."""
    for found in TOKENS.finditer(text):
        if found[0].startswith('R"'):
            first = text.count("\n", 0, found.start()) + 1
            yield first, first + found[0].count("\n")


def python_functions_of(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.lineno, node.end_lineno


def check_functions(path, text):
    find = {".cpp": functions_of, ".h": functions_of, ".py": python_functions_of}
    if path.suffix not in find:
        return
    texts = list(raw_strings_of(text)) if path.suffix != ".py" else []
    for first, last in find[path.suffix](text):
        inside = [end - begin for begin, end in texts if first <= begin and end <= last]
        length = last - first + 1 - sum(inside)
        if length > FUNCTION_LINES:
            yield first, f"function of {length} lines, at most {FUNCTION_LINES}"


# A block of one statement that the line of its head has room for: "if (a) {" "  b();" "}".
SHORT_BLOCK = re.compile(r"^(?P<head> *(?:if|for|while) \([^\n]*\)) \{\n"
                         r" *(?P<body>[^\n{}/]*;)\n *\}(?!\n? *else)$", re.M)
CONSTANT = re.compile(r"^(?:inline |static )*constexpr [^(={]*?(?P<name>\w+)(?:<[^<>]*>)?"
                      r"(?:\[\w*\])?(?: = |\{)", re.M)


def fits_on_one_line(head, body):
    """Macros of tests have an else of their own, which a compiler warns of behind an if."""
    is_macro = head.lstrip().startswith("if") and re.match(r"(EXPECT|ASSERT)_", body)
    return not is_macro and len(f"{head} {body}") <= LINE_WIDTH


def check_style(path, text):
    """What clang-format leaves open."""
    if path.suffix not in (".h", ".cpp"):
        return
    for found in SHORT_BLOCK.finditer(text):
        if fits_on_one_line(found["head"], found["body"]):
            yield text.count("\n", 0, found.start()) + 1, "one short statement needs no braces"
    for found in CONSTANT.finditer(text):
        is_trait = found["name"].startswith(("is_", "has_"))
        if not is_trait and not re.match(r"k[A-Z]", found["name"]):
            yield (text.count("\n", 0, found.start()) + 1,
                   f"constant '{found['name']}' is not named kName")
    is_test = path.parts[0] == "tests" and re.search(r"^TEST(_F|_P)?\(", text, re.M)
    if is_test and not path.name.endswith("_test.cpp"):
        yield 0, "tests stand in files named *_test.cpp"


def check_name(path):
    for part in path.parts:
        if part not in OTHER_NAMES and not part.startswith(".") and not NAMES.match(part):
            yield 0, f"'{part}' is not snake_case"
    if path.parts[0] not in TOP_LEVEL:
        yield 0, f"'{path.parts[0]}' does not belong at the top"


def find_cycle(includes):
    """Headers that include each other, as a list that ends where it starts; empty when none do."""
    done, trail = set(), []

    def visit(path):
        if path in trail:
            return trail[trail.index(path):] + [path]
        if path in done:
            return []
        trail.append(path)
        cycle = next(filter(None, map(visit, includes.get(path, []))), [])
        trail.pop()
        done.add(path)
        return cycle

    return next(filter(None, map(visit, includes)), [])


def check_layer_list(tree):
    """The build links the folders in the order this check holds."""
    build = "".join((tree / top / "CMakeLists.txt").read_text()
                    for top in ("core", "study") if (tree / top / "CMakeLists.txt").exists())
    for top, folders in (("core", CORE), ("study", STUDY)):
        found = re.search(rf"linkstudy_layers\({top} \S+([^)]*)\)", build)
        if found and found[1].split() != folders:
            yield f"{top}/CMakeLists.txt", 0, "its layers are not those of tests/tidy/tidy.py"


CHECKS = [check_layers, check_libraries, check_silence, check_header, check_lines, check_functions,
          check_style]


def check_tree(tree):
    """Everything wrong in a tree: (path, line, message); line 0 means the whole file."""
    includes = {}
    yield from check_layer_list(tree)
    for path in find_files(tree):
        yield from ((path, *problem) for problem in check_name(path))
        if path.suffix not in TEXT:
            continue
        text = (tree / path).read_text(encoding="utf-8")
        if path.suffix == ".h":
            includes[path.as_posix()] = [name for _, name, ours in includes_of(text) if ours]
        for check in CHECKS:
            yield from ((path, *problem) for problem in check(path, text))
    cycle = find_cycle(includes)
    if cycle:
        yield cycle[0], 0, "headers include each other: " + " -> ".join(cycle)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    problems = list(check_tree(Path(sys.argv[1])))
    for path, line, message in problems:
        print(f"{path}:{line}: {message}" if line else f"{path}: {message}")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
