"""Prints the names in the messages of src/ that look like a key of the scene but are none.

usage: message_keys.py PATHS SOURCE...; PATHS holds what `ramify schema --paths` prints. A name of several keys must be
a piece of a path: growth.levels[].kill is one of objects.NAME.tree.crown.growth.levels.N.kill.
"""
import re
import sys

# Words with _ that are no keys: of other programs' files, of the library, and a shape's name.
OTHERS = {"end_header", "mesh_gpu_instancing", "tube_sides", "half_space", "sun_sky", "uv_mapping", "image_map"}
FILE_ENDINGS = {"png", "jpg", "jpeg", "exr", "mp4", "obj", "ply", "stl", "gltf", "glb", "swc", "json", "graphml", "yaml"}
CALL = re.compile(r"\b(?:error_set|run_warn|load_fail|mapping_fail|reader_fail|snprintf)\s*\(")
STRING = re.compile(r'"((?:[^"\\]|\\.)*)"')
NAME = re.compile(r"(?<![\w.%/'*])[a-z]+(?:_[a-z]+|(?:\[\])?\.[a-z]+)+(?![\w(])")


def messages(text):
    """The strings of each call that makes a message, joined as the compiler does."""
    for call in CALL.finditer(text):
        end = text.find(";\n", call.start())
        statement = text[call.start():end]
        for run in re.finditer(r'"(?:[^"\\]|\\.)*"(?:\s*"(?:[^"\\]|\\.)*")*', statement):
            yield "".join(STRING.findall(run.group(0)))


def is_key(name, paths):
    wanted = "." + name.replace("[]", ".N") + "."
    return any(wanted in path for path in paths)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        paths = ["." + line.strip() + "." for line in file]
    paths.append(".a.b.")  # how a path is explained
    found = 0
    for source in sys.argv[2:]:
        with open(source, encoding="utf-8") as file:
            text = file.read()
        for message in messages(text):
            for match in NAME.finditer(message):
                name = match.group(0)
                known = name in OTHERS or name.split(".")[-1] in FILE_ENDINGS or is_key(name, paths)
                found += 1
                if not known:
                    print(f"{source}: '{name}' is no key: {message}")
    if found < 20:
        print(f"only {found} names were found")


main()
