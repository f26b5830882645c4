"""Reads an 8-bit RGB PNG with nothing but Python's zlib, by the specification: chunks, checksums, all five filters.

    read_png.py FILE     prints width, height, Software and every row in hexadecimal
"""
import struct
import sys
import zlib

data = open(sys.argv[1], "rb").read()
assert data[:8] == b"\x89PNG\r\n\x1a\n"
at, chunks = 8, []
while at < len(data):
    length, kind = struct.unpack(">I4s", data[at:at + 8])
    body = data[at + 8:at + 8 + length]
    assert struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + body), kind
    chunks.append((kind, body))
    at += 12 + length
assert chunks[0][0] == b"IHDR" and chunks[-1] == (b"IEND", b"")
width, height, depth, colour, packing, filtering, interlace = struct.unpack(">IIBBBBB", chunks[0][1])
assert (depth, colour, packing, filtering, interlace) == (8, 2, 0, 0, 0)
print(width, height, dict(body.split(b"\0", 1) for kind, body in chunks if kind == b"tEXt")[b"Software"].decode())
rows = zlib.decompress(b"".join(body for kind, body in chunks if kind == b"IDAT"))
assert len(rows) == height * (1 + 3 * width)
above = [0] * (3 * width)
for y in range(height):
    kind, line = rows[y * (1 + 3 * width)], rows[y * (1 + 3 * width) + 1:(y + 1) * (1 + 3 * width)]
    row = []
    for x, value in enumerate(line):
        a, b, c = row[x - 3] if x >= 3 else 0, above[x], above[x - 3] if x >= 3 else 0
        p = a + b - c
        nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        row.append(value + (0, a, b, (a + b) // 2, nearest)[kind] & 255)
    print(bytes(row).hex())
    above = row
