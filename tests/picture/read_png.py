"""Reads an 8-bit RGB or RGBA PNG with nothing but Python's zlib, by the specification: chunks, checksums, all five
filters, and the frames of an animation, each drawn over the one before.

    read_png.py FILE     prints width, height, Software; then of every frame, where it is an animation, a line "frame
                         MILLISECONDS", and every row of red, green and blue in hexadecimal
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
channels = {2: 3, 6: 4}[colour]
assert (depth, packing, filtering, interlace) == (8, 0, 0, 0)
print(width, height, dict(body.split(b"\0", 1) for kind, body in chunks if kind == b"tEXt")[b"Software"].decode())
canvas = [bytearray(3 * width) for _ in range(height)]


def draw(packed, wide, high, left, top):
    rows = zlib.decompress(packed)
    size = channels * wide
    assert len(rows) == high * (1 + size)
    above = [0] * size
    for y in range(high):
        kind, line = rows[y * (1 + size)], rows[y * (1 + size) + 1:(y + 1) * (1 + size)]
        row = []
        for x, value in enumerate(line):
            a, b, c = row[x - channels] if x >= channels else 0, above[x], above[x - channels] if x >= channels else 0
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row.append(value + (0, a, b, (a + b) // 2, nearest)[kind] & 255)
        for x in range(wide):
            pixel = row[channels * x:channels * (x + 1)]
            if channels == 3 or pixel[3] == 255:
                canvas[top + y][3 * (left + x):3 * (left + x + 1)] = bytes(pixel[:3])
            else:
                assert pixel[3] == 0
        above = row


def show():
    for row in canvas:
        print(row.hex())


controls = [body for kind, body in chunks if kind == b"acTL"]
if not controls:
    draw(b"".join(body for kind, body in chunks if kind == b"IDAT"), width, height, 0, 0)
    show()
else:
    frames, plays = struct.unpack(">II", controls[0])
    assert plays == 0, "for ever"
    assert [kind for kind, _ in chunks].index(b"acTL") < [kind for kind, _ in chunks].index(b"IDAT")
    number, seen, place = 0, 0, None
    for kind, body in chunks:
        if kind in (b"fcTL", b"fdAT"):
            assert struct.unpack(">I", body[:4])[0] == number, "chunks are numbered"
            number += 1
        if kind == b"fcTL":
            wide, high, left, top, over, under, dispose, blend = struct.unpack(">IIIIHHBB", body[4:])
            assert wide > 0 and high > 0 and left + wide <= width and top + high <= height
            assert (dispose, blend) == (0, 1), "stays, and the next is drawn over it"
            place = wide, high, left, top
            print("frame", 1000 * over // under)
            seen += 1
        if kind == b"IDAT":
            assert place == (width, height, 0, 0)
        if kind in (b"IDAT", b"fdAT"):
            draw(body[4:] if kind == b"fdAT" else body, *place)
            show()
    assert seen == frames
