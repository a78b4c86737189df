"""The library's arrays as NumPy arrays: views, not copies."""

import ctypes as c

import numpy as np

_BYTES = {"f4": c.c_float, "i4": c.c_int32, "u4": c.c_uint32, "i8": c.c_int64, "u8": c.c_uint64}


def view(address, kind, shape, owner):
    """A read-only array view of memory at address, which belongs to owner (a Handle). The array keeps the owner alive.
    None if address is NULL."""
    if not address:
        return None
    count = int(np.prod(shape))
    if count == 0:
        array = np.zeros(shape, kind)
    else:
        memory = (_BYTES[kind] * count).from_address(address)
        memory.owner = owner  # NumPy keeps memory, memory keeps the owner
        array = np.frombuffer(memory, kind).reshape(shape)
    array.flags.writeable = False
    return array
