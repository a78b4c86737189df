"""Where LLVM is, which Mitsuba compiles its kernels with."""

import os
import re
import subprocess

VERSION = 19  # 15, Debian 12's default, makes Mitsuba 3.9 abort
MISSING = (
    f"bench-renderers: Mitsuba needs the shared library of LLVM {VERSION}; on Debian: apt-get install libllvm{VERSION}; "
    "elsewhere set DRJIT_LIBLLVM_PATH to it"
)


def find_in(listing):
    """The library's path in what `ldconfig -p` prints, or None."""
    found = re.search(rf"^\s*libLLVM(?:-{VERSION}\.so|\.so\.{VERSION})\S* .*=> (\S+)$", listing, re.MULTILINE)
    return found and found[1]


def find():
    """The library's path, or None if it is not installed."""
    if os.environ.get("DRJIT_LIBLLVM_PATH"):
        return os.environ["DRJIT_LIBLLVM_PATH"]
    path = os.pathsep.join([os.environ.get("PATH", ""), "/sbin", "/usr/sbin"])
    listing = subprocess.run(["ldconfig", "-p"], capture_output=True, text=True, env={**os.environ, "PATH": path})
    return find_in(listing.stdout)
