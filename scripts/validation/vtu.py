"""Reads the frames and clouds the program writes (.vtu, .vtp: appended raw data, LZ4 blocks) without VTK."""

import array
import re
import struct

TYPES = {"Float32": "f", "Float64": "d", "Int64": "q", "Int32": "i", "UInt8": "B", "Int8": "b"}


def lz4_block(data, size):
    """One block of the LZ4 format, `size` bytes when unpacked."""
    out = bytearray()
    i = 0

    def length(nibble, i):
        if nibble == 15:
            while True:
                nibble += data[i]
                i += 1
                if data[i - 1] != 255:
                    break
        return nibble, i

    while i < len(data):
        token = data[i]
        literals, i = length(token >> 4, i + 1)
        out += data[i : i + literals]
        i += literals
        if i >= len(data):
            break
        back = data[i] | data[i + 1] << 8
        count, i = length(token & 15, i + 2)
        count += 4
        start = len(out) - back
        if back >= count:
            out += out[start : start + count]
        else:  # the match runs into itself
            out += (out[start:] * (count // back + 1))[:count]
    if len(out) != size:
        raise ValueError("damaged block")
    return bytes(out)


def read_array(path, name):
    """The DataArray `name` as a flat list of numbers; "Points" are the positions."""
    content = path.read_bytes()
    mark = content.index(b"<AppendedData")
    header = content[:mark].decode()
    if 'compressor="vtkLZ4DataCompressor"' not in header:
        raise ValueError(f"{path}: not packed with LZ4")
    start = content.index(b"_", mark) + 1
    tag = re.search(rf'<DataArray [^>]*Name="{re.escape(name)}"[^>]*>', header)
    if not tag:
        raise KeyError(f"{path} has no array {name}")
    kind = re.search(r'type="(\w+)"', tag.group()).group(1)
    at = start + int(re.search(r'offset="(\d+)\s*"', tag.group()).group(1))
    blocks, whole, last = struct.unpack_from("<3Q", content, at)
    sizes = struct.unpack_from(f"<{blocks}Q", content, at + 24)
    at += 24 + 8 * blocks
    raw = bytearray()
    for k, packed in enumerate(sizes):
        size = last if k == blocks - 1 and last else whole
        raw += lz4_block(content[at : at + packed], size)  # also where packing made it larger
        at += packed
    values = array.array(TYPES[kind])
    values.frombytes(bytes(raw))
    return list(values)


def read_points(path):
    flat = read_array(path, "Points")
    return [tuple(flat[i : i + 3]) for i in range(0, len(flat), 3)]
