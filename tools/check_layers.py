#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright the Swiftlet authors
"""Checks that no file under src/swiftlet includes what its layer may not see.

    tools/check_layers.py [PROJECT_FOLDER]

The rules are the table under "## Layers" in ARCHITECTURE.md; there is no second copy. A folder within a layer is a
layer too, a room: it has a row of its own, `integrate/rays`, which names the rooms beside it that it may see. It sees
what the layer around it sees; the layer's own files (interface, registry) and its rooms see each other. Exit code 0 if
all hold, 1 with one line a fault, 2 if the table cannot be read.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

INCLUDE = re.compile(r"^\s*#\s*include\s*(.*)$")
NAME = r"`(\w+(?:/\w+)*)`"
ROW = re.compile(rf"^\|\s*{NAME}\s*\|\s*(core|edge)\s*\|([^|]*)\|")

# Core does no input or output.
IO_HEADERS = {"cstdio", "filesystem", "fstream", "iostream", "print", "syncstream"}
# Third-party headers that core, and every header we install, may include; all others stay inside a .cpp.
PUBLIC_THIRD_PARTY = re.compile(r"Eigen/\w+|tl/expected\.hpp|fmt/(core|format)\.h")
# Of these, Highway stays inside core's .cpp files: users of the library never see a vector.
PRIVATE_THIRD_PARTY = re.compile(r"hwy/\w+\.h")


@dataclass
class Layer:
    is_core: bool
    may_see: set


class TableError(Exception):
    """The layer table is missing or contradicts itself."""


def read_table(text):
    """Layers by name, from the markdown of ARCHITECTURE.md."""
    section = re.search(r"^## Layers$(.*?)(?=^## |\Z)", text, re.M | re.S)
    rows = [ROW.match(line) for line in section.group(1).splitlines()] if section else []
    layers = {
        row[1]: Layer(row[2] == "core", set(re.findall(NAME, row[3]))) for row in rows if row
    }
    if not layers:
        raise TableError("ARCHITECTURE.md: no layer table under '## Layers'")
    for name, layer in layers.items():
        if "/" in name and (around := name.rpartition("/")[0]) not in layers:
            raise TableError(f"ARCHITECTURE.md: room {name} lies in {around}, which has no row")
        if unknown := sorted(layer.may_see - layers.keys()):
            raise TableError(f"ARCHITECTURE.md: layer {name} may see {unknown[0]}, which has no row")
        if edge := sorted(seen for seen in layer.may_see if layer.is_core and not layers[seen].is_core):
            raise TableError(f"ARCHITECTURE.md: core layer {name} may not see {edge[0]}, which does I/O")
    if cycle := find_cycle({name: layer.may_see for name, layer in layers.items()}):
        raise TableError(f"ARCHITECTURE.md: layers in a cycle: {' -> '.join(cycle)}")
    return layers


def find_cycle(graph):
    """The nodes of one cycle, first one repeated at the end; None if there is none."""
    done, path = set(), []

    def visit(node):
        if node in path:
            return path[path.index(node):] + [node]
        if node in done:
            return None
        path.append(node)
        cycle = next(filter(None, map(visit, sorted(graph.get(node, ())))), None)
        path.pop()
        done.add(node)
        return cycle

    return next(filter(None, map(visit, sorted(graph))), None)


def with_those_around(name):
    """A layer and the layers it lies in, the innermost first."""
    while name:
        yield name
        name = name.rpartition("/")[0]


def may_see(name, other, layers):
    """Whether a file of one layer may include a header of another."""
    around, around_other = list(with_those_around(name)), list(with_those_around(other))
    if name in around_other or other in around:
        return True
    return any(seen in layers[layer].may_see for layer in around for seen in around_other)


def layer_of(path):
    """The folder of a file, both relative to src/swiftlet."""
    return path.parent.as_posix()


def includes_of(path):
    """(line number, what stands between the brackets or quotes) of each include; None for a macro."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if include := INCLUDE.match(line):
            name = re.match(r'[<"]([^>"]+)[>"]', include[1])
            yield number, name[1] if name else None


def is_standard(header):
    """C++ headers have neither folder nor ending; C and system headers end in .h."""
    return "/" not in header and "." not in header


def fault_of(file, layer_name, layers, header, source_root):
    """What is wrong with one include; None if nothing is."""
    layer = layers[layer_name]
    if header is None:
        return "includes a macro, which no reader can follow"
    if header.startswith("swiftlet/"):
        if not (source_root / header).is_file():
            return f"includes {header}, which does not exist"
        other = layer_of(Path(header).relative_to("swiftlet"))
        if not may_see(layer_name, other, layers):
            return f"layer {layer_name} may not see layer {other} ({header})"
        return None
    if (file.parent / header).is_file():
        return f'includes {header} by a relative path; write "swiftlet/{layer_name}/{header}"'
    if layer.is_core and header in IO_HEADERS:
        return f"core layer {layer_name} does no I/O, but includes <{header}>"
    is_installed = file.suffix == ".hpp" and not file.name.endswith("_private.hpp")
    if not is_installed and PRIVATE_THIRD_PARTY.fullmatch(header):
        return None
    is_public = layer.is_core or (is_installed and layer_name.split("/")[0] != "app")
    if is_public and not is_standard(header) and not PUBLIC_THIRD_PARTY.fullmatch(header):
        who = f"core layer {layer_name}" if layer.is_core else "an installed header"
        return f"{who} may not include <{header}>; keep it in a .cpp behind the library's edge"
    return None


def check(project):
    """All faults of a project, as 'file:line: sentence'."""
    layers = read_table((project / "ARCHITECTURE.md").read_text(encoding="utf-8"))
    source_root = project / "src"
    root = source_root / "swiftlet"
    faults, graph = [], {}
    files = sorted([*root.rglob("*.hpp"), *root.rglob("*.cpp")])
    for folder in sorted({file.parent for file in files if layer_of(file.relative_to(root)) not in layers}):
        faults.append(f"{folder.relative_to(project)}: has no row in the layer table of ARCHITECTURE.md")
    for file in files:
        layer_name = layer_of(file.relative_to(root))
        if layer_name not in layers:
            continue
        seen = list(includes_of(file))
        graph[str(file.relative_to(source_root))] = {name for _, name in seen if name}
        for line, header in seen:
            if fault := fault_of(file, layer_name, layers, header, source_root):
                faults.append(f"{file.relative_to(project)}:{line}: {fault}")
    if cycle := find_cycle(graph):
        faults.append(f"src/{cycle[0]}: includes itself: {' -> '.join(cycle)}")
    if not graph:
        faults.append("src/swiftlet: holds no source files")
    return faults


def main():
    project = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    try:
        faults = check(project)
    except (OSError, TableError) as error:
        print(f"check_layers: {error}", file=sys.stderr)
        return 2
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
