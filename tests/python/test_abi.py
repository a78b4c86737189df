"""The module's idea of the library against ramify.h itself."""

import ctypes
import re
import subprocess
from pathlib import Path

from ramify import _abi

HEADER = Path("src/ramify.h")


def test_structs_are_laid_out_as_the_compiler_does(tmp_path):
    lines, expected = [], []
    for name, struct in _abi.STRUCTS.items():
        lines.append(f'printf("%zu\\n", sizeof({name}));')
        expected.append(ctypes.sizeof(struct))
        for field, _ in struct._fields_:
            lines.append(f'printf("%zu %zu\\n", offsetof({name}, {field}), sizeof((({name} *)0)->{field}));')
            expected.append((getattr(struct, field).offset, getattr(struct, field).size))
    source = tmp_path / "layout.c"
    source.write_text(f'#include "{HEADER.resolve()}"\n#include <stdio.h>\nint main(void)\n{{\n' + "\n".join(lines) + "\n}\n")
    subprocess.run(["cc", source, "-o", tmp_path / "layout"], check=True)
    printed = subprocess.run([tmp_path / "layout"], check=True, capture_output=True, text=True).stdout.splitlines()
    found = [tuple(map(int, line.split())) if " " in line else int(line) for line in printed]
    assert found == expected


def declarations():
    text = re.sub(r"//[^\n]*", "", HEADER.read_text())
    for result, name, arguments in re.findall(r"RAMIFY_API\s+([\w\s*]+?)\s*\bramify_(\w+)\(([^;]*)\);", text):
        types = [] if arguments.strip() == "void" else [a.strip() for a in arguments.split(",")]
        stars = "*" * result.count("*")
        yield name, " ".join(result.replace("*", " ").split()) + stars, types


def kind(ctype):
    """What a ctypes type is in a register: a size, or a pointer."""
    if ctype is None:
        return "void"
    if ctype in (ctypes.c_char_p, ctypes.c_void_p) or hasattr(ctype, "contents") or issubclass(ctype, ctypes._CFuncPtr):
        return "pointer"
    return {"c_int": "int", "c_long": "int64", "c_ulong": "uint64", "c_bool": "bool", "c_double": "double"}[ctype.__name__]


def kind_of_text(declared):
    if "*" in declared or "[" in declared or declared.startswith("RamifyPass"):
        return "pointer"
    word = re.sub(r"\bconst\b", "", declared).split()[0]
    return {"void": "void", "int": "int", "int64_t": "int64", "uint64_t": "uint64", "size_t": "uint64", "bool": "bool", "double": "double"}[word]


def test_functions_take_and_give_what_the_header_says():
    header = {name: (result, arguments) for name, result, arguments in declarations()}
    assert len(header) > 60
    for name, (result, arguments) in _abi.FUNCTIONS.items():
        assert name in header, f"ramify_{name} is not in ramify.h"
        told_result, told_arguments = header[name]
        assert kind(result) == kind_of_text(told_result), name
        assert [kind(a) for a in arguments] == [kind_of_text(a) for a in told_arguments], name


def test_the_version_is_that_of_the_header():
    import ramify

    assert f'#define RAMIFY_VERSION "{ramify.__version__}"' in HEADER.read_text()
